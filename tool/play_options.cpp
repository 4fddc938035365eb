#include "play_options.h"

#include "gait/model/model_words.h"
#include "option_kinds.h"

namespace gait::tool {

namespace {

std::vector<std::string> decoder_names() {
  std::vector<std::string> names;
  for (const auto& [kind, word] : decoder_kind_words) names.emplace_back(word);
  return names;
}

CLI::Validator past_frames() {
  const auto frames = [](std::string& text) {
    if (text != "all") return CLI::Range(0, 600)(text);
    text = std::to_string(whole_past);
    return std::string();
  };
  return {frames, "", "past"};
}

}  // namespace

void add_decoder(CLI::App& command, std::optional<DecoderKind>& decoder, const std::string& help) {
  command
      .add_option_function<std::string>(
          "--decoder",
          [&decoder](const std::string& name) {
            for (const auto& [kind, word] : decoder_kind_words)
              if (word == name) decoder = kind;
          },
          help)
      ->check(one_of(decoder_names()))
      ->type_name("viterbi|forward|lag");
}

void add_play_options(CLI::App& app, PlaySettings& settings) {
  add_decoder(app, settings.decoder, "How steps are decoded (the model's own)");
  add_value(app, "--lag", "S", settings.lag,
            "Seconds by which --decoder lag decides late (the model's own)")
      ->check(within(0, 5));
  add_value(app, "--temper", "X", settings.temper,
            "Exponent on the evidence of --decoder forward (the model's own)")
      ->check(within(1e-4, 10));
  add_value(app, "--strength", "S", settings.strength,
            "0: the average walk, 1: this walk, above: a caricature (the model's own)")
      ->check(within(0, 10));
  add_value(app, "--past", "P|all", settings.past,
            "Frames of the past that smooth (the model's own)")
      ->transform(past_frames());
  add_value(app, "--current", "C", settings.current, "Frames handed out at a time")
      ->check(CLI::Range(1, 600))
      ->default_str("1");
  add_value(app, "--future", "F", settings.future,
            "Frames of the future that smooth, each a frame of delay (the model's own)")
      ->check(CLI::Range(0, 600));
}

}  // namespace gait::tool
