#include "gait/play/cycles/speed_tables.h"

#include <algorithm>
#include <cmath>

#include "gait/error.h"
#include "gait/model/body_pose.h"
#include "gait/play/body/root_motion.h"
#include "gait/play/cycles/cycle_reader.h"
#include "gait/play/cycles/grounded_cycle.h"

namespace gait {

namespace {

constexpr int slow_steps = 5;  // from standing to the slowest captured speed
constexpr int fast_steps = 8;  // from there to the highest

constexpr float slowest_measured = 0.2f;  // V; slower feet hardly tell where they go
constexpr float seconds_to_settle = 0.6f;
constexpr int cycles_measured = 4;  // each sampled elsewhere

// The cycle in a space that has these scores, one column per frame.
Eigen::MatrixXd cycle_of(const CycleSpace& space, const Eigen::VectorXd& scores, bool with_mean) {
  Eigen::VectorXd values = space.components * scores;
  if (with_mean) values += space.mean;
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), space.values() / space.frames,
                                           space.frames);
}

SubjectCyclesOverSpeed cycles_over_speed(const SpeedSpace& subject, const CycleSpace& space,
                                         const SharedLines& lines, const GroundedCycle& grounded) {
  SubjectCyclesOverSpeed result;
  result.subject = subject.subject;
  result.leg_length = static_cast<float>(subject.leg_length);
  result.slowest =
      static_cast<float>(std::clamp(subject.slowest, 0.1, double{highest_speed_per_leg} - 0.1));
  result.fastest = static_cast<float>(subject.fastest);
  result.frequency_scale = static_cast<float>(subject.frequency_scale);
  result.frequency_power = static_cast<float>(subject.frequency_power);
  const Eigen::MatrixXd intercept = cycle_of(space, lines.intercept, true);
  const Eigen::MatrixXd slope = cycle_of(space, lines.slope, false);
  const Eigen::VectorXd standing = cycle_of(space, lines.standing, true).rowwise().mean();
  const auto add = [&](double speed_per_leg, double share) {
    const Eigen::MatrixXd walking = intercept + speed_per_leg * slope;
    result.cycles.push_back(grounded.with_stride(walking, standing, share).cast<float>());
  };
  result.slow_steps = slow_steps;
  for (int step = 0; step < slow_steps; ++step)
    add(result.slowest, static_cast<double>(step) / slow_steps);
  for (int step = 0; step <= fast_steps; ++step)
    add(result.slowest +
            (highest_speed_per_leg - result.slowest) * static_cast<float>(step) / fast_steps,
        1);
  return result;
}

// Measures how far the feet take a walker per cycle: plays its cycles and reads the root that
// the feet in stance move.
class StrideMeasurement {
 public:
  StrideMeasurement(const Model& model, const SpeedTables& tables, double frame_rate)
      : frames_per_second_(static_cast<float>(frame_rate)),
        tables_(tables),
        reader_(tables),
        root_(model.body->skeleton, body_roles(*model.body), frame_rate),
        pose_(model.body->skeleton.joints.size()) {}

  void measure(SubjectCyclesOverSpeed& subject) {
    const int first = static_cast<int>(std::lround(slowest_measured / stride_grid));
    const int count = static_cast<int>(std::ceil(highest_speed_per_leg / stride_grid)) + 1;
    subject.strides.assign(static_cast<std::size_t>(count), 0.f);
    // From fast to slow: there the way is clear from the first frame.
    float by_power = 1;
    for (int i = count - 1; i >= first; --i) {
      const float speed = static_cast<float>(i) * stride_grid;
      // The feet travel V each second when frequency is V over stride; it changes the stride's
      // reading by so little that the neighbour's will do.
      const float power = std::pow(speed, stride_power);
      by_power = travelled(subject, speed, speed / (by_power * power)) / power;
      subject.strides[static_cast<std::size_t>(i)] = by_power;
    }
    std::fill_n(subject.strides.begin(), first, subject.strides[static_cast<std::size_t>(first)]);
  }

 private:
  void walk(const SubjectCyclesOverSpeed& subject, float speed, float frames, float per_frame) {
    const CyclesAround around = cycles_around(subject, speed);
    for (; frames > 0.5f; frames -= 1) {
      phase_ += per_frame;
      reader_.clear();
      reader_.set_phase(phase_);
      reader_.add(around, 1);
      reader_.read(pose_);
      root_.advance(pose_);
    }
  }

