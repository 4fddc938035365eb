#include "gait/model/model_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gait/error.h"
#include "same_model.h"
#include "small_model.h"

namespace gait {
namespace {

using nlohmann::json;

class ModelFile : public ::testing::Test {
 protected:
  ModelFile()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                ("model_file_" +
                 std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ModelFile() override { std::filesystem::remove_all(folder_); }

  json document(const Model& model) const {
    return json::from_cbor(model_bytes(model), true, true, json::cbor_tag_handler_t::store);
  }

  std::filesystem::path folder_;
};

TEST_F(ModelFile, a_model_written_and_read_again_is_the_same_to_the_bit) {
  const Model model = testing::learnt_model();
  ASSERT_EQ(model.input.modelled.size(), 7U);  // one of eight values does not move
  ASSERT_EQ(model.states(), 4);
  write_model(model, folder_ / "small.gait");
  testing::expect_same(model, read_model(folder_ / "small.gait"));
}

TEST_F(ModelFile, values_that_are_hard_to_print_come_back_to_the_bit) {
  Model model = testing::learnt_model();
  model.labels[0].states[1].mean[2] = std::nextafter(0.1, 1);
  model.labels[0].states[1].mean[3] = -0.0;
  model.labels[0].states[1].mean[4] = 5e-324;
  model.training.log_likelihood = {-0.0, 1.0 / 3, 16777217, -123456.789, 1e-310};
  model.body->skeleton.joints[1].offset = {1.0 / 3, -0.0, 2e-9};
  testing::expect_same(model, parse_model(model_bytes(model), "small"));
}

TEST_F(ModelFile, a_model_without_body_styles_or_outputs_is_kept_as_well) {
  Model model = testing::learnt_model();
  model.body.reset();
  model.styles.clear();
  model.outputs.clear();
  model.output = {};
  model.output_scaling = {};
  model.output_mean.resize(0);
  model.training.target.conservativeResize(model.input.size());
  const int inputs = model.input.size();
  model.input_mean.resize(0);
  for (Label& label : model.labels) {
    label.style_durations.resize(0);
    for (State& state : label.states) {
      state.trajectory_means.resize(0, 0);
      state.trajectory_variances.resize(0);
      state.mean = state.mean.head(inputs).eval();
      state.covariance = state.covariance.topLeftCorner(inputs, inputs).eval();
      state.style_means.resize(0, 0);
      state.style_covariance.resize(0, 0);
    }
  }
  testing::expect_same(model, parse_model(model_bytes(model), "small"));
}

TEST_F(ModelFile, history_is_kept_in_seconds_and_comes_back_as_the_same_frames) {
  Model model = testing::learnt_model();
  for (const double rate : {1.0, 24.0, 29.97, 30.0, 59.94, 120.0, 333.3, 1000.0}) {
    model.frame_rate = rate;
    for (int lag = 1; lag + 1 <= 10 * rate && lag < 150; ++lag) {
      model.input.lags = {lag, lag + 1};
      const Model read = parse_model(model_bytes(model), "small");
      ASSERT_EQ(read.input.lags, model.input.lags) << rate << " frames/s";
    }
  }
  const json file = document(model);
  EXPECT_EQ(file["input"]["history"][0].get<double>(), model.input.lags[0] / 1000.0);
}

TEST_F(ModelFile, what_a_later_version_adds_is_passed_over) {
  const Model model = testing::learnt_model();
  json file = document(model);
  file["cycle_spaces"] = {{{"mean", json::binary({1, 2, 3})}, {"styles", {"sad", 3, nullptr}}}};
  file["labels"][0]["colour"] = "red";
  file["labels"][0]["states"][1]["skew"] = json::array();
  file["body"]["height"] = 1.8;
  testing::expect_same(model, parse_model(json::to_cbor(file), "small"));
}

// As any program would read it that knows RFC 8949 and RFC 8746 and nothing of this library.
TEST_F(ModelFile, another_program_finds_the_numbers_where_the_documentation_says) {
  const Model model = testing::learnt_model();
  const json state = document(model)["labels"][1]["states"][0];
  const Eigen::MatrixXd& covariance = model.labels[1].states[0].covariance;
  const auto size = static_cast<std::size_t>(covariance.rows());
  EXPECT_EQ(state["covariance"]["shape"], json({size, size}));
  const json::binary_t& bytes = state["covariance"]["data"].get_binary();
  EXPECT_EQ(bytes.subtype(), 86U);  // float64, little endian
  ASSERT_EQ(bytes.size(), size * (size + 1) / 2 * 8);
  std::size_t at = 0;
  for (std::size_t column = 0; column < size; ++column)
    for (std::size_t row = column; row < size; ++row) {
      std::uint64_t bits = 0;
      for (std::size_t i = 0; i < 8; ++i) bits |= std::uint64_t{bytes[at + i]} << (8 * i);
      at += 8;
      ASSERT_EQ(std::bit_cast<double>(bits), covariance(row, column));
    }
  const json::binary_t& means = state["style_means"]["data"].get_binary();
  double second_style = 0;  // its first value, when styles follow each other
  std::memcpy(&second_style, &means[8 * size], 8);
  EXPECT_EQ(second_style, model.labels[1].states[0].style_means(0, 1));
}

TEST_F(ModelFile, a_model_that_cannot_be_written_leaves_the_old_file_as_it_was) {
  Model model = testing::learnt_model();
  write_model(model, folder_ / "small.gait");
  Model broken = model;
  broken.labels[0].states[0].stay = 1;
  EXPECT_THROW(write_model(broken, folder_ / "small.gait"), Error);
  testing::expect_same(model, read_model(folder_ / "small.gait"));
  model.name = "another";
  write_model(model, folder_ / "small.gait");
  EXPECT_EQ(read_model(folder_ / "small.gait").name, "another");
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++files;
  EXPECT_EQ(files, 1);
}

TEST_F(ModelFile, paths_that_hold_no_model_are_errors_that_name_them) {
  std::ofstream(folder_ / "empty.gait").close();
  std::filesystem::create_directories(folder_ / "taken.gait" / "inside");
  for (const char* name : {"missing.gait", "empty.gait", "taken.gait"}) try {
      read_model(folder_ / name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  const Model model = testing::learnt_model();
  EXPECT_THROW(write_model(model, folder_ / "nowhere" / "small.gait"), Error);
  EXPECT_THROW(write_model(model, folder_ / "taken.gait"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "taken.gait.part"));
}

TEST_F(ModelFile, a_large_model_is_loaded_within_50_ms) {
#ifndef NDEBUG
  GTEST_SKIP() << "times say something of optimised builds only";
#endif
  write_model(testing::large_model(), folder_ / "large.gait");
  double fastest = 1e9;
  for (int i = 0; i < 10; ++i) {
    const std::clock_t start = std::clock();  // of the processor: what else runs does not count
    const Model model = read_model(folder_ / "large.gait");
    const double took = 1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    ASSERT_EQ(model.states(), 24);
    fastest = std::min(fastest, took);
  }
  RecordProperty("milliseconds", std::to_string(fastest));
  std::cout << "loaded in " << fastest << " ms\n";
  EXPECT_LT(fastest, 50);
}

}  // namespace
}  // namespace gait
