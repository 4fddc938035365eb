#include "gait/model/cbor_document.h"

#include <array>
#include <string>

#include "gait/error.h"

namespace gait {

namespace {

// Far above what models need: a joint takes 15 items, a state 20.
constexpr std::size_t most_items = std::size_t{1} << 18;
constexpr std::size_t most_nesting = 16;

// Major types of RFC 8949 §3.1.
enum Major { unsigned_integer, negative_integer, byte_string, text, array, map, tag, simple };

// Walks over the items of a document and gathers two things: the byte strings, and the document
// with numbers in their place.
class Outline {
 public:
  explicit Outline(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  void walk() {
    std::size_t items = 0;
    for (push(1); depth_ > 0;) {
      if (open_[depth_ - 1] == 0) {
        --depth_;
        continue;
      }
      --open_[depth_ - 1];
      if (++items > most_items)
        fail("expected at most " + std::to_string(most_items) + " items, found more");
      item();
    }
    if (at_ != bytes_.size()) fail("expected the end of the document, found more bytes");
  }

  std::vector<std::span<const std::uint8_t>> blobs;
  std::vector<std::uint8_t> lean;

 private:
  struct Head {
    int major = 0, info = 0;
    std::uint64_t argument = 0;
  };

  [[noreturn]] void fail(const std::string& why) const {
    throw Error("byte " + std::to_string(at_) + ": " + why);
  }

  std::size_t left() const { return bytes_.size() - at_; }

  void push(std::uint64_t items) {
    if (depth_ == open_.size())
      fail("expected at most " + std::to_string(most_nesting) + " levels, found more");
    open_[depth_++] = items;
  }

  Head head() {
    if (left() == 0) fail("expected another item, found the end");
    const int first = bytes_[at_];
    Head head{first >> 5, first & 31, 0};
    std::size_t length = 0;
    if (head.info < 24)
      head.argument = static_cast<std::uint64_t>(head.info);
    else if (head.info < 28)
      length = std::size_t{1} << (head.info - 24);
    else
      fail("expected an item of definite length, found " + std::to_string(first));
    if (left() < 1 + length) fail("expected another item, found the end");
    for (std::size_t i = 0; i < length; ++i)
      head.argument = head.argument << 8 | bytes_[at_ + 1 + i];
    at_ += 1 + length;
    return head;
  }

  void keep(std::size_t begin) { lean.insert(lean.end(), &bytes_[begin], bytes_.data() + at_); }

  void item() {
    const std::size_t begin = at_;
    Head found = head();
    if (found.major == tag) {
      if (found.argument != cbor_float64_tag)
        fail("expected no tag but that of float64 arrays, found " + std::to_string(found.argument));
      found = head();
      if (found.major != byte_string) fail("expected bytes after the tag of float64 arrays");
    }
    switch (found.major) {
      case byte_string:
        need(found.argument);
        refer(bytes_.subspan(at_, found.argument));
        at_ += found.argument;
        return;
      case text:
        need(found.argument);
        at_ += found.argument;
        break;
      case array:
        need(found.argument);  // an item takes a byte at least
        push(found.argument);
        break;
      case map:
        need(found.argument);
        need(2 * found.argument);
        push(2 * found.argument);
        break;
      case simple:
        if (found.info < 20 || found.info == 23 || found.info == 24)
          fail("expected true, false, null or a number, found another simple value");
        break;
      default:
        break;
    }
    keep(begin);
  }

  void need(std::uint64_t bytes) const {
    if (bytes > left())
      fail("expected at least " + std::to_string(bytes) + " bytes, found " +
           std::to_string(left()));
  }

  void refer(std::span<const std::uint8_t> blob) {
    const auto number = static_cast<std::uint32_t>(blobs.size());
    blobs.push_back(blob);
    lean.push_back(byte_string << 5 | 4);
    for (int shift = 0; shift < 32; shift += 8)
      lean.push_back(static_cast<std::uint8_t>(number >> shift));
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::array<std::uint64_t, most_nesting> open_{};  // items still to come, per level
  std::size_t depth_ = 0;
};

}  // namespace

std::span<const std::uint8_t> CborDocument::blob(const nlohmann::json& binary) const {
  std::uint32_t number = 0;
  const auto& bytes = binary.get_binary();
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | bytes[i];
  return blobs[number];
}

CborDocument read_cbor(std::span<const std::uint8_t> bytes) {
  Outline outline(bytes);
  outline.walk();
  try {
    return {nlohmann::json::from_cbor(outline.lean), std::move(outline.blobs)};
  } catch (const nlohmann::json::exception& error) {
    throw Error(std::string("expected a CBOR document: ") + error.what());
  }
}

}  // namespace gait
