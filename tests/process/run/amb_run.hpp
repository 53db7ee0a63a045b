#pragma once
// Starts the real `amb run` with the real programs beside it, in a folder of its own.

#include <signal.h>
#include <stdlib.h>  // setenv

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/run/child_process.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/waiting.hpp"

namespace levitas::cli {

/// Lift, a moment of levitation, a little speed, land: about 3 s of the rig's time.
inline constexpr const char* kShortScenario = R"(kind: scenario
name: short
steps:
  - {do: lift, until: levitating, timeout_s: 5, hold_s: 0.7}
  - {do: spin, speed_rpm: 300, acceleration_rpm_per_s: 1000, until: speed_reached, timeout_s: 3}
  - {do: spin, speed_rpm: 0, acceleration_rpm_per_s: 1000, until: standstill, timeout_s: 3}
  - {do: land, until: off, timeout_s: 5}
)";

inline std::string ReadAll(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class AmbRun {
 public:
  /// Temporary files of the run go to `scratch`, too.
  AmbRun(const test::ScratchFolder& scratch, const std::string& name,
         std::vector<std::string> arguments)
      : log_(scratch / (name + ".log")) {
    const char* const before = getenv("TMPDIR");
    const std::string kept = before == nullptr ? "" : before;
    setenv("TMPDIR", (scratch / "").c_str(), 1);
    arguments.insert(arguments.begin(), "run");
    child_.emplace(levitas::test::ProgramFolder() + "/amb", arguments, log_);
    if (before == nullptr) {
      unsetenv("TMPDIR");
    } else {
      setenv("TMPDIR", kept.c_str(), 1);
    }
  }

  /// Exit status; -1 when it did not end in time, 1000 + signal when a signal ended it.
  int Status() {
    const auto ended = child_->WaitFor(test::kLimit);
    if (!ended) return -1;
    return ended->signalled ? 1000 + ended->code : ended->code;
  }
  [[nodiscard]] std::string Said() const { return ReadAll(log_); }
  void Signal(int signal) { child_->Signal(signal); }

  /// Waits until the run has said `text`; false when it ended without.
  bool Await(const std::string& text) {
    bool ended = false;
    bool said = false;
    return test::Eventually([&] {
             ended = child_->Poll().has_value();
             said = Said().find(text) != std::string::npos;
             return said || ended;
           }) &&
           said;
  }

  /// Process number of the run's child of that name; 0 when there is none.
  [[nodiscard]] pid_t ChildNamed(const std::string& name) const {
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::ifstream status(entry.path() / "status");
      std::string key;
      std::string program;
      pid_t parent = 0;
      std::string line;
      while (std::getline(status, line)) {
        std::istringstream words(line);
        words >> key;
        if (key == "Name:") words >> program;
        if (key == "PPid:") words >> parent;
      }
      // The kernel keeps 15 characters of a name.
      if (parent == child_->pid() && program == name.substr(0, 15)) {
        return std::stoi(entry.path().filename());
      }
    }
    return 0;
  }

 private:
  std::string log_;
  std::optional<ChildProcess> child_;
};

}  // namespace levitas::cli
