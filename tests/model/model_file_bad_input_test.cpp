// Whatever is wrong with a model file gives an error that names file and field, and nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "gait/error.h"
#include "gait/model/model_file.h"
#include "small_model.h"

namespace gait {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

const Model& small_model() {
  static const Model model = testing::learnt_model();
  return model;
}

const Bytes& small_bytes() {
  static const Bytes bytes = model_bytes(small_model());
  return bytes;
}

// What reading says; empty when it reads.
std::string error_of(std::span<const std::uint8_t> bytes) {
  try {
    parse_model(bytes, "some.gait");
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

std::string error_after(const std::function<void(json&)>& bend) {
  json file = json::from_cbor(small_bytes(), true, true, json::cbor_tag_handler_t::store);
  bend(file);
  return error_of(json::to_cbor(file));
}

void expect_says(const std::string& error, const std::string& part) {
  EXPECT_NE(error.find(part), std::string::npos)
      << "'" << error << "' does not say '" << part << "'";
}

struct Bent {
  std::string field, said;
  json value;  // in place of the field's
};

TEST(BadModelFile, a_field_of_the_wrong_kind_or_out_of_range_is_named) {
  const json nan = std::numeric_limits<double>::quiet_NaN(),
             inf = std::numeric_limits<double>::infinity();
  const std::vector<Bent> bends{
      {"/format", "format", "wav"},
      {"/version", "version: expected at most 2, found 3", 3},
      {"/version", "version", 0},
      {"/version", "version", "1"},
      {"/version", "version", 4294967297},
      {"/name", "name", 3},
      {"/name", "name: expected text in UTF-8",
       "m\xfc"
       "de"},
      {"/frame_rate", "frame_rate", 0},
      {"/frame_rate", "frame_rate", -30},
      {"/frame_rate", "frame_rate", 1e9},
      {"/frame_rate", "frame_rate: expected a finite number", nan},
      {"/frame_rate", "frame_rate: expected a finite number", inf},
      {"/inputs", "inputs: expected a list", 5},
      {"/inputs/0/size", "inputs[0].size", 4},
      {"/inputs/0/kind", "inputs[0].kind: expected one of rotation, plain", "colour"},
      {"/inputs/2/size", "inputs: expected 8 values", 3},
      {"/inputs/2/size", "inputs[2].size", 2000000000},
      {"/inputs/2/size", "inputs[2].size", 0},
      {"/inputs/2/size", "inputs[2].size", -2},
      {"/outputs/1/name", "outputs[1].name", nullptr},
      {"/input/values", "inputs: expected 9 values", 9},
      {"/input/modelled", "input.modelled: expected ascending", {1, 0, 2, 3, 5, 6, 7}},
      {"/input/modelled/6", "input.modelled[6]", 8},
      {"/input/modelled/0", "input.modelled[0]", -1},
      {"/input/modelled/1", "input.modelled[1]: expected each index once", 0},
      {"/input/modelled", "input.modelled: expected at least one", json::array()},
      {"/input/history/0", "input.history[0]: expected a time of whole frames", 0.0123},
      {"/input/history/0", "input.history[0]", 0},
      {"/input/history/0", "input.history[0]", -1},
      {"/input/history/1", "input.history[1]", 1e300},
      {"/input/history/0", "input.lags[1]: expected ascending", 4 / 29.97},
      {"/input/history", "input_scaling.mean", {1 / 29.97}},
      {"/output/modelled", "output_scaling.mean", {0, 1}},
      {"/styles", "labels[0].states[0].style_means", {"sad"}},
      {"/styles/1", "styles[1]: expected a name of its own", "sad"},
      {"/styles/1", "styles[1]: expected a name", ""},
      {"/labels", "labels: expected at least one", json::array()},
      {"/labels/0/name", "labels[1]: expected a name of its own", "left"},
      {"/labels/0/successors/0", "labels[0].successors[0]", 2},
      {"/labels/0/successors/0", "labels[0].successors[0]", -1},
      {"/labels/0/successors", "labels[0].successors[1]: expected each index once", {1, 1}},
      {"/labels/1/states", "labels[1].states: expected at least one", json::array()},
      {"/labels/1/duration", "labels[1].duration", -0.1},
      {"/labels/1/longest", "labels[1].longest", 0.001},
      {"/labels/1/states/0/stay", "labels[1].states[0].stay", 1},
      {"/labels/1/states/0/stay", "labels[1].states[0].stay", 0},
      {"/labels/1/states/0/weight", "labels[1].states[0].weight", -1},
      {"/labels/1/states/0/mean/shape", "labels[1].states[0].mean.data", {1000}},
      {"/labels/1/states/0/mean/shape", "labels[1].states[0].mean.shape", {-1}},
      {"/labels/1/states/0/mean/shape", "labels[1].states[0].mean.shape", {2000000000}},
      {"/labels/1/states/0/mean/shape", "labels[1].states[0].mean.shape", {33, 1}},
      {"/labels/1/states/0/mean/data", "labels[1].states[0].mean.data: expected bytes", "text"},
      {"/labels/1/states/0/mean/data", "labels[1].states[0].mean.data: expected bytes", 0},
      {"/labels/1/states/0/covariance/shape", "covariance.data", {16777216, 16777216}},
      {"/labels/1/states/0/covariance/shape", "expected as many columns as rows", {33, 32}},
      {"/body/joints", "body.joints: expected at least one", json::array()},
      {"/body/joints/1/parent", "body.joints[1].parent", 1},
      {"/body/joints/1/parent", "body.joints[1].parent", 3},
      {"/body/joints/1/parent", "body.joints[1].parent", -2},
      {"/body/joints/1/role", "body.joints[1].role: expected a joint's role, found 'tail'", "tail"},
      {"/body/joints/1/reference", "body.joints[1].reference: expected a unit", {1, 0.1, 0, 0}},
      {"/body/joints/1/reference", "body.joints[1].reference: expected 4 numbers", {1, 0, 0}},
      {"/body/joints/1/offset/2", "body.joints[1].offset[2]: expected a finite number", nan},
      {"/body/joints/2/tips/0", "body.joints[2].tips[0]", {1, 2}},
      {"/body/input_joints/0", "body.input_joints[0]", 4},
      {"/body/input_joints", "body.input_joints: expected 2 joints", {1}},
      {"/body/output_joints", "body.output_joints: expected 1 joints", {0, 1}},
      {"/body/heading_window", "body.heading_window", 0},
      {"/body/hinges/0/joints", "body.hinges[0].joints: expected 3 joints, found 2", {0, 1}},
      {"/body/hinges/0/joints", "body.hinges[0].joints: expected three joints", {1, 0, 2}},
      {"/body/hinges/0/joints", "body.hinges[0].joints: expected three joints", {0, 1, 9}},
      {"/body/hinges/0/joints", "body.hinges[0].joints: expected three joints", {-7, 1, 2}},
      {"/body/hinges/0/joints", "body.hinges[0].joints: expected three joints", {0, 1, -1}},
      {"/body/hinges/0/axis", "body.hinges[0].axis: expected a unit vector", {1, 1, 0}},
      {"/body/hinges/0/least", "body.hinges[0].least", -4},
      {"/body/hinges/0/most", "body.hinges[0].most", -0.2},
      {"/body/hinges/0/most", "body.hinges[0].most", nan},
      {"/play/decoder", "play.decoder: expected one of viterbi, forward, lag", "guess"},
      {"/play/past", "play.past", 1e9},
      {"/play/temper", "play.temper", -1},
      {"/play/easing", "play.easing", 0},
      {"/play/trust", "play.trust", -1},
      {"/input/clip", "input.clip: expected deviations above zero", 0},
      {"/input/clip", "input.clip", nan},
      {"/body/hips_frame", "body.hips_frame", -0.1},
      {"/training/subjects/0", "training.subjects[0]", 7},
      {"/training/placement", "training.placement", -1},
      {"/training/strangers_step_accuracy", "training.strangers_step_accuracy", 1.5},
      {"/training/clips/0", "training.clips[0]", 7},
      {"/training/log_likelihood/0", "training.log_likelihood[0]", nan},
      {"/training/synthetic", "training.synthetic: expected true or false", 1},
      {"/training/validated_step_accuracy", "training.validated_step_accuracy", 1.5},
  };
  for (const auto& [field, said, value] : bends) {
    const std::string error =
        error_after([&](json& file) { file.at(json::json_pointer(field)) = value; });
    SCOPED_TRACE(field + " = " + value.dump(-1, ' ', false, json::error_handler_t::replace));
    expect_says(error, "some.gait: ");
    expect_says(error, said);
  }
}

TEST(BadModelFile, a_field_that_is_missing_is_named) {
  const json file = json::from_cbor(small_bytes(), true, true, json::cbor_tag_handler_t::store);
  int fields = 0;
  const std::function<void(const json::json_pointer&, const std::string&)> each =
      [&](const json::json_pointer& at, const std::string& name) {
        const json& value = file.at(at);
        if (value.is_array() && !value.empty()) each(at / 0, name + "[0]");
        if (!value.is_object()) return;
        for (const auto& [key, unused] : value.items()) {
          std::string missing = name;
          missing += (name.empty() ? "" : ".") + key;
          static const std::set<std::string> some_files_have_none{
              "body.hinges",
              "body.hips_frame",
              "input.clip",
              "play.past",
              "play.easing",
              "play.trust",
              "training.subjects",
              "training.target",
              "training.placement",
              "training.strangers_error",
              "training.strangers_step_accuracy"};
          if (key == "phase_covariance") {
            // All states have it or, in files of before, none.
            expect_says(error_after([&](json& bent) { bent.at(at).erase(key); }),
                        "phase_covariance: expected");
          } else if (some_files_have_none.contains(missing)) {
            EXPECT_EQ(error_after([&](json& bent) { bent.at(at).erase(key); }), "");
          } else if (missing != "body" && missing != "input_mean") {
            expect_says(error_after([&](json& bent) { bent.at(at).erase(key); }),
                        key == "format" ? "format" : missing + ": expected this field, found none");
            ++fields;
          }
          each(at / key, missing);
        }
      };
  each(json::json_pointer(), "");
  EXPECT_GT(fields, 60);
}

// Faults that only a model in memory can have, or that hide in arrays.
TEST(BadModelFile, a_model_that_could_not_be_played_is_refused) {
  const auto expect_refused = [](const std::function<void(Model&)>& bend, const std::string& said) {
    Model model = small_model();
    bend(model);
    try {
      check_model(model);
      ADD_FAILURE() << "not refused: " << said;
    } catch (const Error& error) {
      expect_says(error.what(), said);
    }
    EXPECT_THROW(model_bytes(model), Error);
  };
  const double nan = std::nan("");
  const std::string covariance =
      "labels[1].states[1].covariance: expected a positive definite matrix";
  using M = Model;
  expect_refused([](M& m) { m.labels[1].states[1].covariance(3, 3) = -1; }, covariance);
  expect_refused([](M& m) { m.labels[1].states[1].covariance.setOnes(); }, covariance);
  expect_refused([](M& m) { m.labels[1].states[1].covariance.setZero(); }, covariance);
  expect_refused(
      [](M& m) {  // correlation above one
        Eigen::MatrixXd& sigma = m.labels[1].states[1].covariance;
        sigma(5, 2) = sigma(2, 5) = 1.001 * std::sqrt(sigma(2, 2) * sigma(5, 5));
      },
      covariance);
  expect_refused([](M& m) { m.labels[1].states[1].covariance(5, 2) += 0.1; },
                 "labels[1].states[1].covariance: expected a symmetric matrix");
  expect_refused([&](M& m) { m.labels[0].states[1].covariance(4, 2) = nan; },
                 "labels[0].states[1].covariance: expected finite numbers");
  expect_refused([](M& m) { m.labels[0].states[1].style_covariance *= -1; },
                 "labels[0].states[1].style_covariance: expected a positive definite matrix");
  expect_refused([](M& m) { m.labels[0].states[1].style_covariance.resize(0, 0); },
                 "labels[0].states[1].style_covariance");
  expect_refused([&](M& m) { m.labels[0].states[1].style_means(0, 0) = nan; },
                 "labels[0].states[1].style_means: expected finite numbers");
  expect_refused([](M& m) { m.labels[0].states[1].mean[0] = INFINITY; },
                 "labels[0].states[1].mean: expected finite numbers");
  expect_refused([](M& m) { m.labels[0].states[1].mean[0] = 1e30; },
                 "labels[0].states[1].mean: expected finite numbers");
  expect_refused([](M& m) { m.input_scaling.deviation[2] = 0; },
                 "input_scaling.deviation: expected deviations above zero");
  expect_refused([](M& m) { m.output_scaling.deviation[2] = -1; },
                 "output_scaling.deviation: expected deviations above zero");
  expect_refused([&](M& m) { m.output_scaling.mean[2] = nan; }, "output_scaling.mean");
  expect_refused([](M& m) { m.output_mean.resize(3); }, "output_mean");
  expect_refused([&](M& m) { m.frame_rate = nan; }, "frame_rate");
  expect_refused([&](M& m) { m.play.strength = nan; }, "play.strength");
  expect_refused([](M& m) { m.play.decoder = static_cast<DecoderKind>(9); }, "play.decoder");
  expect_refused([](M& m) { m.inputs[0].kind = static_cast<StreamKind>(9); }, "inputs[0].kind");
  expect_refused([](M& m) { m.body->roles[1] = static_cast<Role>(99); }, "body.joints[1].role");
  expect_refused([](M& m) { m.body->roles.pop_back(); }, "body");
  expect_refused([&](M& m) { m.body->references[1].w() = nan; }, "body.joints[1].reference");
  expect_refused([](M& m) { m.input.lags = {0, 4}; }, "input.lags[0]");
  expect_refused([](M& m) { m.input.lags = {4, 1000000}; }, "input.lags[1]");
  expect_refused([&](M& m) { m.training.penalised_log_likelihood[0] = nan; },
                 "training.penalised_log_likelihood");
  expect_refused([](M& m) { m.training.clips[1].push_back('\xff'); }, "training.clips[1]");
}

TEST(BadModelFile, other_files_are_told_from_models) {
  const auto bytes_of = [](std::string_view text) { return Bytes(text.begin(), text.end()); };
  for (const Bytes& bytes :
       {bytes_of("HIERARCHY\nROOT Hips\n"), bytes_of(""), bytes_of("{\"format\": \"gait\"}"),
        bytes_of("RIFF\x24\x08WAVEfmt "), Bytes(1000, 0), Bytes(1000, 0xff),
        json::to_cbor(json::object()), json::to_cbor({1, 2}), json::to_cbor("gait")}) {
    const std::string error = error_of(bytes);
    expect_says(error, "some.gait: ");
    expect_says(error, "expected");
  }
}

TEST(BadModelFile, nesting_without_end_is_an_error_and_no_overflow_of_the_stack) {
  // Lists, maps, tags, and strings of unknown length, which a recursive parser follows down.
  for (const std::uint8_t opening : Bytes{0x81, 0xa1, 0xc1, 0xd8, 0x5f, 0x7f, 0x9f, 0xbf})
    EXPECT_NE(error_of(Bytes(8'000'000, opening)), "") << int{opening};
}

TEST(BadModelFile, counts_that_lie_are_found_before_memory_is_taken) {
  // Heads of a list, map, text and bytes of 2^32 - 1, 2^63 and 2^64 - 1 items.
  for (const std::uint8_t major : Bytes{0x80, 0xa0, 0x60, 0x40})
    for (const Bytes& count :
         {Bytes{26, 0xff, 0xff, 0xff, 0xff}, Bytes{27, 0x80, 0, 0, 0, 0, 0, 0, 0},
          Bytes{27, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff}}) {
      Bytes bytes = count;
      bytes[0] |= major;
      bytes.resize(100);
      expect_says(error_of(bytes), "expected at least");
    }
  Bytes many(4'000'000, 0x80);  // a list of four million empty lists
  const Bytes head{0x9a, 0x00, 0x3d, 0x08, 0xfb};
  std::ranges::copy(head, many.begin());
  expect_says(error_of(many), "expected at most");
}

TEST(BadModelFile, a_file_cut_short_anywhere_is_an_error) {
  for (std::size_t size = 0; size < small_bytes().size(); size += 7)
    expect_says(error_of(std::span(small_bytes()).first(size)), "some.gait: ");
  Bytes longer = small_bytes();
  longer.push_back(0);
  expect_says(error_of(longer), "expected the end");
}

TEST(BadModelFile, bytes_changed_at_random_give_an_error_or_a_model_that_is_sound) {
  std::mt19937 random(20240229);
  const auto below = [&](std::size_t bound) {
    return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random);
  };
  int read = 0, refused = 0;
  for (int round = 0; round < 5000; ++round) {
    Bytes bytes = small_bytes();
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
      const std::size_t at = below(bytes.size());
      switch (below(5)) {
        case 0:
          bytes[at] ^= static_cast<std::uint8_t>(1U << below(8));
          break;
        case 1:
          bytes[at] = static_cast<std::uint8_t>(below(256));
          break;
        case 2:
          bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
          break;
        case 3:
          bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                       static_cast<std::uint8_t>(below(256)));
          break;
        default: {  // a piece of the file over another
          const std::size_t length = below(std::min<std::size_t>(64, bytes.size() - at)) + 1;
          const std::size_t from = below(bytes.size() - length + 1);
          std::copy_n(Bytes(bytes).begin() + static_cast<std::ptrdiff_t>(from), length,
                      bytes.begin() + static_cast<std::ptrdiff_t>(at));
        }
      }
    }
    try {
      check_model(parse_model(bytes, "some.gait"));
      ++read;
    } catch (const Error&) {
      ++refused;
    }
  }
  // Most hit a digit of some mean; enough hit structure.
  EXPECT_GT(refused, 500);
  EXPECT_GT(read, 50);
}

