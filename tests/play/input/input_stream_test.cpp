#include "gait/play/input/input_stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "gait/model/body_pose.h"
#include "gait/play/recognise/live_recogniser.h"
#include "gait/play/stream_reconstructor.h"
#include "play/few_walks.h"
#include "play/played_stream.h"
#include "play/random_model.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::frame_of;
using testing::input_poses;
using testing::InputPoses;
using testing::plan_of;

// What a sender would send of a pose: rotation vectors relative to the references.
std::vector<float> values_of(const Model& model, const std::vector<Eigen::Quaternionf>& inputs) {
  std::vector<float> values;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& reference = model.body->references[model.body->input_joints[i]];
    const Eigen::Vector3f value =
        rotation_vector<float>(reference.cast<float>().conjugate() * inputs[i]);
    values.insert(values.end(), value.data(), value.data() + 3);
  }
  return values;
}

TEST(InputStream, leads_to_the_decisions_of_a_reconstruction_at_any_rate) {
  const auto model = few_walks_model();
  for (const double rate : {30.0, 50.0, 60.0, 120.0}) {
    const InputPoses poses = input_poses(make_walk(plan_of("drunk", 9), rate).clip, *model->body);
    StreamReconstructor reconstructor(model);
    LiveRecogniser live(model);
    int frames = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double time = static_cast<double>(i) / rate;
      reconstructor.push(time, poses[i]);
      EXPECT_NE(live.stream().push(time, values_of(*model, poses[i])),
                FrameClock::Arrival::rejected);
      while (reconstructor.next()) {
        ASSERT_TRUE(live.next());
        ++frames;
        const Decision &expected = reconstructor.frame().decision, &found = live.decision();
        EXPECT_EQ(found.label, expected.label);
        EXPECT_EQ(found.state, expected.state);
        EXPECT_NEAR(found.phase, expected.phase, 1e-3);
        EXPECT_NEAR(found.distance, expected.distance, 2e-2 * (1 + expected.distance));
        for (std::size_t style = 0; style < model->styles.size(); ++style)
          EXPECT_NEAR(live.recogniser().styles()[style], reconstructor.frame().styles[style], 2e-3);
        EXPECT_EQ(live.stream().time(), reconstructor.frame().time);
        EXPECT_LT(live.stream().waited(), 1 / rate + 1e-9);
      }
      EXPECT_FALSE(live.next());
    }
    EXPECT_GT(frames, 100);
  }
}

TEST(InputStream, takes_rotations_as_quaternions_and_as_euler_angles) {
  const auto model = few_walks_model();
  const auto poses = input_poses(make_walk(plan_of("sad", 9)).clip, *model->body);
  InputStream vectors(model), quaternions(model), angles(model);
  vectors.push(0, values_of(*model, poses[7]));
  const int hips = HipsHeading::input_of(*model->body);
  for (int stream = 0; stream < vectors.streams(); ++stream) {
    const Eigen::Quaternionf q = poses[7][stream];
    EXPECT_TRUE(quaternions.set_rotation(stream, Eigen::Quaternionf(-3 * q.coeffs())));
    const Eigen::Vector3f euler =
        q.toRotationMatrix().eulerAngles(2, 0, 1) * 180 / std::numbers::pi_v<float>;
    EXPECT_TRUE(angles.set_euler(stream, "ZXY", std::span<const float, 3>(euler.data(), 3)));
  }
  quaternions.push_collected(0), angles.push_collected(0);
  ASSERT_TRUE(vectors.next() && quaternions.next() && angles.next());
  for (int value = 0; value < model->input.values; ++value) {
    if (hips >= 0 && value / 3 == hips) continue;  // of those the heading is taken out
    EXPECT_NEAR(quaternions.values()[value], vectors.values()[value], 2e-6);
    EXPECT_NEAR(angles.values()[value], vectors.values()[value], 2e-5);
  }
}

TEST(InputStream, joints_are_found_behind_plain_streams) {
  auto model = std::make_shared<Model>(*few_walks_model());
  model->inputs.insert(model->inputs.begin(), {"pressure", 1, StreamKind::plain});
  ++model->input.values;
  const auto poses = input_poses(make_walk(plan_of("sad", 9)).clip, *model->body);
  InputStream rotations(model), bodies(model);
  std::vector<float> body(3 * model->body->references.size(), 0.0f);
  for (std::size_t i = 0; i < poses[7].size(); ++i) {
    EXPECT_TRUE(rotations.set_rotation(static_cast<int>(i) + 1, poses[7][i]));
    const int joint = model->body->input_joints[i];
    values_from<float>(poses[7][i], model->body->references[joint].cast<float>(),
                       body.data() + 3 * joint);
  }
  EXPECT_FALSE(rotations.set_rotation(0, poses[7][0])) << "a plain stream";
  rotations.push_collected(0), bodies.push_body(0, body);
  ASSERT_TRUE(rotations.next() && bodies.next());
  for (int value = 1; value < model->input.values; ++value)
    EXPECT_NEAR(rotations.values()[value], bodies.values()[value], 2e-6) << value;
}

