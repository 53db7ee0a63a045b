#include "cli/png_pictures.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "cli/run/child_process.hpp"
#include "common/problem.hpp"

namespace levitas::cli {
namespace fs = std::filesystem;

std::string FindSvgConverter() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / "rsvg-convert";
    if (::access(program.c_str(), X_OK) == 0) return program.string();
  }
  return {};
}

void WritePngs(const std::string& converter, const std::string& folder,
               const std::vector<std::string>& names) {
  constexpr std::chrono::minutes kLong{1};
  const fs::path log = fs::path(folder) / ".rsvg-convert.log";
  for (const std::string& name : names) {
    const std::string svg = (fs::path(folder) / (name + ".svg")).string();
    const std::string png = (fs::path(folder) / (name + ".png")).string();
    ChildProcess program(converter,
                         {"--zoom", "2", "--background-color", "white", "--output", png, "--", svg},
                         log.string());
    const auto ended = program.WaitFor(kLong);
    if (!ended || ended->signalled || ended->code != 0) {
      throw Problem(ExitStatus::kOther,
                    fmt::format("{}: {} {}\n{}", svg, converter,
                                ended ? ended->Text() : "did not end", program.LastWords(5)));
    }
  }
  std::error_code ignored;
  fs::remove(log, ignored);
}

}  // namespace levitas::cli
