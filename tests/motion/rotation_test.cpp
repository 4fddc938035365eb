#include "gait/motion/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

namespace gait {
namespace {

Eigen::Vector3d random_vector(std::mt19937& random, double length) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized() * length;
}

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

TEST(Rotation, the_exponential_map_is_the_matrix_exponential) {
  std::mt19937 random(1);
  for (const double angle : {0.0, 1e-9, 9e-4, 1.1e-3, 0.1, 1.0, 3.0, 3.14159}) {
    const Eigen::Vector3d vector = random_vector(random, angle);
    const Eigen::Matrix3d expected = skew(vector).exp();
    EXPECT_LT((exponential_map<double>(vector).toRotationMatrix() - expected).norm(), 1e-12)
        << "angle " << angle;
  }
}

TEST(Rotation, a_rotation_vector_survives_the_way_there_and_back) {
  std::mt19937 random(2);
  for (const double angle : {0.0, 1e-10, 1e-5, 2.1e-4, 1e-3, 0.5, 2.0, 3.1415}) {
    const Eigen::Vector3d vector = random_vector(random, angle);
    const Eigen::Quaterniond q = exponential_map<double>(vector);
    EXPECT_LT((rotation_vector(q) - vector).norm(), 1e-11) << "angle " << angle;
    EXPECT_LT((rotation_vector(Eigen::Quaterniond(-q.coeffs())) - vector).norm(), 1e-11);
  }
}

TEST(Rotation, the_map_is_smooth_where_its_branches_meet) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
  const auto below = exponential_map<double>(axis * (1e-3 - 1e-12));
  const auto above = exponential_map<double>(axis * (1e-3 + 1e-12));
  EXPECT_LT((below.coeffs() - above.coeffs()).norm(), 1e-11);
}

TEST(Rotation, the_angle_between_agrees_with_eigen) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const auto a = exponential_map<double>(random_vector(random, 0.03 * i));
    const auto b = exponential_map<double>(random_vector(random, 3.0 - 0.03 * i));
    EXPECT_NEAR(angle_between(a, b), a.angularDistance(b), 1e-9);
  }
}

TEST(Rotation, swing_and_twist_make_the_rotation_again) {
  std::mt19937 random(4);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  for (int i = 0; i < 100; ++i) {
    const auto q = exponential_map<double>(random_vector(random, 0.031 * i));
    const auto split = swing_twist<double>(q, up);
    EXPECT_LT(angle_between<double>(split.swing * split.twist, q), 1e-7);
    EXPECT_NEAR(split.swing.vec().dot(up), 0, 1e-12);
    EXPECT_NEAR(split.twist.vec().cross(up).norm(), 0, 1e-12);
  }
}

TEST(Rotation, the_chordal_mean_of_two_lies_half_way_whatever_their_signs) {
  const auto a = exponential_map<double>({0.2, 0.4, -0.1});
  const auto b = exponential_map<double>({-0.3, 0.5, 0.6});
  const std::vector<Eigen::Quaterniond> same{a, b};
  const std::vector<Eigen::Quaterniond> flipped{a, Eigen::Quaterniond(-b.coeffs())};
  const auto half_way = slerp(a, b, 0.5);
  EXPECT_LT(angle_between(chordal_mean(same), half_way), 1e-7);
  EXPECT_LT(angle_between(chordal_mean(flipped), half_way), 1e-7);
}

TEST(Rotation, a_turn_between_two_directions_is_the_shortest_one_whatever_their_lengths) {
  std::mt19937 random(6);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d from = random_vector(random, 0.1 + i), to = random_vector(random, 2);
    const auto turn = turn_between(from, to);
    EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), 1e-12);
    EXPECT_NEAR(angle_between(turn, Eigen::Quaterniond::Identity()),
                std::acos(from.normalized().dot(to.normalized())), 1e-7);
  }
  const Eigen::Vector3d way(1, 2, -3);
  const auto back = turn_between(way, -2 * way);
  EXPECT_LT((back * way + way).norm(), 1e-12);
  EXPECT_NEAR(back.norm(), 1, 1e-12);
}

}  // namespace
}  // namespace gait
