#include "gait/offline/reconstructed_file.h"

#include <algorithm>

#include "gait/error.h"
#include "gait/model/body_pose.h"
#include "gait/model/fitted_model.h"
#include "gait/motion/captured/rest_rows.h"
#include "gait/motion/contacts.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rest_calibration.h"

namespace gait {

namespace {

// How well the frames of a file must agree on which way is up (BodyFrame::up_agreement) for it to
// be believed against Y. Walks agree to 0.98 and better; limbs that turn at random do not.
constexpr double believable_agreement = 0.95;

bool contains(const std::vector<int>& joints, int joint) {
  return std::find(joints.begin(), joints.end(), joint) != joints.end();
}

std::vector<int> joined(std::vector<int> a, const std::vector<int>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class FileReconstruction {
 public:
  FileReconstruction(std::shared_ptr<const Model> model, const BvhFile& file,
                     const BodyFrameOverride& said, FileRoot root, bool calibrate)
      : model_(std::move(model)),
        body_(required_body(*model_)),
        clip_(clip_from_bvh(file)),
        root_(root) {
    turns_.assign(clip_.skeleton.joints.size(), Eigen::Quaterniond::Identity());
    if (calibrate) turn_rest();
    matched_ = match_joints(body_, clip_.skeleton, file.name,
                            joined(body_.input_joints, body_.output_joints));
    roles_ = matched_roles(body_, matched_, file.skeleton.size());
    for (const int joint : body_.input_joints) inputs_.push_back(matched_[joint]);
    const int hips = body_roles(body_).hips;
    hips_measured_ = contains(body_.input_joints, hips);
    hips_made_ = contains(body_.output_joints, hips);
    result_.file = file;
    find_frame(said);
  }

  ReconstructedFile run(const PlaySettings& settings) {
    const Clip seen = in_metres_y_up(inputs_alone(), frame_);
    const auto fitted = fitted_model(*model_, seen.skeleton, matched_);
    const BodyPoses poses = body_poses(seen, body_, matched_, body_.heading_window);
    result_.walk = reconstruct_clip(fitted, poses, clip_.frame_rate, result_.file.name, settings);
    clear_outputs();
    const std::vector<double> heading = captured_heading();
    for (int frame = 0; frame < clip_.frames(); ++frame) write(frame, heading);
    return std::move(result_);
  }

 private:
  // Turns the clip's rig until it rests as the model's does; writing turns it back. Joints above
  // the hips only carry the body, so they stay as they are.
  void turn_rest() {
    Skeleton in_metres = clip_.skeleton;
    double mine = 0, file = 0;
    for (const Joint& joint : clip_.skeleton.joints)
      if (const int match = body_.skeleton.find(joint.name); match >= 0 && joint.parent >= 0) {
        mine += body_.skeleton.joints[match].offset.norm();
        file += joint.offset.norm();
      }
    for (Joint& joint : in_metres.joints) {
      joint.offset *= file > 0 ? mine / file : 1;
      for (Eigen::Vector3d& tip : joint.tips) tip *= file > 0 ? mine / file : 1;
    }
    turns_ = rest_turns(in_metres, body_.skeleton);
    const int hips = in_metres.find(body_.skeleton.joints[body_roles(body_).hips].name);
    for (int at = hips < 0 ? -1 : in_metres.joints[hips].parent; at >= 0;
         at = in_metres.joints[at].parent)
      turns_[at].setIdentity();
    clip_ = with_rest_turned(clip_, turns_);
  }

  bool above_hips(int joint) const {
    for (int at = roles_.hips < 0 ? -1 : clip_.skeleton.joints[roles_.hips].parent; at >= 0;
         at = clip_.skeleton.joints[at].parent)
      if (at == joint) return true;
    return false;
  }

  // The clip, in the file's frame, with all joints at rest that the model must not see. Hips that
  // are measured are so in the world: through the joints above them.
  Clip inputs_alone() const {
    Clip clip = clip_;
    for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
      const bool seen = contains(inputs_, joint) || (hips_measured_ && above_hips(joint));
      for (int frame = 0; frame < clip.frames(); ++frame) {
        clip.translation(frame)[joint] = clip.skeleton.joints[joint].offset;
        if (!seen) clip.pose(frame)[joint].setIdentity();
      }
    }
    return clip;
  }

  void find_frame(const BodyFrameOverride& said) {
    // The unit by the bones at rest; position channels of legs must not tell either.
    frame_ = guess_body_frame(inputs_alone(), roles_, {said.metres_per_unit, 'y'});
    result_.warnings = frame_.warnings;
    BodyFrameOverride unit_known = said;
    unit_known.metres_per_unit = frame_.metres_per_unit;
    const BodyFrame up = guess_body_frame(clip_, roles_, unit_known);
    if (!said.up_axis && up.up_agreement < believable_agreement) {
      result_.warnings.push_back(clip_.name +
                                 ": hips and legs do not agree on which way is up; taking Y (say "
                                 "--up x, y or z)");
      return;
    }
    frame_.to_y_up = up.to_y_up;
    result_.warnings.insert(result_.warnings.end(), up.warnings.begin(), up.warnings.end());
  }

  bool hips_move() const {
    return roles_.hips >= 0 && (hips_made_ || (hips_measured_ && root_ == FileRoot::feet));
  }

  // Channels that will be set, or whose old values would still be seen by the choice of angles.
  void clear_outputs() {
    Eigen::Index column = 0;
    for (int joint = 0; joint < clip_.skeleton.size(); ++joint)
      for (const Channel channel : result_.file.channels[joint]) {
        const bool position = channel <= Channel::z_position;
        const int axis = static_cast<int>(channel) % 3;
        const bool output = std::any_of(body_.output_joints.begin(), body_.output_joints.end(),
                                        [&](int mine) { return matched_[mine] == joint; });
        auto values = result_.file.values.col(column++);
        if (output && (!position || joint != roles_.hips))
          values.setConstant(position ? result_.file.skeleton.joints[joint].offset[axis] : 0.0);
        else if (hips_made_ && root_ == FileRoot::feet &&
                 (joint == roles_.hips || above_hips(joint)))
          values.setZero();
      }
  }

  // Per frame the heading that is put back into hips that were made; none when feet lead the root.
  std::vector<double> captured_heading() const {
    std::vector<double> none(clip_.frames(), 0.0);
    if (root_ == FileRoot::feet || !hips_made_ || !roles_.has_legs() || clip_.frames() < 2)
      return none;
    const Clip clip = in_metres_y_up(clip_, frame_);
    return follow_walk(clip, roles_).heading;
  }

  void write(int frame, const std::vector<double>& heading) {
    for (const int joint : body_.output_joints)
      if (body_.roles[joint] != Role::hips && has_rotation(matched_[joint]))
        set_rotation(result_.file, frame, matched_[joint],
                     as_in_file(matched_[joint], result_.walk.clip.pose(frame)[joint]));
    if (hips_move()) write_hips(frame, heading[frame]);
  }

  Eigen::Quaterniond as_in_file(int joint, const Eigen::Quaterniond& rotation) const {
    const int parent = clip_.skeleton.joints[joint].parent;
    return rest_turned_back(rotation, turns_[joint],
                            parent < 0 ? Eigen::Quaterniond::Identity() : turns_[parent]);
  }

  bool has_rotation(int joint) const {
    const auto& channels = result_.file.channels[joint];
    return std::any_of(channels.begin(), channels.end(),
                       [](Channel channel) { return channel > Channel::z_position; });
  }

  // Where a joint of the file is, in the file's own frame.
  struct Place {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
  };

  // The joint above the hips, as it was or cleared.
  Place place_above_hips(int frame, bool at_rest) const {
    std::vector<int> chain;
    for (int at = clip_.skeleton.joints[roles_.hips].parent; at >= 0;
         at = clip_.skeleton.joints[at].parent)
      chain.insert(chain.begin(), at);
    Place place;
    for (const int joint : chain) {
      const Eigen::Vector3d translation =
          at_rest ? rest_translation(joint) : clip_.translation(frame)[joint];
      place.position += place.rotation * translation;
      if (!at_rest) place.rotation = place.rotation * clip_.pose(frame)[joint];
    }
    return place;
  }

  // A cleared joint's translation: zero along its position channels, its offset along others.
  Eigen::Vector3d rest_translation(int joint) const {
    Eigen::Vector3d translation = clip_.skeleton.joints[joint].offset;
    for (const Channel channel : result_.file.channels[joint])
      if (channel <= Channel::z_position) translation[static_cast<int>(channel)] = 0;
    return translation;
  }

  void write_hips(int frame, double heading) {
    const int hips = body_roles(body_).hips;
    const Place above = place_above_hips(frame, hips_made_ && root_ == FileRoot::feet);
    if (hips_made_) {
      const Eigen::Quaterniond in_world = root_rotation_in_file(
          about_vertical(heading) * result_.walk.clip.pose(frame)[hips], frame_);
      set_rotation(result_.file, frame, roles_.hips,
                   as_in_file(roles_.hips, above.rotation.conjugate() * in_world));
    }
    if (root_ != FileRoot::feet) return;
    const Eigen::Vector3d in_world =
        root_translation_in_file(result_.walk.clip.translation(frame)[hips], frame_);
    place_hips(frame, above, in_world);
  }

  // Hips without position channels are moved by the nearest joint above them that has some.
  void place_hips(int frame, const Place& above, const Eigen::Vector3d& wanted) {
    const auto has_position = [&](int joint) {
      const auto& channels = result_.file.channels[joint];
      return std::count_if(channels.begin(), channels.end(),
                           [](Channel channel) { return channel <= Channel::z_position; }) == 3;
    };
    if (has_position(roles_.hips)) {
      set_translation(result_.file, frame, roles_.hips,
                      above.rotation.conjugate() * (wanted - above.position));
      return;
    }
    const int root = clip_.skeleton.joints[roles_.hips].parent;
    if (root < 0 || !has_position(root)) return;
    // The root's own place moves by what the hips' lacks; above it nothing is turned when cleared.
    const Eigen::Vector3d now =
        above.position + above.rotation * clip_.skeleton.joints[roles_.hips].offset;
    const Eigen::Vector3d before =
        hips_made_ ? rest_translation(root) : clip_.translation(frame)[root];
    set_translation(result_.file, frame, root, before + wanted - now);
  }

  std::shared_ptr<const Model> model_;
  const Body& body_;
  Clip clip_;                              // in the file's frame, of the turned rig
  std::vector<Eigen::Quaterniond> turns_;  // per joint of the file
  FileRoot root_;
  std::vector<int> matched_, inputs_;
  JointRoles roles_;  // indices into the file's joints
  bool hips_measured_ = false, hips_made_ = false;
  BodyFrame frame_;
  ReconstructedFile result_;
};

}  // namespace

ReconstructedFile reconstruct_file(std::shared_ptr<const Model> model, const BvhFile& file,
                                   const BodyFrameOverride& said, const PlaySettings& settings,
                                   FileRoot root, bool calibrate) {
  if (file.values.rows() == 0)
    throw Error(file.name + ": expected frames to reconstruct, found none");
  const Clip whole = clip_from_bvh(file);
  const MovingRows rows = moving_rows(whole);
  BvhFile moving = file;
  moving.values = file.values.middleRows(rows.begin, rows.end - rows.begin);
  ReconstructedFile result =
      FileReconstruction(std::move(model), moving, said, root, calibrate).run(settings);
  result.first_row = rows.begin;
  if (auto told = rest_rows_told(whole, rows))
    result.warnings.insert(result.warnings.begin(), std::move(*told));
  auto values = file.values;
  values.middleRows(rows.begin, rows.end - rows.begin) = result.file.values;
  result.file.values = std::move(values);
  return result;
}

}  // namespace gait
