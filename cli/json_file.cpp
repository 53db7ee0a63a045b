#include "cli/json_file.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>

#include "cli/options/analysis_options.hpp"
#include "cli/text_file.hpp"
#include "common/output_file.hpp"
#include "levitas_version.hpp"

namespace levitas::cli {
namespace {

/// One command runs in a program.
std::string& Command() {
  static std::string name;
  return name;
}

nlohmann::ordered_json WithOrigin(const nlohmann::ordered_json& content) {
  if (!content.is_object()) return content;
  nlohmann::ordered_json whole{{"schema", fmt::format("levitas_{}_1", Command())},
                               {"version", LEVITAS_VERSION}};
  whole.update(content);
  return whole;
}

/// Not by the name /dev/stdout, which would cut a file that the shell appends to.
void WriteToStandardOutput(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t wrote = ::write(STDOUT_FILENO, text.data() + done, text.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    pollfd wait{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
    if (wrote < 0 && errno == EAGAIN && ::poll(&wait, 1, -1) > 0) continue;  // a pipe's other end
    if (wrote < 0 && errno == EPIPE) return;  // its reader has what it wanted
    if (wrote <= 0) CannotWrite("standard output", wrote < 0 ? errno : ENOSPC);
    done += static_cast<std::size_t>(wrote);
  }
}

}  // namespace

void NameJson(const std::string& command) { Command() = command; }

void WriteJsonFile(const std::string& path, const nlohmann::ordered_json& content) {
  if (path.empty()) return;
  const std::string text = WithOrigin(content).dump(2) + '\n';
  if (path == kJsonToStandardOutput) {
    WriteToStandardOutput(text);
  } else {
    WriteTextFile(path, text, Earlier::kReplaced);  // programs write it again and again
  }
}

nlohmann::ordered_json LoopJson(const RigNumbers& rig, const FoundController& controller,
                                double delay_s) {
  return {{"rig", rig.name},
          {"controller", controller.file.name},
          {"controller_file", controller.path},
          {"delay_s", delay_s}};
}

}  // namespace levitas::cli
