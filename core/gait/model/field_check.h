// Checks of a model's fields: each throws Error naming the field, what it should hold and what it
// does.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace gait {

// Playing works in float: nothing in a model is larger.
inline constexpr double largest_number = 1e12;

[[noreturn]] void fail(const std::string& field,
                       const std::string& what);               // "FIELD: expected WHAT"
std::string item(const std::string& list, std::size_t index);  // "list[3]"

void expect_within(double value, double least, double most, const std::string& field);
void expect_number(double value, const std::string& field);
void expect_seconds(double value, const std::string& field);
void expect_text(const std::string& text, const std::string& field);  // UTF-8
void expect_texts(const std::vector<std::string>& texts, const std::string& field);
// Distinct names: none empty, none twice.
void expect_names(const std::vector<std::string>& names, const std::string& field);
void expect_values(const Eigen::Ref<const Eigen::MatrixXd>& values, Eigen::Index rows,
                   Eigen::Index columns, const std::string& field);
// Each from 0 to below `count`, and once.
void expect_indices(const std::vector<int>& indices, int count, const std::string& field);

}  // namespace gait
