#include "gait/judge/evaluation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gait/error.h"
#include "gait/judge/calibration.h"
#include "gait/judge/foot_slide.h"
#include "gait/judge/played_sequence.h"
#include "gait/model/body_pose.h"
#include "gait/model/fitted_model.h"
#include "gait/motion/contacts.h"
#include "gait/motion/resample.h"
#include "gait/offline/reconstructed_clip.h"

namespace gait {

namespace {

constexpr int fewest_steps = 2;
constexpr double least_path = 0.5;  // metres; who stays in place has no path to compare

// A last contact that ends with the clip may be rounded beyond it at another rate.
std::vector<Contact> within(const Clip& clip, std::vector<Contact> contacts) {
  for (Contact& contact : contacts) contact.frame = std::min(contact.frame, clip.frames() - 1);
  return contacts;
}

// Mean over the counted streams of the size of the third difference, per second cubed.
double mean_jerk(const Eigen::MatrixXd& outputs, int frame, const std::vector<bool>& counted,
                 double frame_rate) {
  double sum = 0;
  int streams = 0;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    if (!counted[i]) continue;
    const auto at = [&](int back) {
      return outputs.col(frame - back).segment<3>(3 * static_cast<Eigen::Index>(i));
    };
    sum += (at(0) - 3 * at(1) + 3 * at(2) - at(3)).norm();
    ++streams;
  }
  return streams > 0 ? sum / streams * std::pow(frame_rate, 3) : 0;
}

class Evaluator {
 public:
  Evaluator(std::shared_ptr<const Model> model, const PlaySettings& settings,
            const RoleTable& roles)
      : model_(std::move(model)), settings_(settings), role_table_(roles), played_(model_) {
    if (!model_->body)
      throw Error("model " + model_->name + ": expected a model of a body to evaluate on clips");
    const Body& body = *model_->body;
    for (std::size_t i = 0; i < body.output_joints.size(); ++i) {
      const int joint = body.output_joints[i];
      const std::vector<int>& modelled = model_->output.modelled;
      const bool moves = std::any_of(modelled.begin(), modelled.end(),
                                     [&](int value) { return value / 3 == static_cast<int>(i); });
      evaluation_.output_names.push_back(body.skeleton.joints[joint].name);
      evaluation_.counted.push_back(body.roles[joint] != Role::hips && moves);
    }
    const auto styles = static_cast<Eigen::Index>(model_->styles.size());
    evaluation_.styles = model_->styles;
    evaluation_.confusion = Eigen::MatrixXi::Zero(styles, styles);
  }

  void add(const Walk& walk) {
    const Clip clip = resampled(walk.clip, model_->frame_rate);
    const Body& body = *model_->body;
    const auto matched = match_joints(body, clip.skeleton, clip.name);
    const JointRoles clip_roles = find_roles(clip, role_table_);
    WalkTrack track = follow_walk(clip, clip_roles);
    if (!walk.contacts.empty())
      track.contacts =
          within(clip, contacts_at(walk.contacts, model_->frame_rate / walk.clip.frame_rate));
    if (track.contacts.size() <= fewest_steps) {
      evaluation_.skipped.push_back(
          clip.name + ": expected at least " + std::to_string(fewest_steps) + " steps, found " +
          std::to_string(std::max<std::size_t>(1, track.contacts.size()) - 1));
      return;
    }
    const BodyPoses poses = body_poses(clip, body, matched, track.cycle_seconds);
    const Sequence truth = walk_sequence(body, poses, track.contacts, clip.name);
    EvaluatedClip result;
    result.name = clip.name;
    result.style = walk.style;
    compare(truth, result);
    compare_roots(clip, clip_roles, matched, track, poses, result);
    evaluation_.clips.push_back(std::move(result));
  }

  Evaluation finish() {
    std::sort(evaluation_.frame_microseconds.begin(), evaluation_.frame_microseconds.end());
    evaluation_.calibration_error = calibration_.value();
    return std::move(evaluation_);
  }

 private:
  PlayedSequence play(const Sequence& truth, std::optional<double> strength, bool smooth) const {
    PlaySettings settings = settings_;
    if (strength) settings.strength = strength;
    if (!smooth) settings.past = 0, settings.future = 0, settings.current = 1;
    return play_sequence(played_, settings, truth);
  }

