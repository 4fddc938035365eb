#include "gait/corpus/demo_motion.h"

#include "gait/corpus/corpus.h"
#include "gait/corpus/demo_model.h"
#include "gait/error.h"
#include "gait/numbers.h"
#include "gait/platform/path_text.h"

namespace gait {

namespace {

constexpr int cycles = 8;
constexpr std::uint64_t another_walker = 2;  // the demonstration model learnt from the first
constexpr double frame_rate = 30;

int take_in(std::string_view text, std::string_view name) {
  const auto take = whole_number_in<int>(text);
  if (!take || *take < 1 || *take > 999)
    throw Error("expected gait-demo:STYLE:TAKE with a take from 1 to 999, found '" +
                std::string(name) + "'");
  return *take;
}

// Whole cycles, the last contact left out: it is the first of the next time round.
CorpusWalk whole_cycles(CorpusWalk walk) {
  const int begin = walk.contacts.front().frame, end = walk.contacts.back().frame;
  const auto joints = static_cast<std::ptrdiff_t>(walk.clip.skeleton.size());
  const auto cut = [&](auto& values) {
    values.erase(values.begin() + end * joints, values.end());
    values.erase(values.begin(), values.begin() + begin * joints);
  };
  cut(walk.clip.rotations);
  cut(walk.clip.translations);
  for (Contact& contact : walk.contacts) contact.frame -= begin;
  return walk;
}

}  // namespace

bool names_demo_motion(std::string_view name) {
  return name == demo_model_name || name.starts_with(std::string(demo_model_name) + ":");
}

BodyMotion demo_motion(std::string_view name, const Model& model) {
  WalkPlan plan;
  plan.cycles = cycles;
  plan.seed = another_walker;
  plan.style = corpus_styles().front();
  if (const std::size_t colon = name.find(':'); colon != std::string_view::npos) {
    std::string_view style = name.substr(colon + 1);
    if (const std::size_t second = style.find(':'); second != std::string_view::npos) {
      plan.take = take_in(style.substr(second + 1), name);
      style = style.substr(0, second);
    }
    plan.style = corpus_style(style);
  }
  const CorpusWalk walk = whole_cycles(make_walk(plan, frame_rate));
  return motion_on_body(walk.clip, model, labels_from_contacts(walk.contacts, frame_rate));
}

BodyMotion motion_named(const std::string& name_or_path, const Model& model) {
  return names_demo_motion(name_or_path) ? demo_motion(name_or_path, model)
                                         : read_motion(path_from_utf8(name_or_path), model);
}

}  // namespace gait
