// A CBOR document (RFC 8949) as a tree, and its byte strings left where they are.
//
// The structure is walked before the tree is built, without recursion: nesting, counts and lengths
// that lie are found before anything is allocated for them. Byte strings, nearly all of a model
// file, are not copied: the parser would take them byte by byte, which alone took 50 ms.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

namespace gait {

// The tag of a byte string that is an array of float64, little endian (RFC 8746).
inline constexpr std::uint8_t cbor_float64_tag = 86;

struct CborDocument {
  nlohmann::json
      tree;  // in place of each byte string, a binary of four bytes: its number in `blobs`
  std::vector<std::span<const std::uint8_t>> blobs;  // views of the bytes that were read

  // The bytes that a binary value of the tree stands for.
  std::span<const std::uint8_t> blob(const nlohmann::json& binary) const;
};

// Reads definite lengths only, no tags but the one above. Throws Error with the offset in bytes.
CborDocument read_cbor(std::span<const std::uint8_t> bytes);

}  // namespace gait
