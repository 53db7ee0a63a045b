#include "verdict/timing.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/problem.hpp"

namespace levitas::verdict {

std::optional<TimingFigures> ReadControllerReport(const std::string& path) {
  if (path.empty() || !std::filesystem::exists(path)) return std::nullopt;
  return std::nullopt;
}

}  // namespace levitas::verdict
