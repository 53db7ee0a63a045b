#include "cli/run/run_folder.hpp"

#include <fmt/core.h>
#include <stdlib.h>  // mkdtemp

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "common/problem.hpp"

namespace levitas::cli {

RunFolder::RunFolder() {
  std::error_code none;
  std::string pattern = (std::filesystem::temp_directory_path(none) / "amb-run-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw Problem(ExitStatus::kOther,
                  fmt::format("no temporary folder {}: {}; set TMPDIR to a folder that can be "
                              "written",
                              pattern, std::strerror(errno)));
  }
  path_ = pattern;
}

RunFolder::~RunFolder() {
  std::error_code none;
  if (!kept_) std::filesystem::remove_all(path_, none);
}

}  // namespace levitas::cli
