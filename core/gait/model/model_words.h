// The words by which a model file calls kinds of streams and of decoders.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "gait/model/model.h"

namespace gait {

inline constexpr std::string_view model_file_format = "gait";

inline constexpr std::array stream_kind_words{
    std::pair{StreamKind::rotation, std::string_view("rotation")},
    std::pair{StreamKind::plain, std::string_view("plain")}};

inline constexpr std::array decoder_kind_words{
    std::pair{DecoderKind::viterbi, std::string_view("viterbi")},
    std::pair{DecoderKind::forward, std::string_view("forward")},
    std::pair{DecoderKind::lag, std::string_view("lag")}};

// The word of a kind; empty for a kind that has none.
template <typename Words, typename Kind>
constexpr std::string_view word_of(const Words& words, Kind kind) {
  for (const auto& [known, word] : words)
    if (known == kind) return word;
  return {};
}

}  // namespace gait