TEST(InputStream, euler_angles_turn_as_a_bvh_file_says) {
  const float degrees[3] = {90, 90, 0};
  const auto turned = rotation_from_euler("ZXY", degrees);
  ASSERT_TRUE(turned);
  // R_Z(90) R_X(90): Z is first tipped to -Y, then that turned to X.
  EXPECT_LT((*turned * Eigen::Vector3f::UnitZ() - Eigen::Vector3f::UnitX()).norm(), 1e-6f);
  EXPECT_TRUE(rotation_from_euler("zxz", degrees));
  for (const char* order : {"ZZX", "ZX", "ZXYZ", "ZXW", "", "zZx"})
    EXPECT_FALSE(rotation_from_euler(order, degrees)) << order;
  const float not_a_number[3] = {0, std::numeric_limits<float>::quiet_NaN(), 0};
  EXPECT_FALSE(rotation_from_euler("XYZ", not_a_number));
}

TEST(InputStream, picks_its_joints_out_of_a_whole_body) {
  const auto model = few_walks_model();
  const Body& body = *model->body;
  std::vector<float> pose;
  for (std::size_t i = 0; i < 3 * body.references.size(); ++i)
    pose.push_back(0.001f * static_cast<float>(i));
  InputStream stream(model);
  EXPECT_EQ(stream.push_body(0, std::span(pose).first(9)), FrameClock::Arrival::rejected);
  EXPECT_NE(stream.push_body(0, pose), FrameClock::Arrival::rejected);
  ASSERT_TRUE(stream.next());
  for (std::size_t i = 0; i < body.input_joints.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(stream.values()[3 * i + axis], pose[3 * body.input_joints[i] + axis], 1e-6);
}

TEST(InputStream, takes_the_heading_out_of_hips_that_come_turned_in_the_world) {
  Model turned = *few_walks_model();
  const int hips = body_roles(*turned.body).hips;
  turned.body->input_joints.front() = hips;
  const auto model = std::make_shared<const Model>(turned);
  const Eigen::Quaternionf reference = model->body->references[hips].cast<float>();
  InputStream straight(model), round(model);
  for (int frame = 0; frame < 60; ++frame) {
    const Eigen::Quaternionf swing(Eigen::AngleAxisf(
        0.1f * std::sin(0.2f * static_cast<float>(frame)), Eigen::Vector3f::UnitX()));
    const Eigen::Quaternionf standing = swing * reference;
    straight.set_rotation(0, standing);
    round.set_rotation(0, about_vertical(1.2f) * standing);
    const double time = frame / 30.0;
    straight.push_collected(time), round.push_collected(time);
    ASSERT_TRUE(straight.next() && round.next());
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(straight.values()[axis], round.values()[axis], 2e-6);
  }
}

TEST(InputStream, holds_what_is_missing_and_refuses_what_is_no_number) {
  const auto model = std::make_shared<const Model>(testing::random_model());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  InputStream stream(model);
  EXPECT_NE(stream.push(0, std::vector<float>{1, 2, 3, 4, 5}), FrameClock::Arrival::rejected);
  ASSERT_TRUE(stream.next());
  EXPECT_EQ(stream.values()[1], 2);
  EXPECT_EQ(stream.push(0.1, std::vector<float>{1, nan, 3, 4, 5}), FrameClock::Arrival::rejected);
  EXPECT_EQ(stream.push(0.1, std::vector<float>{1, 2}), FrameClock::Arrival::rejected);
  EXPECT_FALSE(stream.set_values(0, std::vector<float>{1, 2, nan, 3, 4}));
  EXPECT_FALSE(stream.set_values(1, std::vector<float>{1, 2, 3, 4, 5}));
  EXPECT_FALSE(stream.set_rotation(0, Eigen::Quaternionf::Identity()));
  EXPECT_EQ(stream.push_body(0.1, std::vector<float>(9)), FrameClock::Arrival::rejected);
  stream.set_missing(0, true);
  EXPECT_EQ(stream.push(1.0 / 30, std::vector<float>{1, nan, 3, 4, 9}),
            FrameClock::Arrival::accepted);
  ASSERT_TRUE(stream.next());
  EXPECT_EQ(stream.values()[1], 2);
  EXPECT_EQ(stream.values()[4], 5);
}

}  // namespace
}  // namespace gait
