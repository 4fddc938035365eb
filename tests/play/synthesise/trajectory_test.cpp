// The banded solution against W^T V^-1 W c = W^T V^-1 mu, written out densely in double.
#include "gait/play/synthesise/trajectory.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <deque>
#include <random>

#include "gait/motion/observation.h"

namespace gait {
namespace {

constexpr int values = 3;

OutputGaussian random_gaussian(std::mt19937& random) {
  std::normal_distribution<float> normal;
  // Variances over four decades, as joints that hardly move stand beside those that swing.
  std::uniform_real_distribution<float> decade(-3, 1);
  OutputGaussian gaussian;
  gaussian.mean = Eigen::VectorXf::NullaryExpr(3 * values, [&] { return normal(random); });
  gaussian.variance =
      Eigen::VectorXf::NullaryExpr(3 * values, [&] { return std::pow(10.0f, decade(random)); });
  return gaussian;
}

// Windows, means and inverse variances of one output value over the queue.
struct Dense {
  Eigen::MatrixXd windows;
  Eigen::VectorXd means, weights;

  Dense(const std::deque<OutputGaussian>& queue, int value) {
    const int frames = static_cast<int>(queue.size());
    const int whole = std::max(0, frames - 2);  // frames whose window lies inside the queue
    windows = Eigen::MatrixXd::Zero(frames + 2 * whole, frames);
    means.resize(windows.rows());
    weights.resize(windows.rows());
    int row = 0;
    const auto add = [&](int frame, int part) {
      means[row] = queue[frame].mean[part * values + value];
      weights[row] = 1.0 / queue[frame].variance[part * values + value];
      ++row;
    };
    for (int frame = 0; frame < frames; ++frame) {
      windows(row, frame) = 1;
      add(frame, 0);
    }
    for (int frame = 1; frame + 1 < frames; ++frame)
      for (int part = 1; part <= 2; ++part) {
        for (int offset = -1; offset <= 1; ++offset)
          windows(row, frame + offset) =
              (part == 1 ? first_difference : second_difference)[offset + 1];
        add(frame, part);
      }
  }

  Eigen::VectorXd path() const {
    const Eigen::MatrixXd weighted = weights.asDiagonal() * windows;
    return (windows.transpose() * weighted)
        .ldlt()
        .solve(windows.transpose() * weights.cwiseProduct(means));
  }
  double log_likelihood(const Eigen::VectorXd& path_of) const {
    return -0.5 * weights.dot((windows * path_of - means).cwiseAbs2());
  }
};

// Float over four decades of variances.
constexpr double tolerance = 2e-3;

TEST(Trajectory, is_the_dense_maximum_likelihood_solution_for_every_shape_of_queue) {
  std::mt19937 random(1);
  for (const int past : {whole_past, 0, 1, 2, 5, 20})
    for (const int current : {1, 2, 3})
      for (const int future : {0, 1, 2, 7}) {
        Trajectory trajectory(values, past, current, future);
        EXPECT_EQ(trajectory.delay(), future + current - 1);
        std::deque<OutputGaussian> queue;
        int pushed = 0, left = 0;
        for (int frame = 0; frame < std::max(past, 20) + 2 * (current + future) + 6; ++frame) {
          queue.push_back(random_gaussian(random));
          trajectory.push(queue.back());
          ++pushed;
          while (past != whole_past && static_cast<int>(queue.size()) > past + current + future)
            queue.pop_front();
          if (!trajectory.ready()) continue;
          const auto path = trajectory.generate();
          ASSERT_EQ(path.rows(), values);
          ASSERT_EQ(path.cols(), current);
          EXPECT_EQ(pushed - future - current, left) << "frames leave in order, none twice";
          left += current;
          const int first = static_cast<int>(queue.size()) - current - future;
          for (int value = 0; value < values; ++value) {
            const Eigen::VectorXd expected = Dense(queue, value).path().segment(first, current);
            EXPECT_LT((path.row(value).transpose().cast<double>() - expected).cwiseAbs().maxCoeff(),
                      tolerance)
                << "P " << past << " C " << current << " F " << future << " frame " << frame;
          }
        }
        EXPECT_GE(left, pushed - future - 2 * current + 1) << "C frames leave every C frames";
        // The end of the stream: what was still to come.
        const int rest = pushed - left;
        const auto path = trajectory.flush(rest);
        ASSERT_EQ(path.cols(), rest);
        for (int value = 0; value < values && rest > 0; ++value)
          EXPECT_LT(
              (path.row(value).transpose().cast<double>() - Dense(queue, value).path().tail(rest))
                  .cwiseAbs()
                  .maxCoeff(),
              tolerance);
      }
}

TEST(Trajectory, cannot_be_bettered_in_any_frame) {
  std::mt19937 random(2);
  Trajectory trajectory(values, 0, 1, 8);
  std::deque<OutputGaussian> queue;
  for (int frame = 0; frame < 9; ++frame) {
    queue.push_back(random_gaussian(random));
    trajectory.push(queue.back());
  }
  const Eigen::MatrixXf path = trajectory.flush(9);
  for (int value = 0; value < values; ++value) {
    const Dense dense(queue, value);
    const Eigen::VectorXd solution = path.row(value).transpose().cast<double>();
    for (int frame = 0; frame < 9; ++frame) {
      // Analytic gradient W^T V^-1 (mu - W c), against the numeric one and against zero.
      const double analytic = dense.windows.col(frame).dot(
          dense.weights.cwiseProduct(dense.means - dense.windows * solution));
      const double step = 1e-3;
      Eigen::VectorXd more = solution, less = solution;
      more[frame] += step;
      less[frame] -= step;
      const double numeric = (dense.log_likelihood(more) - dense.log_likelihood(less)) / (2 * step);
      const double curvature = dense.windows.col(frame).cwiseAbs2().dot(dense.weights);
      EXPECT_NEAR(numeric, analytic, 1e-6 * (1 + curvature));
      EXPECT_LT(std::abs(analytic), tolerance * curvature);
      EXPECT_LT(dense.log_likelihood(more),
                dense.log_likelihood(solution) + 1e-2 * curvature * step);
    }
  }
}

TEST(Trajectory, without_a_past_is_the_means_themselves) {
  std::mt19937 random(3);
  Trajectory trajectory(values, 0, 1, 0);
  for (int frame = 0; frame < 10; ++frame) {
    const OutputGaussian gaussian = random_gaussian(random);
    trajectory.push(gaussian);
    ASSERT_TRUE(trajectory.ready());
    EXPECT_LT((trajectory.generate().col(0) - gaussian.mean.head(values)).cwiseAbs().maxCoeff(),
              1e-5);
    EXPECT_FALSE(trajectory.ready()) << "a frame leaves once";
  }
}

TEST(Trajectory, begins_anew_after_a_reset) {
  std::mt19937 random(4);
  for (const int past : {whole_past, 5}) {
    Trajectory used(values, past, 1, 1), fresh(values, past, 1, 1);
    for (int i = 0; i < 20; ++i) used.push(random_gaussian(random));
    used.reset();
    EXPECT_FALSE(used.ready());
    for (int i = 0; i < 20; ++i) {
      const OutputGaussian gaussian = random_gaussian(random);
      used.push(gaussian);
      fresh.push(gaussian);
      ASSERT_EQ(used.ready(), fresh.ready());
      if (used.ready()) {
        const Eigen::MatrixXf a = used.generate(), b = fresh.generate();
        EXPECT_EQ(a, b);
      }
    }
  }
}

}  // namespace
}  // namespace gait
