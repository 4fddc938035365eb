#include "gait/model/stream_layout.h"

#include <gtest/gtest.h>

#include <limits>

namespace gait {
namespace {

// A body of four joints whose streams lie between plain ones.
Model mixed_model() {
  Model model;
  model.inputs = {{"pressure", 2, StreamKind::plain}, {"spine"}, {"arm"}};
  model.outputs = {{"hips"}, {"light", 1, StreamKind::plain}};
  Body body;
  body.skeleton.joints.resize(4);
  body.input_joints = {2, 3};
  body.output_joints = {0};
  model.body = body;
  return model;
}

TEST(StreamLayout, tells_where_values_lie_and_which_joint_they_turn) {
  const StreamLayout inputs = StreamLayout::of_inputs(mixed_model());
  ASSERT_EQ(inputs.streams(), 3);
  EXPECT_EQ(inputs.values(), 8);
  EXPECT_EQ(inputs.values(StreamKind::rotation), 6);
  EXPECT_EQ(inputs.values(StreamKind::plain), 2);
  EXPECT_EQ(inputs[0].joint, -1);
  EXPECT_EQ(inputs[1].begin, 2);
  EXPECT_EQ(inputs[1].joint, 2);
  EXPECT_EQ(inputs[2].begin, 5);
  EXPECT_EQ(inputs[2].joint, 3);
  EXPECT_EQ(StreamLayout::of_outputs(mixed_model())[1].begin, 3);
}

TEST(StreamLayout, of_all_streams_goes_on_from_inputs_to_outputs) {
  const StreamLayout all = StreamLayout::of_all(mixed_model());
  ASSERT_EQ(all.streams(), 5);
  EXPECT_EQ(all[3].begin, 8);
  EXPECT_EQ(all.stream_of(0), 3);
  EXPECT_EQ(all.stream_of(3), 2);
  EXPECT_EQ(all.stream_of(1), -1);
  EXPECT_EQ(all.stream_of(-1), -1) << "plain streams turn no joint";
}

TEST(StreamLayout, of_a_body_has_every_joint_and_without_one_none) {
  Model model = mixed_model();
  const StreamLayout pose = StreamLayout::of_body(*model.body);
  ASSERT_EQ(pose.streams(), 4);
  EXPECT_EQ(pose[2].begin, 6);
  EXPECT_EQ(pose[2].joint, 2);
  model.body.reset();
  for (const StreamPlace& place : StreamLayout::of_all(model)) EXPECT_EQ(place.joint, -1);
}

TEST(StreamLayout, values_fit_that_are_as_many_and_finite) {
  const StreamLayout inputs = StreamLayout::of_inputs(mixed_model());
  const float good[] = {1, 2}, bad[] = {1, std::numeric_limits<float>::infinity()};
  EXPECT_TRUE(inputs.fits(0, good));
  EXPECT_FALSE(inputs.fits(0, bad));
  EXPECT_FALSE(inputs.fits(1, good));
  EXPECT_FALSE(inputs.fits(3, good));
  EXPECT_FALSE(inputs.fits(-1, good));
}

}  // namespace
}  // namespace gait
