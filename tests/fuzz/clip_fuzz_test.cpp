// Damaged BVH files all the way from text to what is learnt from.
#include <gtest/gtest.h>

#include <fstream>

#include "fuzz/damage.h"
#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/learn/cycles.h"
#include "gait/learn/walk_sequences.h"
#include "gait/motion/body_form.h"
#include "gait/motion/body_frame.h"
#include "gait/motion/contacts.h"
#include "gait/motion/joint_roles.h"

namespace gait {
namespace {

using testing::Damage;
using testing::fuzz_rounds;

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string text_of_case(const std::string& name) {
  std::ifstream stream(std::filesystem::path(GAIT_TEST_CASES) / (name + ".bvh"));
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A walk of five seconds as several programs would write it.
std::vector<std::string> whole_files() {
  Clip clip = make_walk({.style = corpus_style("proud")}).clip;
  const std::size_t joints = clip.skeleton.joints.size();
  clip.rotations.resize(150 * joints);
  clip.translations.resize(std::min<std::size_t>(clip.translations.size(), 150 * joints));
  const std::string text = bvh_text(bvh_from_clip(clip));
  return {text,
          replaced(text, "\n", "\r\n"),
          replaced(text, " ", "\t"),
          replaced(text, "Zrotation Xrotation Yrotation", "Xrotation Yrotation Zrotation"),
          replaced(text, " 0.", " 0.0000000000e+00 0.").substr(0, text.size()),
          text_of_case("root-at-head"),
          text_of_case("offsets-in-channels")};
}

TEST(ClipFuzz, a_damaged_file_is_an_error_or_a_walk_that_can_be_followed) {
  const std::vector<std::string> files = whole_files();
  Damage damage(1, {"nan",      "-inf",     "1e308",     "-1e308",       "1e-320",     "0",
                    "-1",       "1e9",      "179.99999", "999999999999", "4294967296", "{",
                    "}",        "JOINT",    "ROOT",      "End",          "Site",       "MOTION",
                    "Frames:",  "CHANNELS", "OFFSET",    "Xrotation",    "Yposition",  "Hips",
                    "LeftFoot", "\"",       "1,5",       "0x10",         "Time:"});
  int followed = 0, refused = 0;
  for (int round = 0; round < fuzz_rounds(400); ++round) {
    const std::string text = damage.of(files[damage.below(files.size())]);
    try {
      const BvhFile file = parse_bvh(text, "damaged");
      const Clip in_file = body_form(clip_from_bvh(file)).clip;
      const JointRoles roles = find_roles(in_file);
      Walk walk;
      walk.clip = in_metres_y_up(in_file, guess_body_frame(in_file, roles));
      for (const Eigen::Quaterniond& rotation : walk.clip.rotations)
        ASSERT_NEAR(rotation.norm(), 1, 1e-6) << text;
      const WalkTrack track = follow_walk(walk.clip, roles);
      for (const Contact& contact : track.contacts) {
        ASSERT_GE(contact.frame, 0) << text;
        ASSERT_LT(contact.frame, walk.clip.frames()) << text;
      }
      straight_cycles(track);
      const WalkSequences sequences = walk_sequences({walk}, {});
      for (const Sequence& sequence : sequences.sequences) {
        ASSERT_TRUE(sequence.inputs.allFinite()) << text;
        ASSERT_TRUE(sequence.outputs.allFinite()) << text;
      }
      cut_cycles({walk}, sequences.body, 40, {});
      ++followed;
    } catch (const Error& error) {
      ASSERT_STRNE(error.what(), "");
      ++refused;
    }
  }
  EXPECT_GT(followed, 40);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace gait