  void compare(const Sequence& truth, EvaluatedClip& result) {
    const PlayedSequence state_means = play(truth, 0.0, false);
    const PlayedSequence mapped = play(truth, std::nullopt, false);
    const PlayedSequence synthesised = play(truth, std::nullopt, true);
    const auto streams = static_cast<Eigen::Index>(model_->outputs.size());
    for (auto& sums : result.angle_sums) sums = Eigen::VectorXd::Zero(streams);
    for (int frame = mapped.begin; frame < mapped.end; ++frame) {
      const auto true_outputs = truth.outputs.col(frame);
      const Eigen::VectorXd stand_ins[] = {model_->output_mean, state_means.outputs.col(frame),
                                           mapped.outputs.col(frame),
                                           synthesised.outputs.col(frame)};
      for (const Estimate estimate : estimates)
        result.angle_sums[static_cast<int>(estimate)] +=
            stream_errors(*model_, stand_ins[static_cast<int>(estimate)], true_outputs);
      result.right_steps += synthesised.decisions[frame].label == synthesised.true_label[frame];
      ++result.frames;
      if (frame < mapped.begin + 3) continue;
      const auto jerk = [&](const Eigen::MatrixXd& outputs) {
        return mean_jerk(outputs, frame, evaluation_.counted, model_->frame_rate);
      };
      result.jerk_truth += jerk(truth.outputs);
      result.jerk_mapped += jerk(mapped.outputs);
      result.jerk_synthesised += jerk(synthesised.outputs);
      ++result.jerk_frames;
    }
    judge_styles(synthesised, result);
  }

  void judge_styles(const PlayedSequence& played, EvaluatedClip& result) {
    const auto at = std::find(model_->styles.begin(), model_->styles.end(), result.style);
    if (played.style_posteriors.rows() == 0) return;
    Eigen::VectorXd votes = Eigen::VectorXd::Zero(played.style_posteriors.rows());
    const int truth = static_cast<int>(at - model_->styles.begin());
    result.style_known = at != model_->styles.end();
    for (int frame = played.begin; frame < played.end; ++frame) {
      int best = 0;
      const double probability = played.style_posteriors.col(frame).maxCoeff(&best);
      votes += played.style_posteriors.col(frame).cast<double>();
      if (!result.style_known) continue;
      result.right_styles += best == truth;
      evaluation_.confusion(truth, best) += 1;
      calibration_.add(probability, best == truth);
    }
    votes.maxCoeff(&result.best_style);
  }

  // The whole of it, as it would be played: times per frame, root from the feet, slide.
  void compare_roots(const Clip& clip, const JointRoles& clip_roles,
                     const std::vector<int>& matched, const WalkTrack& track,
                     const BodyPoses& poses, EvaluatedClip& result) {
    const ReconstructedClip walked = reconstruct_clip(fitted_model(*model_, clip.skeleton, matched),
                                                      poses, clip.frame_rate, clip.name, settings_);
    const JointRoles roles = body_roles(*model_->body);
    evaluation_.delay_frames = walked.delay_frames;
    evaluation_.frame_microseconds.insert(evaluation_.frame_microseconds.end(),
                                          walked.frame_microseconds.begin(),
                                          walked.frame_microseconds.end());

    const auto slide = [&](const Clip& of, const JointRoles& its) {
      const auto stances = foot_slide(of, its, track.contacts).stances;
      result.stances = static_cast<int>(stances.size());
      return std::accumulate(stances.begin(), stances.end(), 0.0);
    };
    result.slide_captured = slide(clip, clip_roles);
    result.slide_synthesised = slide(walked.clip, roles);
    const auto path = [&](const Clip& of, const JointRoles& its) {
      const WorldPoses world = world_poses(of);
      const auto place = [&](int frame) {
        Eigen::Vector3d at =
            world.positions[static_cast<std::size_t>(frame) * of.skeleton.joints.size() + its.hips];
        at.y() = 0;
        return at;
      };
      return (place(track.contacts.back().frame) - place(track.contacts.front().frame)).norm();
    };
    const double captured = path(clip, clip_roles);
    if (track.treadmill || captured < least_path) return;
    result.path_captured = captured;
    result.path_synthesised = path(walked.clip, roles);
  }

  std::shared_ptr<const Model> model_;
  PlaySettings settings_;
  RoleTable role_table_;
  PlayModel played_;
  Evaluation evaluation_;
  CalibrationError calibration_;
};

}  // namespace

Evaluation evaluate(std::shared_ptr<const Model> model, const std::vector<Walk>& walks,
                    const PlaySettings& settings, const RoleTable& roles,
                    const std::function<void(double)>& progress) {
  Evaluator evaluator(std::move(model), settings, roles);
  for (std::size_t i = 0; i < walks.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(walks.size()));
    evaluator.add(walks[i]);
  }
  Evaluation evaluation = evaluator.finish();
  if (evaluation.clips.empty())
    throw Error("expected at least one clip with steps to evaluate on; none of " +
                std::to_string(walks.size()) + " has them");
  return evaluation;
}

}  // namespace gait
