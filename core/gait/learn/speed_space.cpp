#include "gait/learn/speed_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gait/error.h"
#include "gait/learn/standing_pose.h"

namespace gait {

namespace {

using Rows = Eigen::MatrixXd;  // one cycle a row

double speed_per_leg(const CapturedCycle& cycle, const SubjectCycles& subject) {
  return cycle.speed / subject.leg_length;
}

// One subject's data for the regression.
struct Subject {
  const SubjectCycles& captured;
  Rows cycles;
  Eigen::VectorXd speeds;    // V, one per cycle
  Eigen::VectorXd standing;  // a whole cycle of it
};

Subject seen(const SubjectCycles& captured, const Body& body, const std::vector<int>& joints,
             int frames) {
  const auto count = static_cast<Eigen::Index>(captured.cycles.size());
  Subject subject{
      captured, Rows(count, captured.cycles.front().values.size()), Eigen::VectorXd(count), {}};
  for (Eigen::Index i = 0; i < count; ++i) {
    subject.cycles.row(i) = captured.cycles[i].values.transpose();
    subject.speeds[i] = speed_per_leg(captured.cycles[i], captured);
  }
  const Eigen::VectorXd pose =
      captured.standing.size() > 0
          ? captured.standing
          : standing_pose(body, joints, subject.cycles.colwise().mean().transpose());
  subject.standing = pose.replicate(frames, 1);
  return subject;
}

// Pooled slope of cycles over V within subjects. When no subject walked at two speeds: the slope
// from standing to walking, with weight 0.
struct SharedSlope {
  Eigen::VectorXd slope;
  double weight = 0;
};

SharedSlope shared_slope(const std::vector<Subject>& subjects) {
  SharedSlope shared{Eigen::VectorXd::Zero(subjects.front().cycles.cols()), 0};
  for (const Subject& subject : subjects) {
    const Eigen::VectorXd off = subject.speeds.array() - subject.speeds.mean();
    shared.slope.noalias() += subject.cycles.transpose() * off;
    shared.weight += off.squaredNorm();
  }
  if (shared.weight > 1e-6) {
    shared.slope /= shared.weight;
    return shared;
  }
  // All cycles have one speed: the only known slope is the one from standing to walking.
  shared.weight = 0;
  for (const Subject& subject : subjects)
    shared.slope += (subject.cycles.colwise().mean().transpose() - subject.standing) /
                    (subject.speeds.mean() * static_cast<double>(subjects.size()));
  return shared;
}

CycleSpace space_of(Rows rows, const std::vector<int>& joints, int frames,
                    const ComponentChoice& choice) {
  const PrincipalComponents found = principal_components(rows, choice);
  return {frames, joints, found.mean, found.components, found.variances};
}

// Adds a direction that the components leave out, so that `way` lies in the space.
void span_also(CycleSpace& space, const Eigen::VectorXd& way) {
  Eigen::VectorXd rest = way;
  for (int pass = 0; pass < 2; ++pass)  // twice: what rounding left of the first
    rest -= space.components * (space.components.transpose() * rest);
  if (rest.norm() < 1e-6 * way.norm()) return;
  const Eigen::Index kept = space.components.cols();
  space.components.conservativeResize(Eigen::NoChange, kept + 1);
  space.components.col(kept) = rest.normalized();
  const Eigen::Index known = space.variances.size();
  if (known > kept) return;
  space.variances.conservativeResize(kept + 1);
  space.variances.tail(kept + 1 - known).setZero();
}

Eigen::VectorXd scores_of(const CycleSpace& space, const Eigen::VectorXd& cycle) {
  return space.components.transpose() * (cycle - space.mean);
}

// Eq. 2 of G04 for all components at once, the slope held to the shared one: standing is left out.
SharedLines fit_lines(const CycleSpace& space, const Subject& subject, const SharedSlope& shared,
                      double held) {
  const double mean_speed = subject.speeds.mean();
  const Eigen::VectorXd off = subject.speeds.array() - mean_speed;
  // Without a shared slope the subject's own decides, if it has one.
  const double weight = shared.weight > 0 ? held : 1e-9;
  const Eigen::VectorXd slope =
      (subject.cycles.transpose() * off + weight * shared.slope) / (off.squaredNorm() + weight);
  const Eigen::VectorXd mean = subject.cycles.colwise().mean().transpose();
  SharedLines lines;
  lines.slope = space.components.transpose() * slope;
  lines.intercept = scores_of(space, mean) - mean_speed * lines.slope;
  lines.standing = scores_of(space, subject.standing);
  lines.projected =
      space.components.transpose() * (subject.cycles.transpose().colwise() - space.mean);
  return lines;
}

SpeedSpace own_space(const Subject& subject, const SharedSlope& shared,
                     const std::vector<int>& joints, const SpeedOptions& options) {
  SpeedSpace result;
  result.subject = subject.captured.subject;
  result.leg_length = subject.captured.leg_length;
  result.cycles = static_cast<int>(subject.cycles.rows());
  result.slowest = subject.speeds.minCoeff();
  result.fastest = subject.speeds.maxCoeff();
  Rows rows(subject.cycles.rows() + 1, subject.cycles.cols());
  rows << subject.cycles, subject.standing.transpose();
  result.space = space_of(std::move(rows), joints, options.frames, options.components);
  span_also(result.space, subject.standing - result.space.mean);
  span_also(result.space, shared.slope);
  const SharedLines lines = fit_lines(result.space, subject, shared, options.held_to_shared_slope);
  result.intercept = lines.intercept;
  result.slope = lines.slope;
  result.standing = lines.standing;
  result.projected = lines.projected;
  result.speeds = subject.speeds;
  return result;
}

CycleSpace shared_space(const std::vector<Subject>& subjects, const std::vector<int>& joints,
                        const SpeedOptions& options) {
  Eigen::Index count = 0;
  for (const Subject& subject : subjects) count += subject.cycles.rows() + 1;
  Rows rows(count, subjects.front().cycles.cols());
  Eigen::Index at = 0;
  for (const Subject& subject : subjects) {
    rows.middleRows(at, subject.cycles.rows()) = subject.cycles;
    at += subject.cycles.rows();
    rows.row(at++) = subject.standing.transpose();
  }
  return space_of(std::move(rows), joints, options.frames, options.shared_components);
}

std::vector<CadencePoint> cadence_points(const SubjectCycles& subject) {
  std::vector<CadencePoint> points;
  for (const CapturedCycle& cycle : subject.cycles)
    points.push_back({speed_per_leg(cycle, subject), 1 / cycle.duration});
  return points;
}

// Frequency law of all cycles; when all have one speed, with the power of Inman's law.
FrequencyLaw law_of_all(const std::vector<CadencePoint>& points) {
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(),
      [](const auto& a, const auto& b) { return a.speed_per_leg < b.speed_per_leg; });
  if (high->speed_per_leg > 1.02 * low->speed_per_leg) return fit_frequency_law(points);
  return fit_frequency_law(points, LawBefore{});
}

}  // namespace

