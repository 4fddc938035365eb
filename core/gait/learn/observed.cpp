#include "gait/learn/observed.h"

#include <algorithm>
#include <cmath>

#include "gait/error.h"

namespace gait {

namespace {

struct Moments {
  Eigen::VectorXd mean, deviation;
};

// Over the frames inside segments of all sequences; `of` picks the matrix (rows by frames).
template <typename Of>
Moments moments_of(const std::vector<Sequence>& sequences, Of of) {
  Eigen::VectorXd sum, squares;
  double count = 0;
  for (const Sequence& sequence : sequences) {
    if (sequence.segments.empty()) continue;
    const Eigen::MatrixXd& values = of(sequence);
    const int begin = sequence.segments.front().begin;
    const int length = sequence.segments.back().end - begin;
    if (sum.size() == 0) sum = Eigen::VectorXd::Zero(values.rows());
    sum += values.middleCols(begin, length).rowwise().sum();
    count += length;
  }
  Moments moments;
  if (count == 0) return moments;
  moments.mean = sum / count;
  squares = Eigen::VectorXd::Zero(sum.size());
  for (const Sequence& sequence : sequences) {
    if (sequence.segments.empty()) continue;
    const Eigen::MatrixXd& values = of(sequence);
    const int begin = sequence.segments.front().begin;
    const int length = sequence.segments.back().end - begin;
    squares += (values.middleCols(begin, length).colwise() - moments.mean).rowwise().squaredNorm();
  }
  moments.deviation = (squares / count).cwiseSqrt();
  return moments;
}

std::vector<int> moving(const Eigen::VectorXd& deviation) {
  std::vector<int> indices;
  for (int i = 0; i < deviation.size(); ++i)
    if (deviation[i] >= least_deviation) indices.push_back(i);
  return indices;
}

Eigen::MatrixXd raw_inputs(const Sequence& sequence, const InputLayout& layout) {
  // (Not clipped: it is not scaled yet.)
  Scaling none{Eigen::VectorXd::Zero(layout.size()), Eigen::VectorXd::Ones(layout.size())};
  InputObserver<double> observer(layout, none);
  Eigen::MatrixXd x(layout.size(), sequence.inputs.cols());
  for (int frame = 0; frame < x.cols(); ++frame) {
    observer.advance({sequence.inputs.col(frame).data(), static_cast<std::size_t>(layout.values)});
    x.col(frame) = observer.raw();
  }
  return x;
}

// Differences that hardly vary would be blown up by their own deviation.
// `statics`: how many leading entries are values, repeated as differences behind them. A value that
// differs between clips but rests within each has no differences to scale by: some share of its own
// deviation stands in.
Scaling scaling_of(const std::vector<Sequence>& observed, bool inputs, int statics) {
  const Moments moments = moments_of(observed, [&](const Sequence& s) -> const Eigen::MatrixXd& {
    return inputs ? s.inputs : s.outputs;
  });
  constexpr double least_share = 0.01;
  Eigen::VectorXd deviation = moments.deviation.cwiseMax(1e-6);
  for (Eigen::Index i = statics; i < deviation.size(); ++i)
    deviation[i] = std::max(deviation[i], least_share * deviation[i % statics]);
  return {moments.mean, deviation};
}

// Segments within the frames [first, last), whose observations are complete.
std::vector<Segment> cut(const std::vector<Segment>& segments, int first, int last) {
  std::vector<Segment> kept;
  for (Segment segment : segments) {
    // A segment without its beginning would train its first states on later frames.
    if (segment.begin < first || segment.end > last) continue;
    kept.push_back(segment);
  }
  return kept;
}

}  // namespace

Eigen::MatrixXd with_differences(const Eigen::MatrixXd& values, const std::vector<int>& modelled) {
  const int statics = static_cast<int>(modelled.size()), frames = static_cast<int>(values.cols());
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(3 * statics, frames);
  for (int frame = 0; frame < frames; ++frame)
    for (int i = 0; i < statics; ++i) {
      const auto at = [&](int offset) {
        return values(modelled[i], std::clamp(frame + offset, 0, frames - 1));
      };
      y(i, frame) = at(0);
      for (int offset = -1; offset <= 1; ++offset) {
        y(statics + i, frame) += first_difference[offset + 1] * at(offset);
        y(2 * statics + i, frame) += second_difference[offset + 1] * at(offset);
      }
    }
  return y;
}

Eigen::MatrixXd scaled_by(const Scaling& scaling, const Eigen::MatrixXd& values) {
  return ((values.colwise() - scaling.mean).array().colwise() *
          scaling.deviation.cwiseInverse().array())
      .matrix();
}

ObservationSet observe(const std::vector<Sequence>& sequences, const std::vector<int>& lags,
                       double clip) {
  ObservationSet set;
  const Moments inputs =
      moments_of(sequences, [](const Sequence& s) -> const Eigen::MatrixXd& { return s.inputs; });
  const Moments outputs =
      moments_of(sequences, [](const Sequence& s) -> const Eigen::MatrixXd& { return s.outputs; });
  if (inputs.mean.size() == 0)
    throw Error("expected at least one sequence with labelled frames; found none");
  set.input = {static_cast<int>(inputs.mean.size()), moving(inputs.deviation), lags};
  set.output = {static_cast<int>(outputs.mean.size()), moving(outputs.deviation)};
  set.output_mean = outputs.mean;
  set.input_mean = inputs.mean;
  if (set.input.modelled.empty())
    throw Error("expected input streams that move; none of " + std::to_string(set.input.values) +
                " values deviates by " + std::to_string(least_deviation) + " or more");

  const int history = lags.empty() ? 0 : lags.back();
  std::vector<Sequence> raw;
  std::vector<int> sources;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const Sequence& sequence = sequences[i];
    const int frames = static_cast<int>(sequence.inputs.cols());
    Sequence observed{
        sequence.name, {}, {}, cut(sequence.segments, history, frames - 1), sequence.style};
    if (observed.segments.empty()) continue;
    observed.inputs = raw_inputs(sequence, set.input);
    observed.outputs = with_differences(sequence.outputs, set.output.modelled);
    raw.push_back(std::move(observed));
    sources.push_back(static_cast<int>(i));
  }
  if (raw.empty()) throw Error("expected sequences longer than their history; none is left");
  set.input.clip = clip;
  set.input_scaling = scaling_of(raw, true, set.input.statics());
  set.output_scaling = scaling_of(raw, false, set.output.statics());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const Sequence& sequence = raw[i];
    ObservedSequence observed{sequence.name, {}, {}, sequence.segments, sequence.style, sources[i]};
    observed.x = scaled_by(set.input_scaling, sequence.inputs);
    for (int frame = 0; frame < observed.x.cols(); ++frame)
      clip_observation(set.input, set.input.known(frame), observed.x.col(frame));
    observed.y = scaled_by(set.output_scaling, sequence.outputs);
    set.sequences.push_back(std::move(observed));
  }
  return set;
}

}  // namespace gait
