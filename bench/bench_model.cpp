#include "bench_model.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "gait/motion/rotation.h"
#include "gait/teach/walk_model.h"

namespace gait::bench {

namespace {

constexpr int styles = 15;
constexpr double rate = 30, cycle_seconds = 1.1;

Skeleton body() {
  Skeleton skeleton;
  const auto add = [&](const char* name, int parent, double x, double y, double z) {
    skeleton.joints.push_back({name, parent, {x, y, z}, {}});
    return skeleton.size() - 1;
  };
  const int root = add("Root", -1, 0, 0, 0), hips = add("Hips", root, 0, 0.9, 0);
  const int spine = add("Spine", hips, 0, 0.16, 0), chest = add("Chest", spine, 0, 0.1, 0);
  add("Head", add("Neck", chest, 0, 0.2, 0), 0, 0.1, 0);
  for (const double side : {1.0, -1.0}) {
    const std::string which = side > 0 ? "Left" : "Right";
    int at = chest;
    at = add((which + "Shoulder").c_str(), at, side * 0.05, 0.15, 0);
    at = add((which + "Arm").c_str(), at, side * 0.12, 0, 0);
    at = add((which + "ForeArm").c_str(), at, side * 0.25, 0, 0);
    add((which + "Hand").c_str(), at, side * 0.23, 0, 0);
    at = add((which + "UpLeg").c_str(), hips, side * 0.09, -0.02, 0);
    at = add((which + "Leg").c_str(), at, 0, -0.4, 0);
    at = add((which + "Foot").c_str(), at, 0, -0.4, 0);
    at = add((which + "Toe").c_str(), at, 0, -0.06, 0.12);
    skeleton.joints[at].tips.push_back({0, 0, 0.05});
  }
  return skeleton;
}

// Every joint swings in all three axes with three harmonics, differently in each style.
class Mover {
 public:
  Mover(int style, int joints) : random_(1000 + style), joints_(joints) {
    std::normal_distribution<double> normal;
    for (int joint = 0; joint < joints; ++joint)
      for (int axis = 0; axis < 3; ++axis)
        for (int harmonic = 0; harmonic < 3; ++harmonic)
          swing_.push_back({0.12 / (1 + harmonic) * normal(random_), 3 * normal(random_)});
  }

  void pose(double phase, std::span<Eigen::Quaterniond> rotations) {
    std::normal_distribution<double> noise(0, 0.01);
    for (int joint = 1; joint < joints_; ++joint) {
      Eigen::Vector3d vector;
      for (int axis = 0; axis < 3; ++axis) {
        vector[axis] = noise(random_);
        for (int harmonic = 0; harmonic < 3; ++harmonic) {
          const auto [size, shift] = swing_[(joint * 3 + axis) * 3 + harmonic];
          vector[axis] += size * std::sin(2 * std::numbers::pi * (1 + harmonic) * phase + shift);
        }
      }
      rotations[joint] = exponential_map<double>(vector);
    }
  }

 private:
  std::mt19937 random_;
  int joints_;
  std::vector<std::array<double, 2>> swing_;
};

Walk walk(int style, int frames) {
  Walk walk;
  walk.style = "style " + std::to_string(style);
  walk.clip.name = walk.style;
  walk.clip.skeleton = body();
  walk.clip.frame_rate = rate;
  walk.clip.resize(frames);
  Mover mover(style, walk.clip.skeleton.size());
  int halves = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double cycles = frame / (rate * cycle_seconds);
    mover.pose(cycles, walk.clip.pose(frame));
    for (; halves <= 2 * cycles; ++halves)
      walk.contacts.push_back({frame, halves % 2 == 0 ? Foot::right : Foot::left});
  }
  return walk;
}

}  // namespace

std::shared_ptr<const Model> bench_model(int states) {
  static std::map<int, std::shared_ptr<const Model>> made;
  auto& model = made[states];
  if (model) return model;
  std::vector<Walk> walks;
  for (int style = 0; style < styles; ++style) walks.push_back(walk(style, 300));
  SelectionOptions options;
  options.learning.states = states;
  options.regularisation = 30;
  options.rounds = 0;
  options.folds = 1;
  model =
      std::make_shared<const Model>(select_walk_model(walk_sequences(walks, {}), options).model);
  return model;
}

std::vector<std::vector<Eigen::Quaternionf>> bench_inputs(const Model& model, int frames) {
  const Walk moved = walk(3, frames);
  std::vector<std::vector<Eigen::Quaternionf>> inputs;
  for (int frame = 0; frame < frames; ++frame) {
    inputs.emplace_back();
    for (const int joint : model.body->input_joints)
      inputs.back().push_back(moved.clip.pose(frame)[joint].cast<float>());
  }
  return inputs;
}

}  // namespace gait::bench
