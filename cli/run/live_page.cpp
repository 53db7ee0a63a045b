#include "cli/run/live_page.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "cli/run/interrupt.hpp"
#include "dashboard/dashboard.hpp"
#include "rt/say.hpp"

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

std::string EndOf(ExitStatus status) {
  switch (status) {
    case ExitStatus::kDone:
      return "The run has ended.";
    case ExitStatus::kTripped:
      return "The run has ended with a trip.";
    default:
      return "The run has ended; its terminal says what is wrong.";
  }
}

}  // namespace

PagePlan PlanPage(PageWish wish, const PageSurroundings& around) noexcept {
  if (wish == PageWish::kNever) return {};
  const bool watched = around.terminal && !around.automation;
  if (wish == PageWish::kIfUseful && !(watched && around.clocked)) return {};
  return {true, watched && around.desktop};
}

PageSurroundings LookAround(bool clocked) {
  return {isatty(STDOUT_FILENO) == 1 && isatty(STDERR_FILENO) == 1,
          IsSet("DISPLAY") || IsSet("WAYLAND_DISPLAY"), IsSet("CI"), clocked};
}

LivePage::LivePage(const PagePlan& plan, const transport::LcmNetwork& network,
                   const std::function<void(const std::string&)>& say)
    : say_(say) {
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

ExitStatus LivePage::Outlive(const std::function<ExitStatus(Ending&)>& run) {
  Ending ending;
  if (!page_) return run(ending);
  ending.over = [this](ExitStatus status) {
    page_->RunEnded(EndOf(status) + " It is being judged.");
  };
  ExitStatus status = ExitStatus::kDone;
  try {
    status = run(ending);
  } catch (const Problem& problem) {
    if (ending.interrupted) throw;
    say_(std::string("amb: ") + problem.what());
    status = problem.status();
  }
  if (ending.interrupted) return status;
  page_->RunEnded(EndOf(status) + (ending.verdict.empty() ? "" : " " + ending.verdict + "."));
  const InterruptGuard interrupts;
  say_("live page stays at " + page_->Url() + ": Ctrl-C ends it");
  static_cast<void>(rt::FlushSaid());
  interrupts.Await();
  return status;
}

}  // namespace levitas::cli
