#include "play_options.h"

#include "gait/model/model_words.h"
#include "number_range.h"

namespace gait::tool {

namespace {

std::vector<std::string> decoder_names() {
  std::vector<std::string> names;
  for (const auto& [kind, word] : decoder_kind_words) names.emplace_back(word);
  return names;
}

}  // namespace

std::string decoder_name(DecoderKind kind) {
  for (const auto& [known, word] : decoder_kind_words)
    if (known == kind) return std::string(word);
  return "";
}

void add_decoder(CLI::App& command, std::optional<DecoderKind>& decoder, const std::string& help) {
  command
      .add_option_function<std::string>(
          "--decoder",
          [&decoder](const std::string& name) {
            for (const auto& [kind, word] : decoder_kind_words)
              if (word == name) decoder = kind;
          },
          help)
      ->check(CLI::IsMember(decoder_names()).description(""))
      ->type_name("viterbi|forward|lag");
}

void add_play_options(CLI::App& command, PlayerSettings& settings) {
  add_decoder(command, settings.decoder, "How steps are decoded (the model's own)");
  command
      .add_option("--lag", settings.lag,
                  "Seconds by which --decoder lag decides late (the model's own)")
      ->check(within(0.0, 5.0))
      ->type_name("S");
  command
      .add_option("--temper", settings.temper,
                  "Exponent on the evidence of --decoder forward (the model's own)")
      ->check(within(1e-4, 10.0))
      ->type_name("X");
  command
      .add_option("--strength", settings.strength,
                  "0: the average walk, 1: this walk, above: a caricature (the model's own)")
      ->check(within(0.0, 10.0))
      ->type_name("S");
  command.add_option("--past", settings.past, "Frames of the past that smooth (the model's own)")
      ->check(CLI::Range(0, 600))
      ->type_name("P");
  command.add_option("--current", settings.current, "Frames handed out at a time")
      ->check(CLI::Range(1, 600))
      ->default_str("1")
      ->type_name("C");
  command
      .add_option("--future", settings.future,
                  "Frames of the future that smooth, each a frame of delay (the model's own)")
      ->check(CLI::Range(0, 600))
      ->type_name("F");
}

}  // namespace gait::tool
