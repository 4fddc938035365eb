// Feet on the ground, knees that bend like a person's, contacts that are true.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "gait/motion/contacts.h"
#include "gait/motion/rotation.h"
#include "walked_body.h"

namespace gait {
namespace {

using testing::corpus;
using testing::sole;
using testing::sole_height;
using testing::walked_body;

// Height at which a sole counts as down: rounding, not motion.
constexpr double on_ground = 1e-6;

TEST(CorpusFeet, knees_never_bend_forward) {
  for (const CorpusWalk& walk : corpus())
    for (const char* name : {"LeftLeg", "RightLeg"}) {
      const auto knee = static_cast<std::size_t>(walk.clip.skeleton.find(name));
      for (int frame = 0; frame < walk.clip.frames(); ++frame) {
        const Eigen::Vector3d bent = rotation_vector(walk.clip.pose(frame)[knee]);
        // Some six degrees is the straightest a leg gets; 110 is far from a heel at the thigh.
        ASSERT_GT(bent.x(), 0.10) << walk.clip.name << " frame " << frame;
        ASSERT_LT(bent.x(), 1.95) << walk.clip.name << " frame " << frame;
        ASSERT_LT(std::hypot(bent.y(), bent.z()), 1e-9) << "a knee is a hinge";
      }
    }
}

TEST(CorpusFeet, legs_keep_their_length_and_reach_the_ground_they_stand_on) {
  for (const CorpusWalk& walk : corpus()) {
    const auto& joints = walk.clip.skeleton.joints;
    const auto find = [&](const char* name) {
      return static_cast<std::size_t>(walk.clip.skeleton.find(name));
    };
    for (int frame = 0; frame < walk.clip.frames(); frame += 7) {
      const auto body = walked_body(walk.clip, frame);
      const double thigh = (body.place[find("LeftLeg")] - body.place[find("LeftUpLeg")]).norm();
      const double shank = (body.place[find("LeftFoot")] - body.place[find("LeftLeg")]).norm();
      ASSERT_NEAR(thigh + shank, corpus_leg_length, 1e-9);
      ASSERT_NEAR((body.place[find("RightLeg")] - body.place[find("RightUpLeg")]).norm(), thigh,
                  1e-9);
      for (std::size_t j = 1; j < joints.size(); ++j)
        ASSERT_EQ(walk.clip.translation(frame)[j], joints[j].offset) << "only the hips travel";
    }
  }
}

TEST(CorpusFeet, soles_never_sink_into_the_ground) {
  for (const CorpusWalk& walk : corpus())
    for (int frame = 0; frame < walk.clip.frames(); ++frame) {
      const auto body = walked_body(walk.clip, frame);
      for (const Foot foot : {Foot::right, Foot::left})
        ASSERT_GT(sole_height(walk.clip, body, foot), -on_ground)
            << walk.clip.name << " frame " << frame;
    }
}

TEST(CorpusFeet, a_contact_is_the_first_frame_with_the_sole_down) {
  for (const CorpusWalk& walk : corpus())
    for (const Contact& contact : walk.contacts) {
      const auto height = [&](int frame) {
        return sole_height(walk.clip, walked_body(walk.clip, frame), contact.foot);
      };
      EXPECT_LT(height(contact.frame), on_ground) << walk.clip.name << " " << contact.frame;
      // Falls at the style's landing speed, so it may be near when the contact is just after.
      EXPECT_GT(height(contact.frame - 1), 0) << walk.clip.name << " " << contact.frame;
      EXPECT_GT(height(contact.frame - 2), 1e-3) << walk.clip.name << " " << contact.frame;
    }
}

TEST(CorpusFeet, a_foot_is_down_from_contact_on_and_the_other_foot_lifts_in_between) {
  for (const CorpusWalk& walk : corpus())
    for (std::size_t i = 0; i + 1 < walk.contacts.size(); ++i) {
      const Foot standing = walk.contacts[i].foot;
      int both = 0;
      double lifted = 0;
      for (int frame = walk.contacts[i].frame; frame < walk.contacts[i + 1].frame; ++frame) {
        const auto body = walked_body(walk.clip, frame);
        ASSERT_LT(sole_height(walk.clip, body, standing), on_ground)
            << walk.clip.name << " frame " << frame;
        const double swinging = sole_height(walk.clip, body, other(standing));
        both += swinging < on_ground;
        lifted = std::max(lifted, swinging);
      }
      EXPECT_GE(both, 1) << "no double support: " << walk.clip.name;
      EXPECT_GT(lifted, 0.01) << walk.clip.name;
    }
}

TEST(CorpusFeet, nothing_slides) {
  for (const CorpusWalk& walk : corpus())
    for (const Contact& contact : walk.contacts) {
      // Each end of the sole by itself: while it is down it stays where it is.
      std::array<double, 2> slid{0, 0};
      auto before = sole(walk.clip, walked_body(walk.clip, contact.frame), contact.foot);
      for (int frame = contact.frame + 1; frame < walk.clip.frames(); ++frame) {
        const auto body = walked_body(walk.clip, frame);
        if (sole_height(walk.clip, body, contact.foot) > on_ground) break;
        const auto now = sole(walk.clip, body, contact.foot);
        for (std::size_t end = 0; end < 2; ++end)
          if (now[end].y() < on_ground && before[end].y() < on_ground)
            slid[end] += (now[end] - before[end]).norm();
        before = now;
      }
      EXPECT_LT(slid[0] + slid[1], 0.001) << walk.clip.name << " from frame " << contact.frame;
    }
}

TEST(CorpusFeet, contacts_found_from_the_motion_alone_are_within_a_frame_of_the_exact_ones) {
  for (const CorpusWalk& walk : corpus()) {
    const WalkTrack found = follow_walk(walk.clip, find_roles(walk.clip.skeleton));
    ASSERT_EQ(found.contacts.size(), walk.contacts.size()) << walk.clip.name;
    for (std::size_t i = 0; i < walk.contacts.size(); ++i) {
      EXPECT_EQ(found.contacts[i].foot, walk.contacts[i].foot) << walk.clip.name;
      EXPECT_NEAR(found.contacts[i].frame, walk.contacts[i].frame, 1) << walk.clip.name;
    }
  }
}

TEST(CorpusFeet, tiptoeing_never_puts_a_heel_down_and_the_cat_walks_on_a_line) {
  std::map<std::string, double> width;
  for (const CorpusWalk& walk : corpus()) {
    for (std::size_t i = 1; i < walk.contacts.size(); ++i) {
      const auto body = walked_body(walk.clip, walk.contacts[i].frame);
      const auto right = sole(walk.clip, body, Foot::right),
                 left = sole(walk.clip, body, Foot::left);
      width[walk.style] +=
          (left[1].x() - right[1].x()) / static_cast<double>(walk.contacts.size() - 1);
    }
    if (walk.style != "tiptoeing") continue;
    for (int frame = 0; frame < walk.clip.frames(); ++frame) {
      const auto body = walked_body(walk.clip, frame);
      for (const Foot foot : {Foot::right, Foot::left})
        ASSERT_GT(sole(walk.clip, body, foot)[1].y(), 0.03) << walk.clip.name << " " << frame;
    }
  }
  for (auto& [style, sum] : width) {
    double takes = 0;
    for (const CorpusWalk& walk : corpus()) takes += walk.style == style;
    sum /= takes;
    if (style == "cat-walk")
      EXPECT_LT(sum, 0.02);
    else
      EXPECT_GT(sum, 0.04) << style;
  }
  EXPECT_GT(width["heavy"], 0.16);
  EXPECT_GT(width["drunk"], 0.14);
}

}  // namespace
}  // namespace gait
