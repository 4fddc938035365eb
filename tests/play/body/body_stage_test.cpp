// A body on stage, put together from its parts, as an audience and as a patch sees it.
#include "gait/play/body/body_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "gait/motion/kinematics.h"
#include "play/change/joint_motion.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::ForbiddenMemory;
using testing::JointMotion;
using testing::percentile;
using testing::plan_of;
using testing::Pose;
using testing::streams_of;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// A captured walk as the messages `in`, `out`, `pose` and `root` have it.
struct Captured {
  Eigen::MatrixXf in, out, pose;
  std::vector<RootPlace> roots;
  std::vector<Contact> contacts;
  int frames() const { return static_cast<int>(in.cols()); }
};

Captured captured(const CorpusWalk& walk) {
  const Body& body = *few_walks_model()->body;
  const Sequence streams = streams_of(walk, body);
  Captured result;
  result.in = streams.inputs.cast<float>();
  result.out = streams.outputs.cast<float>();
  result.pose.setZero(3 * body.skeleton.size(), result.in.cols());
  for (std::size_t i = 0; i < body.input_joints.size(); ++i)
    result.pose.middleRows(3 * body.input_joints[i], 3) =
        result.in.middleRows(3 * static_cast<Eigen::Index>(i), 3);
  for (std::size_t i = 0; i < body.output_joints.size(); ++i)
    result.pose.middleRows(3 * body.output_joints[i], 3) =
        result.out.middleRows(3 * static_cast<Eigen::Index>(i), 3);
  const WorldPoses world = world_poses(walk.clip);
  const JointRoles roles = find_roles(walk.clip.skeleton);
  const std::size_t joints = walk.clip.skeleton.joints.size();
  for (int frame = 0; frame < result.frames(); ++frame)
    result.roots.push_back({world
                                .positions[static_cast<std::size_t>(frame) * joints +
                                           static_cast<std::size_t>(roles.hips)]
                                .cast<float>(),
                            0});
  result.contacts = walk.contacts;
  return result;
}

const Captured& sad() {
  static const Captured walk = captured(make_walk(plan_of("sad", 9, 6)));
  return walk;
}
const Captured& proud() {
  static const Captured walk = captured(make_walk(plan_of("proud", 9, 6)));
  return walk;
}

std::span<const float> column(const Eigen::MatrixXf& values, int frame) {
  return {values.col(frame).data(), static_cast<std::size_t>(values.rows())};
}

std::vector<float> kept(std::span<const float> values) { return {values.begin(), values.end()}; }

Eigen::Vector3f joint_at(const BodyStage& stage, int joint) {
  return Eigen::Vector3f(stage.positions().data() + 3 * joint);
}

Pose rotations(std::span<const float> values) {
  Pose pose;
  for (std::size_t at = 0; at < values.size(); at += 3)
    pose.push_back(
        exponential_map<double>(Eigen::Vector3d(values[at], values[at + 1], values[at + 2])));
  return pose;
}

TEST(BodyStage, puts_parts_together_to_the_body_they_are_of_and_walks_as_its_feet_do) {
  const auto model = few_walks_model();
  const Body& body = *model->body;
  const JointRoles roles = body_roles(body);
  BodyStage parts(model), whole(model);
  whole.set_lock(false);  // of parts nothing is held
  RootMotion root(body.skeleton, roles, model->frame_rate);
  Clip clip = body_clip(body, "staged", model->frame_rate, 1);
  for (int frame = 0; frame < sad().frames(); ++frame) {
    ASSERT_TRUE(parts.store_inputs(column(sad().in, frame)));
    ASSERT_TRUE(parts.show_outputs(column(sad().out, frame)));
    ASSERT_TRUE(whole.show_pose(column(sad().pose, frame)));
    EXPECT_EQ(kept(parts.pose()), kept(whole.pose()));
    EXPECT_EQ(kept(parts.positions()), kept(whole.positions()));
    // Another way to the same places: a clip's forward kinematics, in double.
    std::vector<Eigen::Quaternionf> pose;
    std::vector<Eigen::Quaterniond> in_double;
    for (int joint = 0; joint < body.skeleton.size(); ++joint) {
      const auto at = static_cast<std::size_t>(joint);
      pose.push_back(
          rotation_from<float>(std::span<const float, 3>(sad().pose.col(frame).data() + 3 * at, 3),
                               body.references[at].cast<float>()));
      in_double.push_back(rotation_from<float>(whole.pose().subspan(3 * at).first<3>(),
                                               body.references[at].cast<float>())
                              .cast<double>());
    }
    const Eigen::Vector3f hips = root.advance(pose);
    place_body(clip, 0, roles, in_double, 0, hips.cast<double>());
    const WorldPoses world = world_poses(clip);
    EXPECT_LT((whole.root().hips - hips).norm(), 1e-4f) << frame;
    std::vector<Eigen::Vector3d> places = world.positions;
    for (int joint = 0; joint < body.skeleton.size(); ++joint)
      for (const Eigen::Vector3d& tip : body.skeleton.joints[joint].tips)
        places.push_back(world.positions[static_cast<std::size_t>(joint)] +
                         world.rotations[static_cast<std::size_t>(joint)] * tip);
    ASSERT_EQ(whole.positions().size(), 3 * places.size());
    EXPECT_GT(places.size(), world.positions.size() + 6);  // hands, soles, the top of the head
    for (const auto& [parent, child] : whole.bones())
      for (const int joint : {parent, child})
        ASSERT_LT((joint_at(whole, joint).cast<double>() - places[static_cast<std::size_t>(joint)])
                      .norm(),
                  1e-4)
            << "frame " << frame << ", joint " << joint;
  }
}

