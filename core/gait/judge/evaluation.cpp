#include "gait/judge/evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gait/error.h"
#include "gait/judge/calibration.h"
#include "gait/judge/foot_slide.h"
#include "gait/judge/played_sequence.h"
#include "gait/judge/reconstructed_clip.h"
#include "gait/model/body_pose.h"
#include "gait/motion/contacts.h"
#include "gait/motion/resample.h"

namespace gait {

namespace {

constexpr int fewest_steps = 2;

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
  Evaluator(std::shared_ptr<const Model> model, const PlayerSettings& settings,
            const RoleTable& roles)
      : model_(std::move(model)),
        settings_(settings),
        role_table_(roles),
        tables_(make_state_tables(*model_)) {
    if (!model_->body)
      throw Error("model " + model_->name + ": expected a model of a body to evaluate on clips");
    const Body& body = *model_->body;
    for (const int joint : body.output_joints) {
      evaluation_.output_names.push_back(body.skeleton.joints[joint].name);
      evaluation_.counted.push_back(body.roles[joint] != Role::hips);
    }
    const auto styles = static_cast<Eigen::Index>(model_->styles.size());
    evaluation_.styles = model_->styles;
    evaluation_.confusion = Eigen::MatrixXi::Zero(styles, styles);
  }

  void add(const Walk& walk) {
    const Clip clip = resampled(walk.clip, model_->frame_rate);
    const Body& body = *model_->body;
    const auto matched = match_joints(body, clip.skeleton, clip.name);
    const JointRoles clip_roles = find_roles(clip.skeleton, role_table_);
    WalkTrack track = follow_walk(clip, clip_roles);
    if (!walk.contacts.empty())
      track.contacts = contacts_at(walk.contacts, model_->frame_rate / walk.clip.frame_rate);
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
    compare_roots(clip, clip_roles, track, poses, result);
    evaluation_.clips.push_back(std::move(result));
  }

  Evaluation finish() {
    evaluation_.calibration_error = calibration_.value();
    return std::move(evaluation_);
  }

 private:
  PlayedSequence play(const Sequence& truth, std::optional<double> strength, bool smooth) const {
    PlayerSettings settings = settings_;
    if (strength) settings.strength = strength;
    if (!smooth) settings.past = 0, settings.future = 0, settings.current = 1;
    return play_sequence(model_, settings, truth, tables_);
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
      for (const Stage stage : stages)
        result.angle_sums[static_cast<int>(stage)] +=
            stream_errors(*model_, stand_ins[static_cast<int>(stage)], true_outputs);
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
  void compare_roots(const Clip& clip, const JointRoles& clip_roles, const WalkTrack& track,
                     const BodyPoses& poses, EvaluatedClip& result) {
    const ReconstructedClip walked =
        reconstruct_clip(model_, poses, clip.frame_rate, clip.name, settings_);
    const JointRoles roles = body_roles(*model_->body);
    evaluation_.delay_frames = walked.delay_frames;
    evaluation_.frame_microseconds.insert(evaluation_.frame_microseconds.end(),
                                          walked.frame_microseconds.begin(),
                                          walked.frame_microseconds.end());

    result.slide_captured = foot_slide(clip, clip_roles, track.contacts).mean;
    result.slide_synthesised = foot_slide(walked.clip, roles, track.contacts).mean;
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
    result.path_ratio = track.treadmill || captured < 0.5 ? 0 : path(walked.clip, roles) / captured;
  }

  std::shared_ptr<const Model> model_;
  PlayerSettings settings_;
  RoleTable role_table_;
  std::shared_ptr<const StateTables> tables_;
  Evaluation evaluation_;
  CalibrationError calibration_;
};

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Mean of per-clip shares, or of all frames together.
template <typename Sum, typename Count>
double averaged(const std::vector<EvaluatedClip>& clips, bool pooled, Sum sum, Count count) {
  double total = 0, weight = 0;
  for (const EvaluatedClip& clip : clips) {
    const double frames = count(clip);
    if (frames <= 0) continue;
    total += pooled ? sum(clip) : sum(clip) / frames;
    weight += pooled ? frames : 1;
  }
  return weight > 0 ? total / weight : none;
}

double counted_mean(const Eigen::VectorXd& sums, const std::vector<bool>& counted) {
  double sum = 0;
  int streams = 0;
  for (std::size_t i = 0; i < counted.size(); ++i)
    if (counted[i]) sum += sums[static_cast<Eigen::Index>(i)], ++streams;
  return streams > 0 ? sum / streams : 0;
}

}  // namespace

double Evaluation::error(Stage stage, bool pooled, const std::string& style) const {
  return averaged(
      clips, pooled,
      [&](const EvaluatedClip& clip) {
        return counted_mean(clip.angle_sums[static_cast<int>(stage)], counted);
      },
      [&](const EvaluatedClip& clip) {
        return style.empty() || clip.style == style ? clip.frames : 0;
      });
}

double Evaluation::stream_error(Stage stage, int stream) const {
  return averaged(
      clips, false,
      [&](const EvaluatedClip& clip) { return clip.angle_sums[static_cast<int>(stage)][stream]; },
      [](const EvaluatedClip& clip) { return clip.frames; });
}

double Evaluation::step_accuracy(bool pooled) const {
  return averaged(
      clips, pooled, [](const EvaluatedClip& clip) { return clip.right_steps; },
      [](const EvaluatedClip& clip) { return clip.frames; });
}

double Evaluation::style_accuracy(bool pooled) const {
  return averaged(
      clips, pooled, [](const EvaluatedClip& clip) { return clip.right_styles; },
      [](const EvaluatedClip& clip) { return clip.style_known ? clip.frames : 0; });
}

double Evaluation::style_accuracy_of_clips() const {
  double right = 0, known = 0;
  for (const EvaluatedClip& clip : clips) {
    if (!clip.style_known) continue;
    right += clip.best_style >= 0 && styles[clip.best_style] == clip.style;
    known += 1;
  }
  return known > 0 ? right / known : none;
}

Evaluation evaluate(std::shared_ptr<const Model> model, const std::vector<Walk>& walks,
                    const PlayerSettings& settings, const RoleTable& roles) {
  Evaluator evaluator(std::move(model), settings, roles);
  for (const Walk& walk : walks) evaluator.add(walk);
  Evaluation evaluation = evaluator.finish();
  if (evaluation.clips.empty())
    throw Error("expected at least one clip with steps to evaluate on; none of " +
                std::to_string(walks.size()) + " has them");
  return evaluation;
}

}  // namespace gait
