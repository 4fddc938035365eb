// Reports as JSON, for --json.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>

namespace gait::tool {

// To standard output. Bytes that are not UTF-8 (names of files may hold any) are replaced.
inline void print_report(const nlohmann::ordered_json& report) {
  std::puts(report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

}  // namespace gait::tool