TEST(BodyStage, shows_inputs_with_the_outputs_made_from_them_however_late_and_often_they_come) {
  const auto model = few_walks_model();
  const int delay = 3;
  for (const int per_frame : {1, 2, 4}) {
    BodyStage stage(model);
    stage.set_delay(delay);
    for (int frame = 0; frame < 60; ++frame) {
      for (int i = 0; i < per_frame; ++i)  // the last one before an output is its own
        ASSERT_TRUE(stage.store_inputs(i + 1 == per_frame ? column(sad().in, frame)
                                                          : column(proud().in, frame)));
      if (frame < delay) continue;
      ASSERT_TRUE(stage.show_outputs(column(sad().out, frame - delay)));
      // Of a fast sender the first outputs' inputs are not known apart.
      if (per_frame > 1 && frame < 2 * delay) continue;
      ASSERT_EQ(kept(stage.pose()), kept(column(sad().pose, frame - delay))) << frame;
    }
  }
}

TEST(BodyStage, goes_over_from_measured_inputs_to_whole_poses_and_back_without_a_jump) {
  const auto model = few_walks_model();
  JointMotion taught;
  for (const Captured* walk : {&sad(), &proud()}) {
    std::vector<Pose> poses;
    for (int frame = 0; frame < walk->frames(); ++frame)
      poses.push_back(rotations(column(walk->pose, frame)));
    taught.add(poses, model->frame_rate, 0, poses.size());
  }
  JointMotion shown;
  for (int first = 30; first < 60; first += 5) {
    BodyStage stage(model);
    std::vector<Pose> poses;
    for (int frame = 0; frame < 120; ++frame) {
      // The upper body of a sad walk; then a proud one alone; its legs all the time.
      if (frame < first || frame >= first + 30) {
        stage.store_inputs(column(sad().in, frame));
        stage.show_outputs(column(proud().out, frame));
      } else {
        stage.show_pose(column(proud().pose, frame));
      }
      poses.push_back(rotations(stage.pose()));
    }
    shown.add(poses, model->frame_rate, 0, poses.size());
  }
  std::printf("largest speed %.2f, acceleration %.2f of the walks' own\n",
              percentile(shown.speeds, 1) / percentile(taught.speeds, 1),
              percentile(shown.accelerations, 1) / percentile(taught.accelerations, 1));
  EXPECT_LE(percentile(shown.speeds, 1), 1.1 * percentile(taught.speeds, 1));
  EXPECT_LE(percentile(shown.accelerations, 1), 1.1 * percentile(taught.accelerations, 1));
}

