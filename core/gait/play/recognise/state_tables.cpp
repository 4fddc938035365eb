#include "gait/play/recognise/state_tables.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "gait/error.h"
#include "gait/model/hips_frame.h"

namespace gait {

namespace {

// Linear discriminants of the styles from the leading `count` entries: score = w^T x + b.
void set_styles(PlayedState& played, const Eigen::MatrixXd& means, const Eigen::MatrixXd& factor,
                const std::vector<int>& depths) {
  for (const int count : depths) {
    const auto lower = factor.topLeftCorner(count, count).triangularView<Eigen::Lower>();
    Eigen::MatrixXd weights = means.topRows(count);
    lower.solveInPlace(weights);
    const Eigen::VectorXd bias = -0.5 * weights.colwise().squaredNorm();
    lower.transpose().solveInPlace(weights);
    played.style_scores.emplace_back(weights.transpose(), bias, PackedMap::Shape::full);
  }
}

// `shift`: see hips_frame_shift.
PlayedState played_state(const State& state, const StateTables& tables,
                         const Eigen::MatrixXd& shift) {
  PlayedState played;
  const auto& kept = tables.kept;
  const int count = static_cast<int>(kept.size());
  const int inputs = static_cast<int>(state.mean.size()) - tables.outputs;
  std::vector<int> outputs(tables.outputs);
  for (int i = 0; i < tables.outputs; ++i) outputs[i] = inputs + i;

  const Eigen::MatrixXd seen = shift(kept, Eigen::all), sought = shift(outputs, Eigen::all);
  const Eigen::LLT<Eigen::MatrixXd> cholesky(state.covariance(kept, kept) +
                                             seen * seen.transpose());
  if (cholesky.info() != Eigen::Success)
    throw Error("expected positive definite covariances; one of the model's is not");
  const Eigen::MatrixXd lower = cholesky.matrixL();
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(count, count);
  cholesky.matrixL().solveInPlace(inverse);
  played.whitener = PackedMap(inverse, -inverse * state.mean(kept), PackedMap::Shape::lower);
  // G = Sigma_yx L^-T, in one product
  const Eigen::MatrixXd gain =
      (state.covariance(outputs, kept) + sought * seen.transpose()) * inverse.transpose();
  played.gain = PackedMap(gain, Eigen::VectorXd::Zero(tables.outputs), PackedMap::Shape::full);
  if (state.phase_covariance.size() > 0) {
    played.phase = static_cast<float>(state.phase);
    played.phase_gain = (inverse * state.phase_covariance(kept)).cast<float>();
  }
  played.output_mean = state.mean.tail(tables.outputs).cast<float>();
  played.output_variance =
      (state.covariance.diagonal().tail(tables.outputs) + sought.cwiseAbs2().rowwise().sum())
          .cast<float>();

  const auto depths = static_cast<Eigen::Index>(tables.depths.size());
  played.log_constant.resize(depths);
  played.explained_variance.resize(tables.outputs, depths);
  for (Eigen::Index depth = 0; depth < depths; ++depth) {
    const int known = tables.depths[depth];
    played.log_constant[depth] =
        static_cast<float>(-lower.diagonal().head(known).array().log().sum() -
                           0.5 * known * std::log(2 * std::numbers::pi));
    played.explained_variance.col(depth) =
        gain.leftCols(known).rowwise().squaredNorm().cast<float>();
  }
  if (tables.styles > 0) {
    const Eigen::LLT<Eigen::MatrixXd> within(state.style_covariance(kept, kept));
    if (within.info() != Eigen::Success)
      throw Error("expected positive definite style covariances; one of the model's is not");
    set_styles(played, state.style_means(kept, Eigen::all), within.matrixL(), tables.depths);
  }
  played.log_stay = static_cast<float>(std::log(state.stay));
  played.log_leave = static_cast<float>(std::log1p(-state.stay));
  played.mean_duration = static_cast<float>(state.duration);
  return played;
}

}  // namespace

int StateTables::depth_of(int known, const InputLayout& layout) const {
  const int lags = layout.statics() == 0 ? 0 : known / layout.statics() - 1;
  return std::min(std::max(lags, 0), static_cast<int>(depths.size()) - 1);
}

std::shared_ptr<const StateTables> make_state_tables(const Model& model,
                                                     const std::vector<bool>& missing) {
  auto tables = std::make_shared<StateTables>();
  const int statics = model.input.statics();
  for (int entry = 0; entry < model.input.size(); ++entry)
    if (missing.empty() || !missing[model.input.modelled[entry % statics]])
      tables->kept.push_back(entry);
  if (tables->kept.empty())
    throw Error("expected at least one input that is there; all are missing");
  const int kept_statics = static_cast<int>(tables->kept.size()) / (model.input.size() / statics);
  for (std::size_t depth = 0; depth <= model.input.lags.size(); ++depth)
    tables->depths.push_back(kept_statics * static_cast<int>(depth + 1));
  tables->outputs = model.output.size();
  tables->styles = static_cast<int>(model.styles.size());
  const Eigen::MatrixXd shift = hips_frame_shift(model);

  for (std::size_t label = 0; label < model.labels.size(); ++label) {
    tables->first_state.push_back(static_cast<int>(tables->states.size()));
    tables->successors.push_back(model.labels[label].successors);
    float before = 0;
    for (const State& state : model.labels[label].states) {
      PlayedState played = played_state(state, *tables, shift);
      played.label = static_cast<int>(label);
      played.before = before;
      before += played.mean_duration;
      tables->states.push_back(std::move(played));
    }
    tables->label_duration.push_back(before);
  }
  return tables;
}

}  // namespace gait
