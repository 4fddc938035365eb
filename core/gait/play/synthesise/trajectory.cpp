#include "gait/play/synthesise/trajectory.h"

#include <algorithm>
#include <utility>

namespace gait {

namespace {

// Frames of the whole past that stay at hand, for a queue of another length.
constexpr int kept_past = 6;

}  // namespace

Trajectory::Trajectory(int values, int past, int current, int future)
    : values_(values),
      past_(std::max(whole_past, past)),
      current_(std::max(1, current)),
      future_(std::max(0, future)),
      length_((carried() ? kept_past : past_) + current_ + future_),
      ends_((values + lanes - 1) / lanes),
      path_(Eigen::MatrixXf::Zero(lanes * blocks(), delay() + 1)) {
  Frame empty;
  for (int part = 0; part < 3; ++part) empty.weight[part].setOnes(), empty.target[part].setZero();
  frames_.assign(ends_.size() * static_cast<std::size_t>(length_), empty);
  eliminated_.assign(frames_.size(), {FloatBlock::Zero(), FloatBlock::Zero(), FloatBlock::Zero()});
  reset();
}

void Trajectory::reset() noexcept {
  filled_ = fresh_ = 0;
  for (Ends& ends : ends_) forget(ends);
}

// As if two frames had come that no other depends on.
void Trajectory::forget(Ends& ends) const noexcept {
  ends = {Block::Ones(), Block::Zero(), Block::Ones(), Block::Zero(), Block::Zero()};
}

void Trajectory::push(const OutputGaussian& gaussian) noexcept {
  newest_ = newest_ + 1 < length_ ? newest_ + 1 : 0;
  filled_ = std::min(filled_ + 1, length_);
  fresh_ = std::min(fresh_ + 1, current_);
  for (int block = 0; block < blocks(); ++block) {
    Frame& frame = frames_[block * length_ + newest_];
    const int first = block * lanes, count = std::min(lanes, values_ - first);
    for (int part = 0; part < 3; ++part) {
      const float* const variance = gaussian.variance.data() + part * values_ + first;
      const float* const mean = gaussian.mean.data() + part * values_ + first;
      if (count == lanes) {
        frame.weight[part] = Eigen::Map<const FloatBlock>(variance).inverse();
        frame.target[part] = Eigen::Map<const FloatBlock>(mean);
      } else {
        for (int i = 0; i < count; ++i) {
          frame.weight[part][i] = 1 / variance[i];
          frame.target[part][i] = mean[i];
        }
      }
    }
    if (carried()) factor(block, filled_ - 1);
  }
}

// Adds the queue's frame `i` to the system, and the window of frame i - 1, which is whole now. The
// frame before that no later frame changes any more: it is eliminated.
//
// The window at a frame has the coefficients w on the frames around it: it adds w w^T / variance.
void Trajectory::factor(int block, int i) noexcept {
  const Frame& frame = frames_[place(block, i)];
  const Block weight = frame.weight[0].cast<double>();
  Block last = weight, right_last = weight * frame.target[0].cast<double>();
  Ends& ends = ends_[block];
  if (i < 2) {
    ends = {ends.last, Block::Zero(), last, ends.right_last, right_last};
    return;
  }
  const Frame& middle = frames_[place(block, i - 1)];
  const Block first = 0.5 * middle.weight[1].cast<double>();
  const Block second = middle.weight[2].cast<double>();
  const Block sloped = first * middle.target[1].cast<double>();
  const Block curved = second * middle.target[2].cast<double>();
  const Block outer = 0.5 * first + second;
  last += outer;
  right_last += curved + sloped;
  const Block oldest = ends.before + outer, to_middle = ends.between - 2.0 * second;
  const Block to_last = second - 0.5 * first;
  const Block inverse = oldest.inverse();
  const Block start = (ends.right_before + curved - sloped) * inverse;
  const Block to_next = to_middle * inverse, to_second = to_last * inverse;
  eliminated_[place(block, i - 2)] = {start.cast<float>(), to_next.cast<float>(),
                                      to_second.cast<float>()};
  ends = {ends.last + 4.0 * second - to_middle * to_next, -2.0 * second - to_middle * to_second,
          last - to_last * to_second, ends.right_last - 2.0 * curved - to_middle * start,
          right_last - to_last * start};
}

// The path's `count` frames that end `later` frames before the newest, into the first columns.
void Trajectory::solve(int later, int count) noexcept {
  const int first = filled_ - later - count;
  for (int block = 0; block < blocks(); ++block) {
    if (!carried()) {
      forget(ends_[block]);
      for (int i = 0; i < filled_; ++i) factor(block, i);
    }
    const Ends& ends = ends_[block];
    const auto put = [&](int i, const Block& value) {
      if (i >= first && i < first + count)
        path_.block<lanes, 1>(block * lanes, i - first) = value.cast<float>();
    };
    const Block inverse = ends.before.inverse(), between = ends.between * inverse;
    Block later_value =
        (ends.right_last - between * ends.right_before) / (ends.last - between * ends.between);
    put(filled_ - 1, later_value);
    Block value = ends.right_before * inverse - between * later_value;
    put(filled_ - 2, value);
    for (int i = filled_ - 3; i >= first; --i) {
      const Eliminated& eliminated = eliminated_[place(block, i)];
      const Block earlier = eliminated.start.cast<double>() -
                            eliminated.next.cast<double>() * value -
                            eliminated.second.cast<double>() * later_value;
      later_value = value, value = earlier;
      put(i, value);
    }
  }
}

void Trajectory::resize(int past, int future) {
  Trajectory other(values_, past, current_, future);
  const int kept = std::min(filled_, other.length_);
  other.fresh_ = fresh_;
  for (int i = 0; i < kept; ++i) {
    other.newest_ = i, other.filled_ = i + 1;
    for (int block = 0; block < blocks(); ++block) {
      const int from = place(block, filled_ - kept + i), to = other.place(block, i);
      other.frames_[to] = frames_[from];
      other.eliminated_[to] = eliminated_[from];
      if (other.carried() && !carried()) other.factor(block, i);
    }
  }
  if (other.carried() && carried()) other.ends_ = ends_;
  *this = std::move(other);
}

bool Trajectory::ready() const noexcept {
  return fresh_ >= current_ && filled_ >= current_ + future_;
}

Eigen::Ref<const Eigen::MatrixXf> Trajectory::generate() noexcept {
  fresh_ = 0;
  const int count = std::min(current_, filled_);
  solve(std::min(future_, filled_ - count), count);
  return path_.topLeftCorner(values_, count);
}

Eigen::Ref<const Eigen::MatrixXf> Trajectory::flush(int count) noexcept {
  count = std::min({count, filled_, delay() + 1});
  solve(0, count);
  return path_.topLeftCorner(values_, count);
}

}  // namespace gait
