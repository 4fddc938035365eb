// What a walker takes beyond the tables that all walkers of a model share.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "gait/play/cycles/cycle_projector.h"
#include "gait/play/cycles/speed_walker.h"
#include "gait/play/cycles/style_walker.h"
#include "gait/play/synthesise/step_walker.h"
#include "gait/play/synthesise/synthesiser.h"
#include "play/cycles/styled_walks.h"
#include "play/cycles/walks_over_speed.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

constexpr long most_bytes = 50'000;

// The first may make the tables.
template <class Make>
void expect_small(const char* what, Make make) {
  if (!testing::ForbiddenMemory::works()) GTEST_SKIP() << "memory is not counted here";
  const auto first = make();
  const testing::TakenMemory taken;
  const auto second = make();
  std::printf("%s: %ld bytes\n", what, taken.bytes());
  EXPECT_LE(taken.bytes(), most_bytes) << what;
  EXPECT_GT(taken.bytes(), 100) << what;
}

TEST(WalkerMemory, walkers_of_one_model_share_its_tables) {
  const PlayModel styled(testing::corpus_walks().model), sped(testing::speed_model());
  expect_small("style walker", [&] { return std::make_unique<StyleWalker>(styled, 1); });
  expect_small("speed walker", [&] { return std::make_unique<SpeedWalker>(sped.speeds()); });
  expect_small("projector", [&] {
    return std::make_unique<CycleProjector>(styled.model, styled.model->style_space->space);
  });
}

TEST(WalkerMemory, walkers_by_steps_share_all_but_their_queues) {
  const PlayModel styled(testing::corpus_walks().model);
  expect_small("step walker", [&] { return std::make_unique<StepWalker>(styled); });
  expect_small("synthesiser", [&] { return std::make_unique<Synthesiser>(styled); });
}

}  // namespace
}  // namespace gait
