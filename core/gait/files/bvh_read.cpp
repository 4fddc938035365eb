#include <cmath>
#include <utility>

#include "gait/files/bvh.h"
#include "gait/files/bvh_cursor.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"

namespace gait {
namespace {

// Far above any rig, far below what would hurt: a file beyond these is damaged.
constexpr std::size_t deepest_nesting = 200;
constexpr int most_joints = 10000;
constexpr long long most_channels_per_joint = 32;
constexpr long long most_frames = 1'000'000'000;

Eigen::Vector3d read_offset(BvhCursor& cursor) {
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis) offset[axis] = cursor.number("one of the three of OFFSET");
  return offset;
}

Channel read_channel(BvhCursor& cursor, std::string_view joint) {
  const std::string_view word = cursor.peek();
  for (std::size_t i = 0; i < channel_names.size(); ++i)
    if (same_word(word, channel_names[i])) {
      cursor.word();
      return static_cast<Channel>(i);
    }
  cursor.fail("expected a channel of joint " + in_quotes(joint) +
              " (Xposition ... Zrotation, as many as CHANNELS says), found " +
              (word.empty() ? "the end of the file" : in_quotes(word)));
}

std::vector<Channel> read_channels(BvhCursor& cursor, std::string_view joint) {
  const long long count = cursor.count("the number of channels", 0, most_channels_per_joint);
  std::vector<Channel> channels;
  channels.reserve(static_cast<std::size_t>(count));
  std::array<bool, 3> placed{};
  for (long long i = 0; i < count; ++i) {
    const Channel channel = read_channel(cursor, joint);
    if (channel <= Channel::z_position) {
      bool& seen = placed[static_cast<std::size_t>(channel)];
      if (seen)
        cursor.fail("expected each position channel once, found it twice in joint " +
                    in_quotes(joint));
      seen = true;
    }
    channels.push_back(channel);
  }
  return channels;
}

// The body of a joint between its braces is read without recursion: `open` holds the joints whose
// brace is open, so that a hostile file cannot exhaust the stack.
class HierarchyReader {
 public:
  HierarchyReader(BvhCursor& cursor, BvhFile& file) : cursor_(cursor), file_(file) {}

  void read() {
    cursor_.require("HIERARCHY", "at the start of a BVH file (is it one?)");
    if (!same_word(cursor_.peek(), "ROOT")) cursor_.require("ROOT", "after HIERARCHY");
    while (cursor_.take("ROOT")) {
      begin_joint(-1);
      while (!open_.empty()) read_item();
    }
  }

 private:
  struct Open {
    int joint;
    bool has_offset, has_channels;
  };

  void begin_joint(int parent) {
    if (open_.size() >= deepest_nesting)
      cursor_.fail("expected joints nested at most " + std::to_string(deepest_nesting) +
                   " deep, found one deeper");
    if (file_.skeleton.size() >= most_joints)
      cursor_.fail("expected at most " + std::to_string(most_joints) + " joints, found more");
    const std::string_view name = cursor_.rest_of_line();
    if (name.empty()) cursor_.fail("expected the joint's name, found none");
    cursor_.require("{", "to open joint " + in_quotes(name));
    file_.skeleton.joints.push_back({std::string(name), parent, Eigen::Vector3d::Zero(), {}});
    file_.channels.emplace_back();
    open_.push_back({file_.skeleton.size() - 1, false, false});
  }

  void read_item() {
    Open& top = open_.back();
    Joint& joint = file_.skeleton.joints[top.joint];
    if (cursor_.take("}")) {
      if (!top.has_offset)
        cursor_.fail("expected OFFSET in joint " + in_quotes(joint.name) + ", found none");
      open_.pop_back();
    } else if (!top.has_offset && cursor_.take("OFFSET")) {
      joint.offset = read_offset(cursor_);
      top.has_offset = true;
    } else if (!top.has_channels && cursor_.take("CHANNELS")) {
      file_.channels[top.joint] = read_channels(cursor_, joint.name);
      top.has_channels = true;
    } else if (cursor_.take("JOINT")) {
      begin_joint(top.joint);
    } else if (cursor_.take("End")) {
      cursor_.rest_of_line();  // "Site", or what some call it
      cursor_.require("{", "to open the end site of joint " + in_quotes(joint.name));
      cursor_.require("OFFSET", "in the end site of joint " + in_quotes(joint.name));
      joint.tips.push_back(read_offset(cursor_));
      cursor_.require("}", "to close the end site of joint " + in_quotes(joint.name));
    } else {
      fail_in(top, joint.name);
    }
  }

