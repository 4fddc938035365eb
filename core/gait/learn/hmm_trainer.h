// Training of the states (T14 §3): equal segmentation, segmental k-means, then Baum-Welch over
// known label sequences; x alone aligns, z = [x; y] is learnt under the same posteriors.
//
// The number of iterations is a choice: states that divide a step evenly in time map better than
// states that Baum-Welch has fitted to the upper body alone, so the default is few.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gait/cancel.h"
#include "gait/learn/state_statistics.h"

namespace gait {

struct HmmOptions {
  double regularisation = 30;  // kappa of the regularised M-step
  int slack = 2;               // frames by which boundaries may move
  int hard_iterations = 0;     // of segmental k-means
  int soft_iterations = 0;     // of Baum-Welch, at most
  double enough = 1e-4;        // stop when the penalised likelihood per frame gains less
  int threads = 0;             // 0: as many as the machine has; the result is the same
  // Called on the calling thread with the share done, 0..1, and the name of the present task.
  std::function<void(double, const std::string&)> progress;
  Cancel cancel;  // training then throws Error("cancelled")
};

struct TrainedStates {
  std::vector<Alignment> alignments;             // one per sequence
  std::vector<StateStatistics> statistics;       // over all sequences, under these alignments
  Eigen::VectorXd target;                        // T's diagonal, over z
  std::vector<double> stay;                      // per state
  std::vector<double> log_likelihood;            // of x, per iteration of Baum-Welch
  std::vector<double> penalised_log_likelihood;  // per iteration; it never falls
};

// Throws Error when a state gets no frames at all.
TrainedStates train_states(const std::vector<ObservedSequence>& sequences, const StateTable& table,
                           int styles, const HmmOptions& options);

// MAP estimate of a covariance: (count * S + kappa * diag(target)) / (count + kappa).
Eigen::MatrixXd regularised(const Eigen::MatrixXd& covariance, double count,
                            const Eigen::VectorXd& target, double kappa);

}  // namespace gait
