#include "cli/study/design/judged_law.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "cli/study/controller_output.hpp"
#include "cli/text_file.hpp"

namespace levitas::cli {
namespace {

/// OUT without its ending, with another.
std::string Beside(const std::string& path, const std::string& ending) {
  const std::filesystem::path given(path);
  return (given.parent_path() / (given.stem().string() + ending)).string();
}

}  // namespace

double ControlLimitA(const RigNumbers& rig) {
  return std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
}

std::vector<std::string> WriteJudged(const std::string& out_path, const std::string& command,
                                     std::uint64_t seed, const configuration::ControllerFile& file,
                                     const RigNumbers& rig, const design::GateResult& result) {
  if (out_path.empty()) return {};
  const std::string path = result.accepted ? out_path : Beside(out_path, ".rejected.yaml");
  const std::string head =
      result.accepted ? fmt::format("# {}: accepted by its check with seed {}\n", command, seed)
                      : fmt::format("# {}: NOT ACCEPTED: {}\n", command, result.reason);
  WriteControllerFile(path, head, file, rig);
  std::vector<std::string> written{path};
  if (!result.accepted && result.worst) {
    written.push_back(Beside(out_path, ".worst_rig.yaml"));
    WriteTextFile(written.back(), configuration::WriteRig(*result.worst));
  }
  return written;
}

}  // namespace levitas::cli