// Only structure: each byte outside of arrays becomes the head of a number, of bytes, of a list...
TEST(BadModelFile, every_byte_of_the_structure_can_be_wrong) {
  std::vector<bool> inside(small_bytes().size(), false);
  for (std::size_t at = 0; at + 3 < small_bytes().size(); ++at)
    if (small_bytes()[at] == 0xd8 && small_bytes()[at + 1] == 86) {
      // The length stands in the head itself, or in one or two bytes after it.
      const std::size_t kind = small_bytes()[at + 2];
      const std::size_t head = kind < 0x58 ? 3 : kind == 0x58 ? 4 : 5;
      const std::size_t length = head == 3   ? kind - 0x40
                                 : head == 4 ? small_bytes()[at + 3]
                                             : 256 * small_bytes()[at + 3] + small_bytes()[at + 4];
      for (std::size_t i = at + head; i < at + head + length; ++i) inside[i] = true;
      at += head + length - 1;
    }
  const Bytes heads{0x00, 0x1b, 0x5b, 0x7f, 0x9f, 0x9b, 0xbb, 0xd8, 0xf6, 0xfb, 0xff};
  int tried = 0;
  for (std::size_t at = 0; at < small_bytes().size(); ++at) {
    if (inside[at]) continue;
    ++tried;
    for (const std::size_t turn : {at, at + 1}) {
      Bytes bytes = small_bytes();
      bytes[at] = heads[turn % heads.size()];
      try {
        check_model(parse_model(bytes, "some.gait"));
      } catch (const Error&) {
      }
    }
  }
  EXPECT_GT(tried, 1000);
  EXPECT_LT(tried, 6000);
}

}  // namespace
}  // namespace gait
