#pragma once
/// Versions of the libraries with which the program is built, for the manifest.

#include <fmt/format.h>
#include <spdlog/version.h>
#include <Eigen/Core>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace pseudorigid::app {

/// Maps the name of each library to its version. The finite-element library adds its own libraries when it is opened.
inline std::map<std::string, std::string> common_libraries() {
  const auto version = [](int a, int b, int c) { return fmt::format("{}.{}.{}", a, b, c); };
  return {{"Eigen", version(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"fmt", version(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
          {"spdlog", version(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
          {"nlohmann-json",
           version(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)}};
}

}  // namespace pseudorigid::app