SpeedSpaces learn_speed_spaces(const std::vector<SubjectCycles>& captured, const Body& body,
                               const SpeedOptions& options) {
  const std::vector<int> joints = joints_below_hips(body);
  std::vector<Subject> subjects;
  SpeedSpaces result;
  for (const SubjectCycles& one : captured) {
    if (one.cycles.empty()) continue;
    for (const CapturedCycle& cycle : one.cycles)
      if (!(cycle.speed > 0) || !(cycle.duration > 0))
        throw Error("speed spaces: expected cycles of " + one.subject +
                    " with a speed and a duration; found " + std::to_string(cycle.speed) +
                    " m/s in " + std::to_string(cycle.duration) + " s");
    subjects.push_back(seen(one, body, joints, options.frames));
    const auto points = cadence_points(one);
    result.law_points.insert(result.law_points.end(), points.begin(), points.end());
  }
  if (subjects.empty()) throw Error("speed spaces: expected at least one cycle; found none");

  const SharedSlope slope = shared_slope(subjects);
  result.law = law_of_all(result.law_points);
  if (subjects.size() > 1) result.shared = shared_space(subjects, joints, options);
  for (const Subject& subject : subjects) {
    SpeedSpace space = own_space(subject, slope, joints, options);
    const FrequencyLaw law = fit_frequency_law(cadence_points(subject.captured),
                                               LawBefore{result.law, options.held_to_shared_law});
    space.frequencies.resize(space.cycles);
    for (int i = 0; i < space.cycles; ++i)
      space.frequencies[i] = 1 / subject.captured.cycles[i].duration;
    space.frequency_scale = law.scale;
    space.frequency_power = law.power;
    if (result.shared)
      space.shared = fit_lines(*result.shared, subject, slope, options.held_to_shared_slope);
    result.subjects.push_back(std::move(space));
  }
  return result;
}

}  // namespace gait
