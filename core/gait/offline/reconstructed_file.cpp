#include "gait/offline/reconstructed_file.h"

#include <algorithm>
#include <optional>

#include "gait/error.h"
#include "gait/model/body_pose.h"
#include "gait/model/fitted_model.h"
#include "gait/motion/body_form.h"
#include "gait/motion/contacts.h"
#include "gait/motion/heading.h"
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
        file_clip_(clip_from_bvh(file)),
        form_(body_form(file_clip_, hips_and_legs_of(body_))),
        clip_(form_.clip),
        root_(root) {
    turns_.assign(clip_.skeleton.joints.size(), Eigen::Quaterniond::Identity());
    if (calibrate) turn_rest();
    matched_ = match_joints(body_, clip_.skeleton, file.name,
                            joined(body_.input_joints, body_.output_joints));
    roles_ = matched_roles(body_, matched_, file.skeleton.size());
    if (roles_.hips >= 0) hips_in_file_ = form_.joint_in_file[roles_.hips];
    for (const int joint : body_.input_joints) inputs_.push_back(matched_[joint]);
    const int hips = body_roles(body_).hips;
    hips_measured_ = contains(body_.input_joints, hips);
    hips_made_ = contains(body_.output_joints, hips);
    result_.file = file;
    find_frame(said);
    result_.warnings.insert(result_.warnings.begin(), form_.warnings.begin(), form_.warnings.end());
  }

  ReconstructedFile run(const PlaySettings& settings) {
    const Clip seen = in_metres_y_up(inputs_alone(), frame_);
    const auto fitted = fitted_model(*model_, seen.skeleton, matched_);
    const BodyPoses poses = body_poses(seen, body_, matched_, body_.heading_window);
    result_.walk = reconstruct_clip(fitted, poses, clip_.frame_rate, result_.file.name, settings);
    clear_outputs();
    const std::vector<double> heading = captured_heading();
    if (hips_move() && root_ == FileRoot::feet) find_mover(heading);
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

  // Whether the model's joint is written into the file. A joint that was turned over onto the hips
  // is made only for walks without a file: here what hangs on it was measured.
  bool is_written(int output) const {
    const int joint = matched_[output];
    return body_.roles[output] != Role::hips && !is_turned_over(clip_.skeleton.joints[joint]);
  }

  // Channels that will be set, or whose old values would still be seen by the choice of angles.
  void clear_outputs() {
    std::vector<bool> output(clip_.skeleton.joints.size(), false);
    for (const int mine : body_.output_joints)
      if (is_written(mine) || body_.roles[mine] == Role::hips)
        output[form_.joint_in_file[matched_[mine]]] = true;
    std::vector<Eigen::Vector3d> bones(output.size());
    for (std::size_t joint = 0; joint < bones.size(); ++joint)
      bones[form_.joint_in_file[joint]] = form_.clip.skeleton.joints[joint].offset;
    Eigen::Index column = 0;
    for (int joint = 0; joint < file_clip_.skeleton.size(); ++joint)
      for (const Channel channel : result_.file.channels[joint]) {
        const bool position = channel <= Channel::z_position;
        const int axis = static_cast<int>(channel) % 3;
        auto values = result_.file.values.col(column++);
        if (output[joint] && (!position || joint != hips_in_file_))
          values.setConstant(position && !form_.adds_to_offset[joint] ? bones[joint][axis] : 0.0);
        else if (carriers_rest() && (joint == hips_in_file_ || above_hips_in_file(joint)))
          values.setZero();
      }
  }

  // Joints above hips that are made carry nothing but the walk, unless the body hangs on them.
  bool carriers_rest() const { return hips_made_ && root_ == FileRoot::feet && !form_.re_rooted; }
  bool above_hips_in_file(int joint) const {
    return hips_in_file_ >= 0 && joint != hips_in_file_ &&
           file_clip_.skeleton.is_in_branch(hips_in_file_, joint);
  }

  // Per frame the heading that is put back into hips that were made; none when feet lead the root,
  // unless they must fit to a trunk above them.
  std::vector<double> captured_heading() const {
    std::vector<double> none(clip_.frames(), 0.0);
    const bool fits_to_file = root_ == FileRoot::file || form_.re_rooted;
    if (!fits_to_file || !hips_made_ || !roles_.has_legs() || clip_.frames() < 2) return none;
    const Clip clip = in_metres_y_up(clip_, frame_);
    if (form_.re_rooted && root_ == FileRoot::feet)
      if (const auto trunk = trunk_as_legs())
        return centred_heading(world_poses(clip), *trunk, clip.skeleton.size(), clip.frame_rate,
                               body_.heading_window);
    return follow_walk(clip, roles_).heading;
  }

  // The measured trunk shows its heading as hips and thighs do: by its way and its arms.
  std::optional<JointRoles> trunk_as_legs() const {
    JointRoles trunk = roles_;
    const int left = roles_.joint(Role::left_arm), right = roles_.joint(Role::right_arm);
    const int forearm = roles_.joint(Role::left_forearm);
    if (left < 0 || right < 0 || forearm < 0) return std::nullopt;
    trunk.left = {left, forearm, forearm};
    trunk.right.thigh = right;
    for (int joint = 0; joint < clip_.skeleton.size(); ++joint)
      if (is_turned_over(clip_.skeleton.joints[joint])) trunk.hips = joint;
    return trunk;
  }

  void write(int frame, const std::vector<double>& heading) {
    for (const int mine : body_.output_joints) {
      const int joint = form_.joint_in_file[matched_[mine]];
      if (is_written(mine) && has_rotation(joint))
        set_rotation(result_.file, frame, joint,
                     as_in_file(matched_[mine], result_.walk.clip.pose(frame)[mine]));
    }
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
  bool has_position(int joint) const {
    const auto& channels = result_.file.channels[joint];
    return std::count_if(channels.begin(), channels.end(),
                         [](Channel channel) { return channel <= Channel::z_position; }) == 3;
  }

  // Where a joint of the file is, in the file's own frame, as it was or cleared; -1 is the origin.
  Placement<double> place_in_file(int frame, int joint) const {
    if (joint < 0) return {};
    const Placement<double> above = place_in_file(frame, file_clip_.skeleton.joints[joint].parent);
    if (!carriers_rest())
      return placed_under<double>(above, file_clip_.pose(frame)[joint],
                                  file_clip_.translation(frame)[joint]);
    return placed_under<double>(above, Eigen::Quaterniond::Identity(), rest_translation(joint));
  }

  // A cleared joint's translation: zero along its position channels, its offset along others.
  Eigen::Vector3d rest_translation(int joint) const {
    Eigen::Vector3d translation = file_clip_.skeleton.joints[joint].offset;
    for (const Channel channel : result_.file.channels[joint])
      if (channel <= Channel::z_position) translation[static_cast<int>(channel)] = 0;
    return translation;
  }

  // The joint that carries the hips by its position channels, and where the hips shall be. They
  // start at the origin; below a measured trunk, where they were, and go its way.
  void find_mover(const std::vector<double>& heading) {
    for (mover_ = hips_in_file_; mover_ >= 0 && !has_position(mover_);)
      mover_ = file_clip_.skeleton.joints[mover_].parent;
    if (mover_ < 0)
      result_.warnings.push_back(clip_.name +
                                 ": no joint from the root to the hips has three position "
                                 "channels; the walk stays on the spot");
    const int hips = body_roles(body_).hips;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    if (form_.re_rooted)
      place = frame_.metres_per_unit * (frame_.to_y_up * place_in_file(0, hips_in_file_).place);
    for (int frame = 0; frame < clip_.frames(); ++frame) {
      const Eigen::Vector3d& now = result_.walk.clip.translation(frame)[hips];
      if (!form_.re_rooted) {
        wanted_.push_back(now);
        continue;
      }
      if (frame > 0)
        place +=
            about_vertical(heading[frame]) * (now - result_.walk.clip.translation(frame - 1)[hips]);
      place.y() = now.y();
      wanted_.push_back(place);
    }
  }

  void write_hips(int frame, double heading) {
    const int hips = body_roles(body_).hips;
    const Placement<double> above =
        place_in_file(frame, file_clip_.skeleton.joints[hips_in_file_].parent);
    if (hips_made_) {
      const Eigen::Quaterniond in_world = root_rotation_in_file(
          about_vertical(heading) * result_.walk.clip.pose(frame)[hips], frame_);
      const Eigen::Quaterniond turn = turns_[roles_.hips];
      set_rotation(result_.file, frame, hips_in_file_,
                   rest_turned_back(above.rotation.conjugate() * in_world, turn,
                                    Eigen::Quaterniond::Identity()));
    }
    if (root_ == FileRoot::feet && mover_ >= 0) place_hips(frame);
  }

  // What carries the hips moves by what their place lacks.
  void place_hips(int frame) {
    const Eigen::Vector3d wanted = root_translation_in_file(wanted_[frame], frame_);
    const int parent = file_clip_.skeleton.joints[mover_].parent;
    const Placement<double> above = place_in_file(frame, parent);
    if (mover_ == hips_in_file_) {
      set_translation(result_.file, frame, mover_,
                      above.rotation.conjugate() * (wanted - above.place));
      return;
    }
    const Eigen::Vector3d now = place_in_file(frame, hips_in_file_).place;
    const Eigen::Vector3d before =
        carriers_rest() ? rest_translation(mover_) : file_clip_.translation(frame)[mover_];
    set_translation(result_.file, frame, mover_,
                    before + above.rotation.conjugate() * (wanted - now));
  }

  std::shared_ptr<const Model> model_;
  const Body& body_;
  Clip file_clip_;                         // as the file has it
  BodyForm form_;                          // the same in body form
  Clip clip_;                              // and of the turned rig
  std::vector<Eigen::Quaterniond> turns_;  // per joint of clip_
  FileRoot root_;
  std::vector<int> matched_, inputs_;
  JointRoles roles_;       // indices into clip_'s joints
  int hips_in_file_ = -1;  // the file's joint
  int mover_ = -1;         // the file's joint that carries the hips, -1: there is none
  std::vector<Eigen::Vector3d> wanted_;  // places of hips that the feet carry, metres, Y up
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
  return FileReconstruction(std::move(model), file, said, root, calibrate).run(settings);
}

}  // namespace gait