TEST(BodyStage, has_its_root_from_the_feet_as_measured_or_on_the_spot) {
  const auto model = few_walks_model();
  BodyStage feet(model), keep(model), still(model), turned(model);
  feet.set_lock(false);  // its root would be smoother
  keep.set_root(RootFrom::keep);
  still.set_root(RootFrom::still);
  ASSERT_TRUE(still.set_place({1, 0.5f, 2}));
  ASSERT_TRUE(turned.set_heading_rate(0.5f));
  const auto& walk = proud();
  for (int frame = 0; frame < walk.frames(); ++frame) {
    RootPlace root = walk.roots[static_cast<std::size_t>(frame)];
    root.heading = 0.3f;
    ASSERT_TRUE(keep.store_root(root));
    for (BodyStage* stage : {&feet, &keep, &still, &turned})
      ASSERT_TRUE(stage->show_pose(column(walk.pose, frame)));
    EXPECT_LT((keep.root().hips - root.hips).norm(), 1e-6f);
    EXPECT_EQ(keep.root().heading, 0.3f);
    EXPECT_EQ(still.root().hips.x(), 1);
    EXPECT_EQ(still.root().hips.z(), 2);
    EXPECT_NEAR(still.root().hips.y(), feet.root().hips.y() + 0.5f, 1e-5f);
  }
  const float travelled = walk.roots.back().hips.z() - walk.roots.front().hips.z();
  EXPECT_NEAR(feet.root().hips.z(), travelled, 0.08f * travelled);
  const float turn = static_cast<float>(walk.frames() / model->frame_rate) * 0.5f;
  EXPECT_NEAR(std::remainder(turned.root().heading - turn, 2 * static_cast<float>(M_PI)), 0, 0.02f);
  EXPECT_LT(turned.root().hips.norm(), 0.8f * feet.root().hips.norm());
}

// How far the lowest place of each foot goes over the ground while it is the lowest and near it, as
// an audience sees it: metres, over the whole walk.
class Slid {
 public:
  explicit Slid(const BodyStage& stage) : stage_(stage) {
    const JointRoles roles = body_roles(*stage.model().body);
    for (const Leg* leg : {&roles.right, &roles.left}) places_[leg == &roles.left] = {leg->foot};
    for (const auto& [parent, child] : stage.bones())
      for (auto& foot : places_)
        if (std::ranges::find(foot, parent) != foot.end() &&
            std::ranges::find(foot, child) == foot.end())
          foot.push_back(child);
  }
  void look() {
    for (int side = 0; side < 2; ++side) {
      const auto& foot = places_[side];
      const int lowest = *std::ranges::min_element(
          foot, {}, [&](int place) { return joint_at(stage_, place).y(); });
      const Eigen::Vector3f at = joint_at(stage_, lowest);
      const Eigen::Vector3f moved = at - before_[side];
      // A foot that goes as fast as that is not meant to stand.
      if (lowest == lowest_[side] && at.y() < 0.008f && moved.norm() < 0.012f)
        slid_ += std::hypot(moved.x(), moved.z());
      lowest_[side] = lowest, before_[side] = at;
    }
  }
  float metres() const { return slid_; }

 private:
  const BodyStage& stage_;
  std::array<std::vector<int>, 2> places_;
  std::array<int, 2> lowest_{-1, -1};
  std::array<Eigen::Vector3f, 2> before_{};
  float slid_ = 0;
};

TEST(BodyStage, keeps_feet_where_they_stand_unless_told_not_to) {
  const auto model = few_walks_model();
  const Body& body = *model->body;
  Clip clip = body_clip(body, "staged", model->frame_rate, 1);
  BodyStage held(model), free(model), spot(model);
  free.set_lock(false);
  spot.set_root(RootFrom::still);
  Slid held_slid(held), free_slid(free);
  std::vector<Pose> came, shown;
  Eigen::VectorXf pose;
  for (int frame = 0; frame < proud().frames(); ++frame) {
    // Thighs that are some degrees off, as reconstructed ones are.
    pose = proud().pose.col(frame);
    const JointRoles roles = body_roles(*model->body);
    pose[3 * roles.right.thigh] += 0.02f * std::sin(0.15f * static_cast<float>(frame));
    pose[3 * roles.left.thigh] += 0.02f * std::sin(0.2f * static_cast<float>(frame));
    const std::span<const float> values{pose.data(), static_cast<std::size_t>(pose.size())};
    for (BodyStage* stage : {&held, &free, &spot}) ASSERT_TRUE(stage->show_pose(values));
    // Pose and places tell the same: by a clip's forward kinematics, in double.
    std::vector<Eigen::Quaterniond> local;
    for (std::size_t at = 0; at < body.references.size(); ++at)
      local.push_back(rotation_from<float>(held.pose().subspan(3 * at).first<3>(),
                                           body.references[at].cast<float>())
                          .cast<double>());
    place_body(clip, 0, body_roles(body), local, 0, held.root().hips.cast<double>());
    const WorldPoses world = world_poses(clip);
    for (const auto& [parent, child] : held.bones())
      if (child < body.skeleton.size()) {
        ASSERT_LT((joint_at(held, child).cast<double>() -
                   world.positions[static_cast<std::size_t>(child)])
                      .norm(),
                  1e-4)
            << "frame " << frame << ", joint " << child << " of " << parent;
      }
    EXPECT_EQ(kept(free.pose()), kept(values));
    EXPECT_EQ(kept(spot.pose()), kept(values));  // its feet have nowhere to stand
    came.push_back(rotations(values));
    shown.push_back(rotations(held.pose()));
    if (frame > 15) held_slid.look(), free_slid.look();
  }
  std::printf("slid %.0f mm in all, %.0f mm with feet locked\n", 1000 * free_slid.metres(),
              1000 * held_slid.metres());
  EXPECT_GT(free_slid.metres(), 0.01f);
  EXPECT_LT(held_slid.metres(), 0.4f * free_slid.metres());
  JointMotion before, after;
  before.add(came, model->frame_rate, 2, came.size());
  after.add(shown, model->frame_rate, 2, shown.size());
  EXPECT_LE(percentile(after.speeds, 0.999), 1.1 * percentile(before.speeds, 0.999));
  EXPECT_LE(percentile(after.accelerations, 0.999), 1.1 * percentile(before.accelerations, 0.999));
}

