// Models with fields that were bent: whatever is read can be played, by everything that plays.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "fuzz/damage.h"
#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/learn/trainer.h"
#include "gait/model/model_file.h"
#include "gait/play/cycles/speed_walker.h"
#include "gait/play/cycles/style_walker.h"
#include "gait/play/stream_reconstructor.h"
#include "gait/play/synthesise/step_walker.h"
#include "gait/teach/walk_model.h"
#include "gait/teach/walks_over_speed.h"

namespace gait {
namespace {

using nlohmann::json;
using testing::Damage;
using testing::fuzz_rounds;

json whole_model() {
  std::vector<Walk> walks;
  const auto add = [&](CorpusWalk walk) {
    walks.push_back({std::move(walk.clip), walk.style, walk.subject, {}, std::move(walk.contacts)});
  };
  for (const char* style : {"proud", "drunk"}) add(make_walk({.style = corpus_style(style)}));
  const WalkSequences sequences = walk_sequences(walks, {});
  LearningOptions options;
  options.states = 2;
  options.history = {1.0 / 30};
  options.hmm.soft_iterations = 1;
  Model model = learn(walking_task(sequences), options).model;
  model.name = "fuzzed";
  model.body = sequences.body;
  add_style_space(model, walks);
  for (CorpusWalk& walk : make_speed_walks())
    if (walk.speed < 1.5) add(std::move(walk));
  add_speed_spaces(model, walks);
  const auto bytes = model_bytes(model);
  return json::from_cbor(bytes, true, true, json::cbor_tag_handler_t::store);
}

// Any field, however deep: not a list's or a blob's every entry alike, but by the way down.
json& any_field(json& file, Damage& damage) {
  json* at = &file;
  while ((at->is_object() || at->is_array()) && !at->empty()) {
    auto next = at->begin();
    std::advance(next, static_cast<std::ptrdiff_t>(damage.below(at->size())));
    at = &*next;
    if (damage.below(40) == 0) break;
  }
  return *at;
}

void bend(json& field, Damage& damage) {
  if (field.is_binary() && damage.below(8) > 0) {
    auto& bytes = field.get_binary();
    if (bytes.empty()) return;
    // A double somewhere in the blob.
    static const double factors[] = {-1, 0, 0.5, 0.9, 1.1, 2, 10};
    static const double odd[] = {0, -1, 1e-300, 1e300, -1e12, 1e6, 100, -0.5, 1e-9};
    if (bytes.size() < sizeof(double)) return;
    std::uint8_t* const place = bytes.data() + 8 * damage.below(bytes.size() / 8);
    double value = 0;
    std::memcpy(&value, place, sizeof value);
    value = damage.below(4) > 0 ? value * factors[damage.below(std::size(factors))]
                                : odd[damage.below(std::size(odd))];
    std::memcpy(place, &value, sizeof value);
    return;
  }
  const json values[] = {0,
                         -1,
                         1,
                         2,
                         39,
                         0.5,
                         1e-12,
                         1e12,
                         -1e300,
                         std::numeric_limits<double>::quiet_NaN(),
                         4294967296,
                         "right",
                         nullptr,
                         json::array(),
                         json::object(),
                         true};
  if (field.is_number() && damage.below(3) > 0) {
    static const double factors[] = {-1, 0.1, 0.9, 1.1, 10, 1000, 1e-6};
    field = field.get<double>() * factors[damage.below(std::size(factors))];
  } else {
    field = values[damage.below(std::size(values))];
  }
}

void expect_finite(std::span<const Eigen::Quaternionf> pose) {
  for (const Eigen::Quaternionf& rotation : pose) ASSERT_TRUE(rotation.coeffs().allFinite());
}

// Everything that a model can do, for a second or so. Objects may refuse the model.
int play(const std::shared_ptr<const Model>& model) {
  int played = 0;
  const auto if_it_can = [&](const auto& action) {
    try {
      action();
      ++played;
    } catch (const Error& error) {
      EXPECT_STRNE(error.what(), "");
    }
  };
  if_it_can([&] {
    StreamReconstructor reconstructor(model);
    std::vector<Eigen::Quaternionf> pose(model->inputs.size(), Eigen::Quaternionf::Identity());
    for (int i = 0; i < 40; ++i) {
      reconstructor.push(i / 30.0, pose);
      while (reconstructor.next()) {
        expect_finite(reconstructor.frame().pose);
        ASSERT_TRUE(reconstructor.frame().hips.allFinite());
      }
    }
  });
  if_it_can([&] {
    StepWalker walker(model);
    for (int i = 0; i < 60; ++i) {
      walker.advance();
      expect_finite(walker.pose());
    }
  });
  if_it_can([&] {
    StyleWalker walker(model, 1);
    for (int i = 0; i < 60; ++i) {
      walker.advance(1.0 / 30);
      expect_finite(walker.pose());
    }
  });
  if_it_can([&] {
    SpeedWalker walker(make_speed_tables(*model));
    walker.set_speed(1.2f);
    for (int i = 0; i < 60; ++i) {
      walker.advance(1.0 / 30);
      expect_finite(walker.pose());
    }
  });
  return played;
}

TEST(ModelFuzz, a_model_that_is_read_can_be_played) {
  const json whole = whole_model();
  Damage damage(3, {""});
  int read = 0, refused = 0, played = 0;
  for (int round = 0; round < fuzz_rounds(300); ++round) {
    json file = whole;
    for (std::size_t left = 1 + damage.below(2); left > 0; --left)
      bend(any_field(file, damage), damage);
    SCOPED_TRACE("round " + std::to_string(round));
    std::shared_ptr<const Model> model;
    try {
      model = std::make_shared<const Model>(parse_model(json::to_cbor(file), "bent.gait"));
      ++read;
    } catch (const Error& error) {
      ASSERT_EQ(std::string(error.what()).find("bent.gait"), 0u) << error.what();
      ++refused;
      continue;
    }
    played += play(model);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(read, 20);
  EXPECT_GT(refused, 20);
  EXPECT_GT(played, 60);
}

}  // namespace
}  // namespace gait