  [[noreturn]] void fail_in(const Open& top, const std::string& joint) {
    std::string expected = "expected ";
    if (!top.has_offset) expected += "OFFSET, ";
    if (!top.has_channels) expected += "CHANNELS, ";
    const std::string_view word = cursor_.peek();
    cursor_.fail(expected + "JOINT, 'End Site' or '}' in joint " + in_quotes(joint) + ", found " +
                 (word.empty() ? "the end of the file" : in_quotes(word)));
  }

  BvhCursor& cursor_;
  BvhFile& file_;
  std::vector<Open> open_;
};

// What is said of rows in messages.
std::string rows_told(long long announced) {
  return "expected " + std::to_string(announced) + " rows as 'Frames:' says, found ";
}

// The row that the cursor is in is not `columns` numbers.
[[noreturn]] void fail_in_row(BvhCursor& cursor, std::size_t columns, std::size_t found,
                              long long row) {
  if (found < columns && cursor.skip_blanks()) cursor.number("a channel's value");
  cursor.fail("expected " + std::to_string(columns) + " values in the row of frame " +
              std::to_string(row + 1) + ", found " +
              (found == columns ? "more" : std::to_string(found)));
}

void read_rows(BvhCursor& cursor, BvhFile& file, long long announced) {
  std::size_t columns = 0;
  for (const auto& channels : file.channels) columns += channels.size();
  if (columns == 0) {
    if (announced > 0) cursor.fail("expected at least one channel in the hierarchy, found none");
    return;
  }
  // Room follows from what the file holds, not from what its header says: a value takes two bytes
  // at least.
  const auto width = static_cast<Eigen::Index>(columns);
  const auto most_rows = static_cast<Eigen::Index>((cursor.bytes_left() / 2 + 1) / columns + 1);
  file.values.resize(std::min<Eigen::Index>(announced, most_rows), width);
  Eigen::Index rows = 0;
  bool cut = false;
  while (!cut && cursor.next_line()) {
    if (rows == file.values.rows())
      file.values.conservativeResize(std::min(2 * rows + 16, most_rows), width);
    const std::size_t found = cursor.numbers_in_line({file.values.row(rows).data(), columns});
    // A recording that broke off, in the middle of its last row.
    cut = found < columns && cursor.breaks_off();
    if (!cut && (found < columns || cursor.skip_blanks()))
      fail_in_row(cursor, columns, found, rows);
    rows += cut ? 0 : 1;
  }
  // Where a row is missing and the last line does not end, its last number may not be whole.
  if (!cut && rows < announced && !cursor.ends_with_a_line() && rows > 0) {
    cut = true;
    --rows;
  }
  if (rows == 0 && announced > 0)
    cursor.fail(rows_told(announced) + (cut ? "none that is whole" : "none"));
  if (cut || rows != announced)
    file.warnings.push_back(cursor.here(
        rows_told(announced) + std::to_string(rows) +
        (cut ? " whole ones, and the last one cut; the whole ones are used" : "; all are used")));
  if (rows != file.values.rows()) file.values.conservativeResize(rows, width);
}

}  // namespace

BvhFile parse_bvh(std::string_view text, std::string name) {
  BvhFile file;
  file.name = std::move(name);
  BvhCursor cursor(text, file.name);
  if (!cursor.skip_space()) cursor.fail("expected HIERARCHY, found an empty file");
  HierarchyReader(cursor, file).read();
  cursor.require("MOTION", "after the hierarchy");
  cursor.require_title("Frames");
  const long long frames = cursor.count("the number of frames", 0, most_frames);
  if (frames == 0) file.warnings.push_back(cursor.here("'Frames:' says there are none"));
  cursor.require_title("Frame Time");
  file.frame_time = cursor.number("the frame time in seconds");
  if (file.frame_time < 1e-6)
    cursor.fail("expected a frame time above a microsecond, found " +
                std::to_string(file.frame_time) + " s");
  if (file.frame_time > 1)
    file.warnings.push_back(cursor.here("a frame time of " + std::to_string(file.frame_time) +
                                        " s is unusually long; is it frames per second?"));
  if (cursor.skip_blanks())
    cursor.fail("expected the end of the line after the frame time, found " +
                in_quotes(cursor.peek()));
  read_rows(cursor, file, frames);
  return file;
}

BvhFile read_bvh(const std::filesystem::path& path) {
  return parse_bvh(read_whole_file(path, "a BVH file"), utf8_of(path));
}

}  // namespace gait
