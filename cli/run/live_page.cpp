#include "cli/run/live_page.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "common/problem.hpp"
#include "dashboard/dashboard.hpp"

namespace levitas::cli {
namespace {

bool IsSet(const char* variable) {
  const char* value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return value != nullptr && *value != '\0';
}

/// Hands the address to the desktop. The shell ends at once; the browser is nobody's child.
bool OpenBrowser(std::string url) {
  std::string shell = "sh";
  std::string option = "-c";
  std::string script = R"(command -v xdg-open >/dev/null || exit 1
setsid xdg-open "$1" >/dev/null 2>&1 </dev/null &)";
  const std::array<char*, 6> arguments{shell.data(), option.data(), script.data(),
                                       shell.data(), url.data(),    nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, "sh", nullptr, nullptr, arguments.data(), environ) != 0) return false;
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

PagePlan PlanPage(PageWish wish, const PageSurroundings& around) noexcept {
  if (wish == PageWish::kNever) return {};
  const bool watched = around.terminal && !around.automation;
  if (wish == PageWish::kIfUseful && !(watched && around.realtime)) return {};
  return {true, watched && around.desktop};
}

PageSurroundings LookAround(bool realtime) {
  return {isatty(STDOUT_FILENO) == 1 && isatty(STDERR_FILENO) == 1,
          IsSet("DISPLAY") || IsSet("WAYLAND_DISPLAY"), IsSet("CI"), realtime};
}

LivePage::LivePage(const PagePlan& plan, const transport::LcmNetwork& network,
                   const std::function<void(const std::string&)>& say) {
  if (!plan.serve) return;
  try {
    page_ = std::make_unique<dashboard::Dashboard>(network, dashboard::WebOptions{});
  } catch (const Problem& problem) {
    say(std::string("no live page: ") + problem.what());
    return;
  }
  const bool opened = plan.open && OpenBrowser(page_->Url());
  say("live page: " + page_->Url() + (opened ? "   (opened in the browser)" : ""));
}

LivePage::~LivePage() = default;

}  // namespace levitas::cli
