#include "cli/study/diagnosis_inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

bool SameBytes(const std::string& one, const std::string& other) {
  std::ifstream first(one, std::ios::binary);
  std::ifstream second(other, std::ios::binary);
  const std::istreambuf_iterator<char> end;
  return first && second &&
         std::equal(std::istreambuf_iterator<char>(first), end,
                    std::istreambuf_iterator<char>(second), end);
}

/// A path that cannot be read is refused by whoever reads it.
bool SameFile(const std::string& one, const std::string& other) {
  std::error_code failed;
  if (fs::equivalent(one, other, failed) && !failed) return true;
  const auto first = fs::file_size(one, failed);
  if (failed) return false;
  const auto second = fs::file_size(other, failed);
  return !failed && first == second && SameBytes(one, other);
}

void RefuseShared(const std::vector<std::string>& data, const std::vector<std::string>& others,
                  const std::string& option, const std::string& remedy) {
  for (const std::string& other : others) {
    for (const std::string& given : data) {
      if (!SameFile(given, other)) continue;
      throw BadInput(fmt::format("{} {}: the same data as {}, which is diagnosed: {}", option,
                                 other, given, remedy));
    }
  }
}

}  // namespace

void RefuseSameFiles(const std::vector<std::string>& data, const std::vector<std::string>& holdout,
                     const std::vector<std::string>& healthy) {
  for (std::size_t i = 0; i < data.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!SameFile(data[k], data[i])) continue;
      throw BadInput(fmt::format(
          "{}: the same data as {}: evidence would count twice; give it once", data[i], data[k]));
    }
  }
  RefuseShared(data, holdout, "--holdout",
               "what was fitted cannot judge the fit. Hold out another record, or leave --holdout "
               "out: every sixth stretch is then validation data");
  RefuseShared(data, healthy, "--healthy",
               "it would vouch for itself. Give an earlier record of the healthy rig");
}

}  // namespace levitas::cli