TEST(BodyStage, stays_where_it_is_while_it_does_not_walk) {
  const auto model = few_walks_model();
  BodyStage stage(model);
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.003f);
  Eigen::VectorXf standing = Eigen::VectorXf::Zero(sad().pose.rows());
  Eigen::Vector3f stopped = Eigen::Vector3f::Zero();
  for (int frame = 0; frame < 60; ++frame) stage.show_pose(column(sad().pose, frame));
  stage.set_walking(false);
  ASSERT_TRUE(stage.set_heading_rate(0.5f));
  for (int frame = 0; frame < 1000; ++frame) {
    standing = sad().pose.col(60);
    for (float& value : standing) value += noise(random);
    stage.show_pose({standing.data(), static_cast<std::size_t>(standing.size())});
    EXPECT_FALSE(frame > 0 && (stage.touched(Foot::right) || stage.touched(Foot::left)));
    if (frame == 15) stopped = stage.root().hips;
    if (frame > 15) {
      EXPECT_LT((stage.root().hips - stopped).cwiseProduct(Eigen::Vector3f(1, 0, 1)).norm(), 1e-3f);
    }
  }
  // And goes on from there.
  stage.set_heading_rate(0);
  stage.set_walking(true);
  for (int frame = 60; frame < 120; ++frame) stage.show_pose(column(sad().pose, frame));
  EXPECT_GT((stage.root().hips - stopped).norm(), 0.5f);
}

struct TouchFigures {
  int found = 0, missed = 0, extra = 0, within_two = 0;
  std::vector<double> errors;  // frames, late is positive
};

TouchFigures touches_of(const std::string& style) {
  TouchFigures figures;
  for (int take = 7; take <= 8; ++take) {
    const Captured walk = captured(make_walk(plan_of(style, take, 8)));
    BodyStage stage(few_walks_model());
    std::vector<Contact> seen;
    for (int frame = 0; frame < walk.frames(); ++frame) {
      stage.show_pose(column(walk.pose, frame));
      for (const Foot foot : {Foot::right, Foot::left})
        if (stage.touched(foot)) seen.push_back({frame, foot});
    }
    std::vector<bool> used(seen.size(), false);
    for (const Contact& truth : walk.contacts) {
      if (truth.frame < 15) continue;  // the first step comes from nowhere
      int best = -1;
      for (std::size_t i = 0; i < seen.size(); ++i)
        if (seen[i].foot == truth.foot &&
            (best < 0 || std::abs(seen[i].frame - truth.frame) <
                             std::abs(seen[static_cast<std::size_t>(best)].frame - truth.frame)))
          best = static_cast<int>(i);
      const int error = best < 0 ? 99 : seen[static_cast<std::size_t>(best)].frame - truth.frame;
      if (std::abs(error) > 6) {
        // One that the walk's end cuts off is not missed.
        if (truth.frame + 4 < walk.frames()) ++figures.missed;
        continue;
      }
      used[static_cast<std::size_t>(best)] = true;
      ++figures.found;
      figures.within_two += std::abs(error) <= 2;
      figures.errors.push_back(error);
    }
    for (std::size_t i = 0; i < seen.size(); ++i)
      figures.extra +=
          !used[i] && seen[i].frame >= 20 && seen[i].frame <= walk.contacts.back().frame + 6;
  }
  return figures;
}

