// Damaged label files.
#include <gtest/gtest.h>

#include <cmath>

#include "fuzz/damage.h"
#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/files/label_file.h"

namespace gait {
namespace {

using testing::Damage;
using testing::fuzz_rounds;

TEST(LabelFuzz, a_damaged_file_is_an_error_or_steps_in_order) {
  const CorpusWalk walk = make_walk({.style = corpus_style("cool")});
  const std::vector<LabelSegment> steps = labels_from_contacts(walk.contacts, walk.clip.frame_rate);
  const std::string files[] = {labels_text(steps, LabelForm::audacity),
                               labels_text(steps, LabelForm::htk)};
  Damage damage(2,
                {"right", "left", "R", "l", "nan", "inf", "-1", "1e300", "0", "9223372036854775807",
                 "99999999999999999999", "1e-400", "\\", "right\tleft", "\xff\xfe", "0.5"});
  int read = 0, refused = 0, with_steps = 0;
  for (int round = 0; round < fuzz_rounds(20000); ++round) {
    const std::string text = damage.of(files[damage.below(2)]);
    try {
      const LabelFile file = parse_labels(text, "damaged");
      for (const LabelSegment& segment : file.segments) {
        ASSERT_TRUE(std::isfinite(segment.start) && std::isfinite(segment.end)) << text;
        ASSERT_GE(segment.start, 0) << text;
        ASSERT_LE(segment.start, segment.end) << text;
      }
      ++read;
      const std::vector<Contact> contacts = contacts_from_labels(file.segments, 30);
      with_steps += !contacts.empty();
      for (std::size_t i = 0; i < contacts.size(); ++i) {
        ASSERT_GE(contacts[i].frame, i == 0 ? 0 : contacts[i - 1].frame) << text;
      }
    } catch (const Error& error) {
      ASSERT_STRNE(error.what(), "");
      ++refused;
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(with_steps, 500);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace gait
