// Label files: labels with their times of start and end, in HTK's and Audacity's form.
//
// HTK:      `0 5600000 right`, times as whole numbers of 100 ns, separated by spaces.
// Audacity: `0.000000<tab>0.560000<tab>right`, times in seconds, separated by tabs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gait/motion/steps.h"

namespace gait {

struct LabelSegment {
  double start = 0, end = 0;  // seconds
  std::string label;

  friend bool operator==(const LabelSegment&, const LabelSegment&) = default;
};

enum class LabelForm { htk, audacity };

struct LabelFile {
  LabelForm form = LabelForm::audacity;
  std::vector<LabelSegment> segments;  // in the file's order
};

// Reads a label file, of either form: whole numbers with no tab between them are HTK's. Throws
// Error with file and line where a line is not `start end label`, times are negative, not finite or
// run backwards, or forms mix. HTK's scores after the label and Audacity's lines of frequencies
// (they start with a backslash) are passed over. An empty file has no segments.
LabelFile read_labels(const std::filesystem::path& path);
LabelFile parse_labels(std::string_view text, const std::string& name);

// Writes a label file; it appears whole or not at all. HTK's form keeps 100 ns, Audacity's a
// microsecond. Throws Error when the file cannot be written, or when the form cannot hold a label:
// an empty one, one with a line end, or one with white space in HTK's form.
void write_labels(const std::vector<LabelSegment>& segments, LabelForm form,
                  const std::filesystem::path& path);
std::string labels_text(const std::vector<LabelSegment>& segments, LabelForm form);

// Labels for steps: `right` or `left` from one foot's contact to the other's, in seconds from frame
// 0.
std::vector<LabelSegment> labels_from_contacts(const std::vector<Contact>& contacts,
                                               double frame_rate);

// Labels of a clip that begins `start` seconds later than the one they were written for. What ends
// before it is left out.
std::vector<LabelSegment> labels_from(std::vector<LabelSegment> segments, double start);

// Contacts for labels: one at the start of each step, and one of the other foot at the end of a
// step without a successor. Labels of steps are right, left, r and l in any case; others are
// ignored. A contact is at the frame nearest to its time. Throws Error, with the time, when steps
// overlap or a foot steps twice in succession.
std::vector<Contact> contacts_from_labels(std::vector<LabelSegment> segments, double frame_rate);

}  // namespace gait