TEST(BodyStage, says_when_a_foot_touches) {
  for (const WalkStyle& kind : corpus_styles()) {
    const std::string style = kind.name;
    const TouchFigures figures = touches_of(style);
    std::printf("%-14s %3d found, %d missed, %d too many, %3d within two frames, median %+.0f\n",
                style.c_str(), figures.found, figures.missed, figures.extra, figures.within_two,
                percentile(figures.errors, 0.5));
    EXPECT_EQ(figures.missed, 0) << style;
    EXPECT_LE(figures.extra, 1) << style;
    EXPECT_GE(figures.within_two, 0.95 * figures.found) << style;
    EXPECT_LE(std::abs(percentile(figures.errors, 0.5)), 1) << style;
  }
}

TEST(BodyStage, measures_strides_speeds_and_energy) {
  const auto model = few_walks_model();
  BodyStage stage(model), large(model);
  const double rate = model->frame_rate;
  const auto& walk = proud();
  const Body& body = *model->body;
  ASSERT_TRUE(large.set_leg_length(2));
  std::vector<double> strides, larger;
  float energy = 0;
  for (int frame = 0; frame < walk.frames(); ++frame) {
    stage.show_pose(column(walk.pose, frame));
    large.show_pose(column(walk.pose, frame));
    for (const Foot foot : {Foot::right, Foot::left})
      if (stage.stride(foot)) {
        strides.push_back(*stage.stride(foot));
        larger.push_back(*large.stride(foot));
      }
    energy = std::max(energy, stage.energy());
    if (frame == 40) {
      const int shank = body_roles(body).left.shank;
      const Pose now = rotations(column(walk.pose, 40)), before = rotations(column(walk.pose, 39));
      const auto at = static_cast<std::size_t>(shank);
      EXPECT_NEAR(stage.speed(shank), rate * angle_between(now[at], before[at]), 0.01);
    }
  }
  ASSERT_GE(strides.size(), 4u);
  // Two steps of the captured path.
  const double frames_of_stride = 2.0 * (walk.contacts.back().frame - walk.contacts.front().frame) /
                                  static_cast<double>(walk.contacts.size() - 1);
  const double expected = frames_of_stride *
                          (walk.roots.back().hips.z() - walk.roots.front().hips.z()) /
                          (walk.frames() - 1);
  EXPECT_NEAR(percentile(strides, 0.5), expected, 0.1 * expected);
  const double scale = large.root().hips.y() / stage.root().hips.y();
  EXPECT_GT(scale, 1.5);
  EXPECT_NEAR(percentile(larger, 0.5), scale * percentile(strides, 0.5), 1e-3);
  EXPECT_GT(energy, 0.3f);
  EXPECT_LE(energy, 1);
  for (int i = 0; i < 60; ++i) stage.show_pose(column(walk.pose, 50));
  EXPECT_LT(stage.energy(), 0.01f);
}

TEST(BodyStage, tells_lively_styles_from_others) {
  const auto energy_of = [](const char* style) {
    const Captured walk = captured(make_walk(plan_of(style, 9)));
    BodyStage stage(few_walks_model());
    std::vector<double> energies;
    for (int frame = 0; frame < walk.frames(); ++frame) {
      stage.show_pose(column(walk.pose, frame));
      energies.push_back(stage.energy());
    }
    return percentile(energies, 0.5);
  };
  EXPECT_GT(energy_of("in-a-hurry"), 1.3 * energy_of("sad"));
  EXPECT_GT(energy_of("in-a-hurry"), 0.4);
}

