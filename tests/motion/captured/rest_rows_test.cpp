// Rest poses at the ends of a clip are found by the jump, and nothing else is.
#include "gait/motion/captured/rest_rows.h"

#include <gtest/gtest.h>

#include "files/small_bvh.h"
#include "gait/files/bvh.h"
#include "gait/motion/contacts.h"
#include "motion/walked_ways.h"
#include "shared_data.h"

namespace gait {
namespace {

using testing::walk_in;

enum class Pose { t, straight, like_frame };

struct Held {
  int rows;
  Pose pose;
  Eigen::Vector3d place;  // of the root, metres
  double tremble = 0;     // radians from row to row
};

// The walk with rows before it, or behind.
Clip with_rest(const Clip& walk, const Held& held, bool behind = false) {
  Clip clip = walk;
  clip.resize(walk.frames() + held.rows);
  const JointRoles roles = find_roles(walk.skeleton);
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const int from = behind ? frame : frame - held.rows;
    if (from >= 0 && from < walk.frames()) {
      std::copy(walk.pose(from).begin(), walk.pose(from).end(), clip.pose(frame).begin());
      std::copy(walk.translation(from).begin(), walk.translation(from).end(),
                clip.translation(frame).begin());
      continue;
    }
    if (held.pose == Pose::like_frame)
      std::copy(walk.pose(walk.frames() / 2).begin(), walk.pose(walk.frames() / 2).end(),
                clip.pose(frame).begin());
    if (held.pose == Pose::t)
      for (const auto& [role, sign] : {std::pair{Role::left_arm, 1.0}, {Role::right_arm, -1.0}})
        clip.pose(frame)[roles.joint(role)] = exponential_map<double>({0, 0, sign * 1.4});
    clip.pose(frame)[roles.joint(Role::spine)] =
        exponential_map<double>({held.tremble * (frame % 3 - 1), 0, 0});
    clip.translation(frame)[0] = held.place;
  }
  return clip;
}

TEST(RestRows, are_found_by_the_jump_wherever_they_stand_and_however_long) {
  const Clip walk = walk_in("neutral").clip;
  const std::vector<Held> ways{{1, Pose::t, {0, 0, 0}},
                               {1, Pose::straight, {0, 0.95, 0}},
                               {1, Pose::straight, walk.translation(0)[0]},
                               {1, Pose::t, {4, 1, -7}},
                               {2, Pose::t, walk.translation(0)[0]},
                               {60, Pose::t, {0, 0.9, 0}, 0.004},
                               {400, Pose::straight, {0, 0, 0}, 0.002},
                               {45, Pose::like_frame, {3, 0, 3}}};
  for (const Held& held : ways) {
    const Clip clip = with_rest(walk, held);
    const MovingRows rows = moving_rows(clip);
    EXPECT_EQ(rows.begin, held.rows);
    EXPECT_EQ(rows.end, clip.frames());
    EXPECT_EQ(rows_of(clip, rows).rotations.size(), walk.rotations.size());
    const MovingRows at_both = moving_rows(with_rest(clip, held, true));
    EXPECT_EQ(at_both.begin, held.rows);
    EXPECT_EQ(at_both.end, clip.frames());
  }
}

TEST(RestRows, leave_the_walk_as_it_is_without_them) {
  const CorpusWalk walk = walk_in("neutral");
  const Clip clip = with_rest(walk.clip, {20, Pose::t, {0, 0, 0}});
  const Clip found = rows_of(clip, moving_rows(clip));
  EXPECT_EQ(follow_walk(found, find_roles(found.skeleton)).contacts,
            follow_walk(walk.clip, find_roles(walk.clip.skeleton)).contacts);
}

// Somebody who stands and then walks off does not jump.
TEST(RestRows, are_not_where_a_body_stands_before_it_walks) {
  for (const WalkStyle& style : corpus_styles()) {
    const Clip walk = walk_in(style.name, 3).clip;
    EXPECT_TRUE(moving_rows(walk).are_all_of(walk)) << style.name;
    Clip stands = with_rest(walk, {30, Pose::straight, {0, 0, 0}});
    for (int frame = 0; frame < 30; ++frame) {
      std::copy(walk.pose(0).begin(), walk.pose(0).end(), stands.pose(frame).begin());
      stands.translation(frame)[0] = walk.translation(0)[0];
    }
    EXPECT_TRUE(moving_rows(stands).are_all_of(stands)) << style.name;
  }
}

TEST(RestRows, are_in_no_captured_walk) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-1");
  for (const char* folder : {"bandai-namco-1", "bandai-namco-2", "cmu-walks"})
    for (const auto& path : testing::bvh_files_below(testing::shared_data() / folder)) {
      const Clip clip = clip_from_bvh(read_bvh(path));
      EXPECT_TRUE(moving_rows(clip).are_all_of(clip)) << path;
    }
}

}  // namespace
}  // namespace gait
