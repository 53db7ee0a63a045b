#include "cli/run/run_folder.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "common/problem.hpp"

namespace levitas::cli {

RunFolder::RunFolder() {
  const char* const told = std::getenv("TMPDIR");
  const std::filesystem::path parent = told != nullptr && *told != '\0' ? told : "/tmp";
  std::string pattern = (parent / "amb-run-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw Problem(ExitStatus::kOther,
                  fmt::format("no temporary folder in {}: {}; set TMPDIR to a folder that can be "
                              "written",
                              parent.string(), std::strerror(errno)));
  }
  path_ = pattern;
}

RunFolder::~RunFolder() {
  std::error_code none;
  if (!kept_) std::filesystem::remove_all(path_, none);
}

}  // namespace levitas::cli
