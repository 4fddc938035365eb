#include "gait/model/field_check.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "gait/error.h"

namespace gait {

void fail(const std::string& field, const std::string& what) {
  throw Error(field + ": expected " + what);
}

std::string item(const std::string& list, std::size_t index) {
  return list + '[' + std::to_string(index) + ']';
}

void expect_within(double value, double least, double most, const std::string& field) {
  if (!(value >= least && value <= most)) {
    char text[96];
    std::snprintf(text, sizeof text, "a number from %g to %g, found %g", least, most, value);
    fail(field, text);
  }
}

void expect_number(double value, const std::string& field) {
  expect_within(value, -largest_number, largest_number, field);
}

void expect_seconds(double value, const std::string& field) {
  expect_within(value, 0, largest_number, field);
}

void expect_text(const std::string& text, const std::string& field) {
  try {
    (void)nlohmann::json(text).dump();  // refuses what is not UTF-8
  } catch (const nlohmann::json::exception&) {
    fail(field, "text in UTF-8");
  }
}

void expect_texts(const std::vector<std::string>& texts, const std::string& field) {
  for (std::size_t i = 0; i < texts.size(); ++i) expect_text(texts[i], item(field, i));
}

void expect_names(const std::vector<std::string>& names, const std::string& field) {
  expect_texts(names, field);
  std::set<std::string> seen;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) fail(item(field, i), "a name, found none");
    if (!seen.insert(names[i]).second)
      fail(item(field, i), "a name of its own, found '" + names[i] + "' again");
  }
}

void expect_values(const Eigen::Ref<const Eigen::MatrixXd>& values, Eigen::Index rows,
                   Eigen::Index columns, const std::string& field) {
  if (values.rows() != rows || values.cols() != columns)
    fail(field, std::to_string(rows) + " by " + std::to_string(columns) + " values, found " +
                    std::to_string(values.rows()) + " by " + std::to_string(values.cols()));
  // Written so that NaN fails it.
  if (!(values.array().abs() <= largest_number).all())
    fail(field, "finite numbers up to 1e12, found others");
}

void expect_indices(const std::vector<int>& indices, int count, const std::string& field) {
  std::set<int> seen;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < 0 || indices[i] >= count)
      fail(item(field, i), "an index from 0 to " + std::to_string(count - 1) + ", found " +
                               std::to_string(indices[i]));
    if (!seen.insert(indices[i]).second)
      fail(item(field, i), "each index once, found " + std::to_string(indices[i]) + " again");
  }
}

}  // namespace gait