TEST(BodyStage, smooths_what_trembles_and_is_hardly_late_for_what_moves) {
  const auto model = few_walks_model();
  BodyStage stage(model);
  stage.set_lock(false);
  ASSERT_TRUE(stage.set_smooth(1));
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0, 0.02f);
  JointMotion plain, smoothed;
  std::vector<Pose> came, left;
  for (int frame = 0; frame < 200; ++frame) {
    Eigen::VectorXf pose = sad().pose.col(20);
    for (float& value : pose) value += noise(random);
    stage.show_pose({pose.data(), static_cast<std::size_t>(pose.size())});
    came.push_back(rotations({pose.data(), static_cast<std::size_t>(pose.size())}));
    left.push_back(rotations(stage.pose()));
  }
  plain.add(came, 30, 50, 200), smoothed.add(left, 30, 50, 200);
  EXPECT_LT(percentile(smoothed.speeds, 0.5), 0.4 * percentile(plain.speeds, 0.5));
  double largest = 0;
  stage.reset();
  for (int frame = 0; frame < 90; ++frame) {
    stage.show_pose(column(proud().pose, frame));
    const Pose is = rotations(stage.pose()), was = rotations(column(proud().pose, frame));
    for (std::size_t joint = 0; joint < is.size(); ++joint)
      largest = std::max(largest, angle_between(is[joint], was[joint]));
  }
  std::printf("1 Hz at rest lags behind a proud walk by %.2f rad at most\n", largest);
  EXPECT_LT(largest, 0.5);
  ASSERT_TRUE(stage.set_smooth(0));
  stage.show_pose(column(proud().pose, 7));
  EXPECT_EQ(kept(stage.pose()), kept(column(proud().pose, 7)));
}

TEST(BodyStage, lets_bad_input_pass_unnoticed) {
  const auto model = few_walks_model();
  BodyStage stage(model), untouched(model);
  for (int frame = 0; frame < 40; ++frame) {
    std::vector<float> bad = kept(column(sad().pose, frame));
    bad[5] = nan;
    EXPECT_FALSE(stage.show_pose(bad));
    EXPECT_FALSE(stage.show_pose({}));
    EXPECT_FALSE(stage.store_pose(bad));
    EXPECT_FALSE(stage.show_outputs(bad));
    EXPECT_FALSE(stage.store_inputs({}));
    EXPECT_FALSE(stage.store_root({{nan, 0, 0}, 0}));
    EXPECT_FALSE(stage.set_heading_rate(nan));
    EXPECT_FALSE(stage.set_place({0, nan, 0}));
    EXPECT_FALSE(stage.set_smooth(-1));
    EXPECT_FALSE(stage.set_leg_length(nan));
    stage.show_pose(column(sad().pose, frame));
    untouched.show_pose(column(sad().pose, frame));
    ASSERT_EQ(kept(stage.positions()), kept(untouched.positions()));
  }
}

TEST(BodyStage, goes_on_where_it_is_in_another_model) {
  const auto model = few_walks_model();
  BodyStage before(model), after(std::make_shared<Model>(*model));
  before.set_place({1, 0, 1});
  for (int frame = 0; frame < 60; ++frame) before.show_pose(column(sad().pose, frame));
  ASSERT_TRUE(after.take_over(before));
  // On the same bones nothing is different at all, feet that are held among it.
  for (int frame = 60; frame < 90; ++frame) {
    before.show_pose(column(sad().pose, frame));
    after.show_pose(column(sad().pose, frame));
    ASSERT_EQ(kept(after.positions()), kept(before.positions())) << frame;
  }
  auto longer = std::make_shared<Model>(*model);
  for (Joint& joint : longer->body->skeleton.joints) joint.offset *= 1.1;
  BodyStage tall(longer);
  ASSERT_TRUE(tall.take_over(before));
  const Eigen::Vector3f place = before.root().hips;
  tall.show_pose(column(sad().pose, 90));
  EXPECT_LT((tall.root().hips - place).norm(), 0.03f);  // its legs are as long as they were
}

TEST(BodyStage, takes_no_memory) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  const auto& walk = sad();
  BodyStage stage(few_walks_model()), next(few_walks_model());
  long allocations = 0, releases = 0;
  {
    const ForbiddenMemory forbidden;
    for (int frame = 0; frame < 100; ++frame) {
      if (frame == 20) stage.set_smooth(2);
      if (frame == 30) stage.set_delay(5);
      if (frame % 40 == 35) stage.set_lock(frame > 50);
      stage.store_root(walk.roots[static_cast<std::size_t>(frame)]);
      stage.store_inputs(column(walk.in, frame));
      if (frame / 25 % 2 == 0)
        stage.show_outputs(column(walk.out, frame));
      else
        stage.show_pose(column(walk.pose, frame));
    }
    next.take_over(stage);
    stage.reset();
    allocations = forbidden.allocations(), releases = forbidden.releases();
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(releases, 0);
}

}  // namespace
}  // namespace gait
