// Playing takes no memory after construction and gives none back. Where this program can stand
// between the player and malloc, malloc fails during play; in Debug builds Eigen watches too.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>

#include "gait/play/stream_reconstructor.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::ForbiddenMemory;
using testing::input_poses;
using testing::InputPoses;
using testing::plan_of;

// Eigen's own switch is one for all threads: a worker that makes tables must not run meanwhile.
class ForbiddenToEigen {
 public:
  ForbiddenToEigen() { allow(false); }
  ~ForbiddenToEigen() { allow(true); }

 private:
  static void allow([[maybe_unused]] bool allowed) {
#ifdef EIGEN_RUNTIME_NO_MALLOC
    Eigen::internal::set_is_malloc_allowed(allowed);
#endif
  }
};

const InputPoses& walked() {
  static const InputPoses poses =
      input_poses(make_walk(plan_of("drunk", 9)).clip, *few_walks_model()->body);
  return poses;
}

struct Counted {
  int frames = 0;
  float sum = 0;  // so that nothing is left out because nobody looks
};

void play(StreamReconstructor& reconstructor, double start, int begin, int end, Counted& counted) {
  for (int i = begin; i < end; ++i) {
    reconstructor.push(start + i / 30.0, walked()[i]);
    while (reconstructor.next()) {
      ++counted.frames;
      counted.sum += reconstructor.frame().outputs[0] + reconstructor.frame().hips.z();
    }
  }
}

TEST(NoAllocation, is_noticed_by_this_test) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  void* volatile memory = nullptr;
  bool thrown = false;
  long allocations = 0, releases = 0;
  int* volatile number = new int(1);
  {
    const ForbiddenMemory forbidden;
    memory = std::malloc(10);
    delete number;
    allocations = forbidden.allocations();
    releases = forbidden.releases();
  }
  EXPECT_EQ(memory, nullptr);
  EXPECT_EQ(allocations, 1);
  EXPECT_EQ(releases, 1);
  // Other threads are free to take what they need.
  {
    std::unique_ptr<JoiningThread> other;
    std::vector<int> made;
    other = std::make_unique<JoiningThread>([&] { made.resize(1000); });
    const ForbiddenMemory forbidden;
    other->join();
    EXPECT_EQ(forbidden.allocations(), 0);
  }
  try {
    const ForbiddenMemory forbidden;
    number = new int(2);
  } catch (const std::bad_alloc&) {
    thrown = true;
  }
  EXPECT_TRUE(thrown);
}

TEST(NoAllocation, whole_frames_of_every_decoder_take_no_memory) {
  walked();
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward, DecoderKind::lag})
    for (const int future : {0, 3}) {
      PlaySettings settings;
      settings.decoder = kind;
      settings.future = future;
      settings.current = future > 0 ? 2 : 1;
      StreamReconstructor reconstructor(few_walks_model(), settings);
      Counted counted;
      long allocations = 0, releases = 0;
      {
        const ForbiddenToEigen eigen;
        const ForbiddenMemory forbidden;
        play(reconstructor, 0, 0, 80, counted);
        reconstructor.map().set_strength(1.3f);
        reconstructor.map().set_strength(2, 0.5f);
        play(reconstructor, 0, 80, 100, counted);
        while (reconstructor.flush()) ++counted.frames;
        reconstructor.reset({1, 0, 2});
        play(reconstructor, 0, 0, 40, counted);
        // Time jumps: the clock begins anew, poses are rejected.
        play(reconstructor, 1000, 0, 40, counted);
        reconstructor.push(-5, {});
        play(reconstructor, 10, 0, 40, counted);
        while (reconstructor.flush()) ++counted.frames;
        allocations = forbidden.allocations();
        releases = forbidden.releases();
      }
      EXPECT_EQ(allocations, 0);
      EXPECT_EQ(releases, 0);
      EXPECT_GE(counted.frames, 200);
      EXPECT_TRUE(std::isfinite(counted.sum));
    }
}

TEST(NoAllocation, joints_that_go_missing_and_come_back_take_no_memory_of_the_player) {
  if (!ForbiddenMemory::works())
    GTEST_SKIP() << "a sanitizer has malloc, and the worker may use Eigen's";
  walked();
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward, DecoderKind::lag}) {
    PlaySettings settings;
    settings.decoder = kind;
    StreamReconstructor reconstructor(few_walks_model(), settings);
    Counted counted;
    long allocations = 0, releases = 0;
    {
      const ForbiddenMemory forbidden;
      for (int i = 0; i < 100; ++i) {
        if (i % 20 == 5) reconstructor.set_missing(i % 3, true);
        if (i % 20 == 12) reconstructor.set_missing((i - 7) % 3, false);
        play(reconstructor, 0, i, i + 1, counted);
        // New tables must be taken, and the old ones go, within this test.
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
      allocations = forbidden.allocations();
      releases = forbidden.releases();
    }
    EXPECT_EQ(allocations, 0);
    EXPECT_EQ(releases, 0);
    EXPECT_GE(counted.frames, 90);
  }
}

}  // namespace
}  // namespace gait
