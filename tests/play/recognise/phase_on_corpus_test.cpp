// The whole chain from clips to the clock on the built-in walks, whose phase is known exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gait/corpus/corpus.h"
#include "gait/learn/trainer.h"
#include "gait/learn/walk_sequences.h"
#include "gait/model/body_pose.h"
#include "gait/play/recognise/decoder.h"
#include "gait/play/recognise/emissions.h"
#include "gait/play/recognise/phase_clock.h"
#include "gait/play/recognise/phase_estimate.h"
#include "play/recognise/phase_stage.h"

namespace gait {
namespace {

Model model_of_odd_takes() {
  std::vector<Walk> walks;
  for (CorpusWalk& walk : make_corpus())
    if (walk.take % 2 == 1)
      walks.push_back({std::move(walk.clip), walk.style, {}, {}, std::move(walk.contacts)});
  const WalkSequences seen = walk_sequences(walks, {});
  Model model = learn({seen.frame_rate,
                       seen.inputs,
                       seen.outputs,
                       {{"right", {1}}, {"left", {0}}},
                       seen.styles,
                       seen.sequences},
                      {})
                    .model;
  model.body = seen.body;
  return model;
}

// What the clock shows of a walk, and when it lets feet touch (seconds).
struct Followed {
  std::vector<double> phase;  // per frame
  std::vector<testing::StageRecord::Contact> contacts;
};

struct Decoding {
  DecoderKind kind;
  int lag;  // frames
};

Followed follow(const Model& model, const CorpusWalk& walk, Decoding decoding) {
  const Body& body = *model.body;
  const auto tables = make_state_tables(model);
  const BodyPoses poses = body_poses(
      walk.clip, body, match_joints(body, walk.clip.skeleton, walk.clip.name), body.heading_window);
  InputObserver<float> observer(model.input, model.input_scaling);
  Emissions emissions(tables, model.input);
  Decoder decoder(tables, decoding.kind, decoding.lag, 0.1f, model.frame_rate);
  const PhaseEstimator estimator(model);
  PhaseClock clock({.cadence = estimator.cycle(0).cadence()});
  std::vector<float> values(model.input.values);
  std::vector<Eigen::Quaternionf> references, pose(body.references.size());
  for (const auto& reference : body.references) references.push_back(reference.cast<float>());
  std::vector<float> block(1600);
  Followed followed;
  for (int frame = 0; frame < poses.frames(); ++frame) {
    for (std::size_t joint = 0; joint < pose.size(); ++joint)
      pose[joint] = poses.pose(frame)[joint].cast<float>();
    pose_vector<float>(pose, references, body.input_joints, values);
    observer.advance(values);
    decoder.advance(emissions.of(observer.scaled(), observer.known()));
    if (decoder.decided()) {
      const PhaseEstimate estimate = estimator.of(decoder.weighted(), decoder.progress());
      clock.observe(estimate.seen, estimate.certainty,
                    estimate.age + decoder.lag() / model.frame_rate);
    }
    followed.phase.push_back(clock.phase());
    clock.process(block, 48000);
    for (const auto& crossing : clock.crossings())
      followed.contacts.push_back(
          {frame / model.frame_rate + crossing.sample / 48000.0, crossing.step});
  }
  return followed;
}

double rms_error(const Followed& followed, const CorpusWalk& walk, int begin, int end) {
  double sum = 0;
  for (int frame = begin; frame < end; ++frame)
    sum += std::pow(testing::wrapped_error(followed.phase[frame], walk.phase[frame]), 2);
  return std::sqrt(sum / (end - begin));
}

// The frame `cycles` cycles after frame `from`.
int frame_after(const CorpusWalk& walk, int from, double cycles) {
  double walked = 0;
  int frame = from;
  while (walked < cycles)
    ++frame, walked += testing::wrapped_error(walk.phase[frame], walk.phase[frame - 1]);
  return frame;
}

constexpr Decoding decodings[] = {
    {DecoderKind::viterbi, 0}, {DecoderKind::forward, 0}, {DecoderKind::lag, 3}};

TEST(PhaseOnCorpus, the_clock_is_where_walks_are_that_it_has_not_seen_and_feet_touch_on_time) {
  const Model model = model_of_odd_takes();
  const auto corpus = make_corpus();
  for (const Decoding& decoding : decodings) {
    std::vector<double> late;  // frames by which contacts come, signed
    int contacts = 0, on_time = 0, walks = 0;
    for (const CorpusWalk& walk : corpus) {
      if (walk.take % 2 == 1) continue;
      const Followed followed = follow(model, walk, decoding);
      const int settled = frame_after(walk, 0, 2);
      EXPECT_LE(rms_error(followed, walk, settled, walk.clip.frames()), 0.03) << walk.clip.name;
      for (const Contact& contact : walk.contacts) {
        if (contact.frame < settled || contact.frame + 3 > walk.clip.frames()) continue;
        double nearest = 1e9;
        for (const auto& heard : followed.contacts) {
          const double off = heard.time * model.frame_rate - contact.frame;
          if (heard.step == (contact.foot == Foot::right ? 0 : 1) &&
              std::abs(off) < std::abs(nearest))
            nearest = off;
        }
        ++contacts;
        on_time += std::abs(nearest) <= 2;
        late.push_back(nearest);
      }
      ++walks;
    }
    EXPECT_GE(walks, 22);
    EXPECT_GE(on_time, 0.95 * contacts) << "of " << contacts;
    std::nth_element(late.begin(), late.begin() + late.size() / 2, late.end());
    EXPECT_LE(std::abs(late[late.size() / 2]), 1);
  }
}

TEST(PhaseOnCorpus, settles_within_two_cycles_after_a_walker_changes_cadence_by_a_fifth) {
  const Model model = model_of_odd_takes();
  constexpr double change_time = 5;
  // From the slowest steps to the quickest.
  for (const char* name : {"tiptoeing", "drunk", "proud", "in-a-hurry"})
    for (const double scale : {0.8, 1.2}) {
      WalkPlan plan;
      plan.style = corpus_style(name);
      plan.cycles = 12;
      plan.take = 99;
      plan.cadence = {{change_time, scale}};
      CorpusWalk walk = make_walk(plan);
      walk.clip.name = std::string(name) + (scale > 1 ? " faster" : " slower");
      // Time counts from the first contact, and the step under way is finished as it began.
      const int change = walk.contacts.front().frame + static_cast<int>(change_time * 30);
      const int settled = frame_after(walk, change, 2);
      for (const Decoding& decoding : decodings) {
        const Followed followed = follow(model, walk, decoding);
        EXPECT_LE(rms_error(followed, walk, frame_after(walk, 0, 2), walk.clip.frames()), 0.035)
            << walk.clip.name;
        EXPECT_LE(rms_error(followed, walk, settled, walk.clip.frames()), 0.03)
            << walk.clip.name << " with decoder " << static_cast<int>(decoding.kind);
      }
    }
}

}  // namespace
}  // namespace gait
