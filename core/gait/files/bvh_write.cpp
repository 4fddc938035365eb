#include <array>
#include <charconv>
#include <cmath>

#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/platform/whole_file.h"

namespace gait {
namespace {

// The shortest text that reads back as the same double; an exponent only where it must be, as some
// readers know none.
void append(std::string& text, double value) {
  std::array<char, 64> digits;
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 1e-5 && size < 1e15);
  const auto end = plain ? std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                         std::chars_format::fixed)
                         : std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end.ptr);
}

void append_offset(std::string& text, const Eigen::Vector3d& offset) {
  text += "OFFSET";
  for (int axis = 0; axis < 3; ++axis) {
    text += ' ';
    append(text, offset[axis]);
  }
  text += '\n';
}

// Writes joints children after their parent, as nesting demands, whatever the skeleton's order;
// keeps the order written for the columns.
class HierarchyWriter {
 public:
  HierarchyWriter(const BvhFile& file, std::string& text)
      : file_(file), text_(text), children_(file.skeleton.joints.size()) {
    for (int joint = 0; joint < file.skeleton.size(); ++joint)
      if (const int parent = file.skeleton.joints[joint].parent; parent >= 0)
        children_[parent].push_back(joint);
  }

  std::vector<int> write() {
    text_ += "HIERARCHY\n";
    for (int joint = 0; joint < file_.skeleton.size(); ++joint)
      if (file_.skeleton.joints[joint].parent < 0) write_joint(joint, 0);
    return std::move(order_);
  }

 private:
  void write_joint(int index, int depth) {
    const Joint& joint = file_.skeleton.joints[index];
    if (joint.name.empty() || joint.name.find_first_of("{}\r\n") != std::string::npos)
      throw Error(file_.name + ": expected a name that a BVH file can hold for joint " +
                  std::to_string(index) + ", found '" + joint.name + "'");
    order_.push_back(index);
    line(depth) += depth == 0 ? "ROOT " : "JOINT ";
    text_ += joint.name + '\n';
    line(depth) += "{\n";
    append_offset(line(depth + 1), joint.offset);
    line(depth + 1) += "CHANNELS " + std::to_string(file_.channels[index].size());
    for (const Channel channel : file_.channels[index]) {
      text_ += ' ';
      text_ += channel_names[static_cast<std::size_t>(channel)];
    }
    text_ += '\n';
    for (const Eigen::Vector3d& tip : joint.tips) {
      line(depth + 1) += "End Site\n";
      line(depth + 1) += "{\n";
      append_offset(line(depth + 2), tip);
      line(depth + 1) += "}\n";
    }
    for (const int child : children_[index]) write_joint(child, depth + 1);
    line(depth) += "}\n";
  }

  std::string& line(int depth) { return text_.append(static_cast<std::size_t>(depth), '\t'); }

  const BvhFile& file_;
  std::string& text_;
  std::vector<std::vector<int>> children_;
  std::vector<int> order_;
};

}  // namespace

std::string bvh_text(const BvhFile& file) {
  std::string text;
  const std::vector<int> order = HierarchyWriter(file, text).write();
  std::vector<Eigen::Index> first_column(file.channels.size(), 0);
  for (std::size_t joint = 1; joint < file.channels.size(); ++joint)
    first_column[joint] =
        first_column[joint - 1] + static_cast<Eigen::Index>(file.channels[joint - 1].size());

  text += "MOTION\nFrames: " + std::to_string(file.values.rows()) + "\nFrame Time: ";
  append(text, file.frame_time);
  text += '\n';
  for (Eigen::Index frame = 0; frame < file.values.rows(); ++frame) {
    const std::size_t begin = text.size();
    for (const int joint : order)
      for (std::size_t n = 0; n < file.channels[joint].size(); ++n) {
        if (text.size() > begin) text += ' ';
        append(text, file.values(frame, first_column[joint] + static_cast<Eigen::Index>(n)));
      }
    text += '\n';
  }
  return text;
}

void write_bvh(const BvhFile& file, const std::filesystem::path& path) {
  write_whole_file(path, bvh_text(file));
}

}  // namespace gait
