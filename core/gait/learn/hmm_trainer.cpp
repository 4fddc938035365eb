#include "gait/learn/hmm_trainer.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "gait/error.h"
#include "gait/learn/parallel.h"

namespace gait {

namespace {

// Diagonal of the pooled within-state covariance, towards which each state's covariance is shrunk.
Eigen::VectorXd pooled_target(const std::vector<StateStatistics>& statistics) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(statistics.front().sum.size());
  double count = 0;
  for (const StateStatistics& state : statistics) {
    if (state.count <= 0) continue;
    sum += state.products.diagonal() - state.sum.cwiseAbs2() / state.count;
    count += state.count;
  }
  // A dimension that is constant within all states must not make a covariance singular.
  return (sum / count).cwiseMax(1e-4);
}

class TrainingRun {
 public:
  TrainingRun(const std::vector<ObservedSequence>& sequences, const StateTable& table, int styles,
              const HmmOptions& options)
      : sequences_(sequences), table_(table), styles_(styles), options_(options) {
    all_.resize(sequences.size());
    std::iota(all_.begin(), all_.end(), 0);
    trained_.alignments.resize(sequences.size());
  }

  TrainedStates run() {
    for (std::size_t i = 0; i < sequences_.size(); ++i)
      trained_.alignments[i] = align_equally(sequences_[i], table_);
    count();
    trained_.target = pooled_target(trained_.statistics);
    for (int i = 0; i < options_.hard_iterations; ++i) {
      report(i, "segmenting");
      realign(true);
      count();
    }
    if (options_.hard_iterations > 0) trained_.target = pooled_target(trained_.statistics);
    for (int i = 0; i < options_.soft_iterations; ++i) {
      report(options_.hard_iterations + i, "Baum-Welch");
      realign(false);
      const bool enough = converged();
      count();
      if (enough) break;
    }
    return std::move(trained_);
  }

 private:
  void report(int done, const char* what) const {
    if (options_.cancel.requested()) throw Error("cancelled");
    if (options_.progress)
      options_.progress(
          static_cast<double>(done) / (options_.hard_iterations + options_.soft_iterations), what);
  }

  void count() {
    trained_.statistics =
        gather(sequences_, trained_.alignments, all_, table_.total, styles_, options_.threads);
    std::vector<double> stays(table_.total, 0.0), leaves(table_.total, 0.0);
    for (const Alignment& alignment : trained_.alignments)
      for (int state = 0; state < table_.total; ++state) {
        stays[state] += alignment.stays[state];
        leaves[state] += alignment.leaves[state];
      }
    trained_.stay.resize(table_.total);
    for (int state = 0; state < table_.total; ++state) {
      if (trained_.statistics[state].count < 1)
        throw Error("expected frames for every state; state " + std::to_string(state) +
                    " got none: fewer states or more data");
      const double moves = stays[state] + leaves[state];
      trained_.stay[state] = std::clamp(moves > 0 ? stays[state] / moves : 0.5, 1e-3, 1 - 1e-3);
    }
  }

  void realign(bool hard) {
    const int inputs = static_cast<int>(sequences_.front().x.rows());
    std::vector<std::optional<Gaussian>> gaussians(table_.total);
    in_parallel(table_.total, options_.threads, [&](int state) {
      const StateStatistics& s = trained_.statistics[state];
      gaussians[state].emplace(s.mean().head(inputs),
                               regularised(s.covariance().topLeftCorner(inputs, inputs), s.count,
                                           trained_.target.head(inputs), options_.regularisation));
    });
    EmissionModel emissions;
    emissions.stay = trained_.stay;
    penalty_ = 0;
    for (int state = 0; state < table_.total; ++state) {
      if (!gaussians[state]->valid())
        throw Error("expected positive definite covariances; that of state " +
                    std::to_string(state) + " is not: a larger regularisation is needed");
      penalty_ += gaussians[state]->log_determinant() + trace_of_inverse(*gaussians[state]);
      emissions.of_state.push_back(std::move(*gaussians[state]));
    }
    in_parallel(static_cast<int>(sequences_.size()), options_.threads, [&](int i) {
      trained_.alignments[i] = align(sequences_[i], table_, emissions, options_.slack, hard);
    });
  }

  // tr(Sigma^-1 T)
  double trace_of_inverse(const Gaussian& gaussian) const {
    const int inputs = static_cast<int>(sequences_.front().x.rows());
    Eigen::MatrixXd scaled = trained_.target.head(inputs).cwiseSqrt().asDiagonal();
    gaussian.factor().matrixL().solveInPlace(scaled);
    return scaled.squaredNorm();
  }

  bool converged() {
    double likelihood = 0, frames = 0;
    for (std::size_t i = 0; i < sequences_.size(); ++i) {
      likelihood += trained_.alignments[i].log_likelihood;
      frames += sequences_[i].segments.back().end - sequences_[i].segments.front().begin;
    }
    const double penalised = likelihood - 0.5 * options_.regularisation * penalty_;
    const bool enough =
        !trained_.penalised_log_likelihood.empty() &&
        penalised - trained_.penalised_log_likelihood.back() < options_.enough * frames;
    trained_.log_likelihood.push_back(likelihood);
    trained_.penalised_log_likelihood.push_back(penalised);
    return enough;
  }

  const std::vector<ObservedSequence>& sequences_;
  const StateTable& table_;
  int styles_;
  const HmmOptions& options_;
  std::vector<int> all_;
  TrainedStates trained_;
  double penalty_ = 0;  // sum over states of log|Sigma| + tr(Sigma^-1 T)
};

}  // namespace

Eigen::MatrixXd regularised(const Eigen::MatrixXd& covariance, double count,
                            const Eigen::VectorXd& target, double kappa) {
  Eigen::MatrixXd result = covariance * (count / (count + kappa));
  result.diagonal() += target * (kappa / (count + kappa));
  return result;
}

TrainedStates train_states(const std::vector<ObservedSequence>& sequences, const StateTable& table,
                           int styles, const HmmOptions& options) {
  return TrainingRun(sequences, table, styles, options).run();
}

}  // namespace gait