  // In leg lengths per cycle.
  float travelled(const SubjectCyclesOverSpeed& subject, float speed, float frequency) {
    frequency = std::clamp(frequency, 0.2f, 4.f);
    // As many frames as fill whole cycles.
    const float frames = std::round(cycles_measured * frames_per_second_ / frequency);
    const float per_frame = cycles_measured / frames;
    walk(subject, speed, frames_per_second_ * seconds_to_settle, per_frame);
    const Eigen::Vector3f from = root_.position();
    walk(subject, speed, frames, per_frame);
    const Eigen::Vector3f way = root_.position() - from;
    return std::max(0.02f, std::hypot(way.x(), way.z()) / cycles_measured / tables_.leg_length);
  }

  float frames_per_second_;
  const SpeedTables& tables_;
  CycleReader reader_;
  RootMotion root_;
  std::vector<Eigen::Quaternionf> pose_;
  double phase_ = 0;
};

}  // namespace

float share_of_stride(float speed_per_leg, float slowest) noexcept {
  return std::pow(speed_per_leg / slowest, stride_power);
}

float speed_of_share(float share, float slowest) noexcept {
  return slowest * std::pow(share, 1 / stride_power);
}

CyclesAround cycles_around(const SubjectCyclesOverSpeed& subject, float speed_per_leg) noexcept {
  const int last = static_cast<int>(subject.cycles.size()) - 1, slow = subject.slow_steps;
  const float at = speed_per_leg < subject.slowest
                       ? share_of_stride(std::max(0.f, speed_per_leg), subject.slowest) *
                             static_cast<float>(slow)
                       : static_cast<float>(slow) + (speed_per_leg - subject.slowest) /
                                                        (highest_speed_per_leg - subject.slowest) *
                                                        static_cast<float>(last - slow);
  const int below = std::min(static_cast<int>(at), last - 1);
  const float share = std::min(1.f, at - static_cast<float>(below));
  return {&subject.cycles[static_cast<std::size_t>(below)],
          &subject.cycles[static_cast<std::size_t>(below) + 1], 1 - share, share};
}

float stride_at(const SubjectCyclesOverSpeed& subject, float speed_per_leg) noexcept {
  const float at =
      std::clamp(speed_per_leg / stride_grid, 0.f, static_cast<float>(subject.strides.size() - 1));
  const auto below = std::min(static_cast<std::size_t>(at), subject.strides.size() - 2);
  const float share = at - static_cast<float>(below);
  return std::pow(speed_per_leg, stride_power) *
         ((1 - share) * subject.strides[below] + share * subject.strides[below + 1]);
}

std::shared_ptr<const SpeedTables> make_speed_tables(const Model& model, double frame_rate) {
  if (!model.body || model.speed_spaces.empty())
    throw Error("model " + model.name +
                ": expected walks over speed, which the speed walker needs; it has none (train "
                "with clips of several speeds)");
  const Body& body = *model.body;
  const JointRoles roles = body_roles(body);
  if (!roles.has_legs())
    throw Error("model " + model.name + ": expected a body with two legs for the speed walker");
  auto tables = std::make_shared<SpeedTables>();
  tables->leg_length = static_cast<float>(leg_length(body.skeleton, roles));
  tables->references = float_references(body);
  const CycleSpace& first =
      model.shared_speed_space ? *model.shared_speed_space : model.speed_spaces.front().space;
  tables->frames = first.frames;
  tables->joints = first.joints;
  const GroundedCycle grounded(body, first.joints);
  for (const SpeedSpace& subject : model.speed_spaces) {
    const bool shared = model.shared_speed_space && subject.shared.intercept.size() > 0;
    const CycleSpace& space = shared ? first : subject.space;
    if (space.frames != first.frames || space.joints != first.joints)
      throw Error("model " + model.name + ": expected all subjects' cycles alike; those of " +
                  subject.subject + " have other frames or joints");
    const SharedLines own{subject.intercept, subject.slope, subject.standing, subject.projected};
    tables->subjects.push_back(
        cycles_over_speed(subject, space, shared ? subject.shared : own, grounded));
  }
  StrideMeasurement strides(model, *tables, frame_rate);
  for (SubjectCyclesOverSpeed& subject : tables->subjects) strides.measure(subject);
  return tables;
}

}  // namespace gait
