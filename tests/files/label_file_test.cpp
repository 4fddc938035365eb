#include "gait/files/label_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "files/small_bvh.h"
#include "gait/error.h"

namespace gait {
namespace {

TEST(LabelFile, htk_and_audacity_are_told_apart) {
  const LabelFile htk =
      parse_labels("0 5600000 right\n5600000 11000000 left -12.5\r\n", "steps.lab");
  EXPECT_EQ(htk.form, LabelForm::htk);
  EXPECT_EQ(htk.segments, (std::vector<LabelSegment>{{0, 0.56, "right"}, {0.56, 1.1, "left"}}));

  const LabelFile audacity = parse_labels(
      "\xEF\xBB\xBF"
      "0.000000\t0.560000\tright\n\\\t100\t200\n\n1\t2\ta label of words\n",
      "steps.txt");
  EXPECT_EQ(audacity.form, LabelForm::audacity);
  EXPECT_EQ(audacity.segments,
            (std::vector<LabelSegment>{{0, 0.56, "right"}, {1, 2, "a label of words"}}));

  // Whole seconds with tabs are Audacity's, seconds with spaces too.
  EXPECT_EQ(parse_labels("0\t1\tright", "x").segments[0].end, 1);
  EXPECT_EQ(parse_labels("0.5 1.5 right", "x").segments[0].end, 1.5);
  EXPECT_TRUE(parse_labels("", "x").segments.empty());
}

TEST(LabelFile, what_was_written_reads_back) {
  const testing::TemporaryFolder folder;
  const std::vector<LabelSegment> segments{
      {0, 0.5333333, "right"}, {0.5333333, 1.1, "left"}, {100.25, 3600.5, "left"}};
  for (const LabelForm form : {LabelForm::htk, LabelForm::audacity}) {
    write_labels(segments, form, folder / "steps");
    const LabelFile file = read_labels(folder / "steps");
    EXPECT_EQ(file.form, form);
    ASSERT_EQ(file.segments.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(file.segments[i].start, segments[i].start, 5.1e-7);
      EXPECT_NEAR(file.segments[i].end, segments[i].end, 5.1e-7);
      EXPECT_EQ(file.segments[i].label, segments[i].label);
    }
  }
  EXPECT_EQ(labels_text({{0, 0.56, "right"}}, LabelForm::htk), "0 5600000 right\n");
  EXPECT_EQ(labels_text({{0, 0.56, "right"}}, LabelForm::audacity), "0.000000\t0.560000\tright\n");
  EXPECT_THROW(write_labels(segments, LabelForm::htk, folder / "missing/steps"), Error);
  EXPECT_THROW(read_labels(folder / "missing"), Error);
}

TEST(LabelFile, labels_that_a_form_cannot_hold_are_errors) {
  EXPECT_THROW(labels_text({{0, 1, "two words"}}, LabelForm::htk), Error);
  EXPECT_NO_THROW(labels_text({{0, 1, "two words"}}, LabelForm::audacity));
  EXPECT_THROW(labels_text({{0, 1, "two\nlines"}}, LabelForm::audacity), Error);
  EXPECT_THROW(labels_text({{0, 1, ""}}, LabelForm::audacity), Error);
  EXPECT_THROW(labels_text({{1, 0, "a"}}, LabelForm::htk), Error);
}

// At every frame rate and in both forms: rounding to the file's digits moves no contact.
TEST(LabelFile, contacts_survive_the_way_through_a_file) {
  std::mt19937 random(4);
  for (const double rate : {23.976, 30.0, 60.0, 120.0, 240.0})
    for (const LabelForm form : {LabelForm::htk, LabelForm::audacity}) {
      std::vector<Contact> contacts;
      int frame = 3;
      for (int i = 0; i < 200; ++i) {
        contacts.push_back({frame, i % 2 ? Foot::left : Foot::right});
        frame += 1 + static_cast<int>(random() % 200);
      }
      const std::string text = labels_text(labels_from_contacts(contacts, rate), form);
      EXPECT_EQ(contacts_from_labels(parse_labels(text, "x").segments, rate), contacts) << rate;
    }
}

TEST(LabelFile, a_pause_between_steps_keeps_both_ends) {
  const std::vector<Contact> contacts{
      {0, Foot::right}, {10, Foot::left}, {30, Foot::left}, {40, Foot::right}};
  EXPECT_EQ(contacts_from_labels(labels_from_contacts(contacts, 30), 30), contacts);
  // Other labels are no steps, any order will do, and R and L are feet.
  EXPECT_EQ(contacts_from_labels({{1, 1.5, "L"}, {0.5, 1, "wait"}, {0, 0.5, "RIGHT"}}, 30),
            (std::vector<Contact>{
                {0, Foot::right}, {15, Foot::left}, {30, Foot::left}, {45, Foot::right}}));
}

TEST(LabelFile, steps_that_cannot_be_are_errors) {
  EXPECT_THROW(contacts_from_labels({{0, 1, "right"}, {1, 2, "right"}}, 30), Error);
  EXPECT_THROW(contacts_from_labels({{0, 1, "right"}, {0.8, 2, "left"}}, 30), Error);
  EXPECT_THROW(contacts_from_labels({{0, 0.01, "right"}}, 30), Error);
  EXPECT_THROW(contacts_from_labels({{0, 1e8, "right"}}, 1000), Error);
}

TEST(LabelFile, faults_are_named_with_file_and_line) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"0 100 right\nnonsense\n", "steps:2: expected 'start end label'"},
      {"0 100\n", "steps:1: expected 'start end label'"},
      {"0.0\t1.0\n", "steps:1: expected 'start end label'"},
      {"a\t1.0\tright\n", "steps:1: expected a time in seconds, found 'a'"},
      {"0\tnan\tright\n", "steps:1: expected a finite time"},
      {"0\tinf\tright\n", "steps:1: expected a finite time"},
      {"-1\t1\tright\n", "steps:1: expected a finite time"},
      {"0,5\t1,5\tright\n", "steps:1: expected a time in seconds, found '0,5'"},
      {"0\t1e300\tright\n", "steps:1: expected a finite time"},
      {"\n1\t0.5\tright\n", "steps:2: expected an end that is not before its start"},
      {"0 99999999999999999999999 right\n", "steps:1: expected"},
      {"0 100 right\n0.5\t1.0\tleft\n", "steps:2: expected whole numbers of 100 ns"},
      {"0.5\t1.0\tleft\n1 2 left\n", "steps:2: expected seconds and tabs"}};
  for (const auto& [text, said] : faults) try {
      parse_labels(text, "steps");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, said.size()), said);
    }
}

}  // namespace
}  // namespace gait
