#include "cli/run/supervise.hpp"

#include <fmt/core.h>

#include <csignal>
#include <exception>
#include <fstream>
#include <memory>
#include <thread>

#include "rt/stop_signal.hpp"

namespace levitas::cli {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kPoll{50};
constexpr milliseconds kSecondSignal{rt::kAgainNs / 1'000'000 + 100};
constexpr std::size_t kLastWords = 12;
constexpr int kListens = 20;  // one second of turns that hear nothing

/// "running", "sleeping", "stopped" ...: what the kernel says a process is doing.
std::string StateOf(pid_t pid) {
  std::ifstream status(fmt::format("/proc/{}/status", pid));
  std::string line;
  while (std::getline(status, line)) {
    const auto open = line.find('(');
    if (!line.starts_with("State:") || open == std::string::npos) continue;
    return line.substr(open + 1, line.find(')') - open - 1);
  }
  return "gone";
}

std::string Said(const ChildProcess& child) {
  const std::string words = child.LastWords(kLastWords);
  return words.empty() ? "" : fmt::format("\n{} said:\n{}", child.name(), words);
}

class Run {
 public:
  Run(const RunPlan& plan, const RunHooks& hooks)
      : plan_(plan),
        hooks_(hooks),
        plant_(Started(plan.plant)),
        controller_(plan.controller.program, plan.controller.arguments, plan.controller.log_file,
                    plan.controller.life_line),
        last_progress_(Clock::now()) {}

  RunResult UntilTheEnd() {
    while (!controller_.Poll() && result_.trouble.empty()) {
      if (blind_.empty()) {
        Followed([this] { FollowTelemetry(kPoll); });
      } else {
        std::this_thread::sleep_for(kPoll);
      }
      HeedInterrupts();
      WatchPlant();
      WatchProgress();
    }
    if (blind_.empty()) Followed([this] { FollowTelemetry(milliseconds(0)); });  // the last mode
    Finish();
    return result_;
  }

 private:
  static std::unique_ptr<ChildProcess> Started(const ProgramCall& call) {
    if (call.program.empty()) return nullptr;
    return std::make_unique<ChildProcess>(call.program, call.arguments, call.log_file);
  }

  /// What happens in `look` is no reason to leave a turning rotor alone.
  template <class Look>
  void Followed(const Look& look) {
    try {
      look();
    } catch (const std::exception& error) {
      GoBlind(fmt::format("the run could not be followed any further: {}", error.what()));
    }
  }

  void GoBlind(const std::string& why) {
    blind_ = why;
    hooks_.say(why + "; landing the rotor (Ctrl-C twice ends at once)");
    // A stopped process hears nothing before it goes on.
    controller_.Signal(SIGCONT);
    if (plant_) plant_->Signal(SIGCONT);
    AskToLand();
  }

  /// Once: for the controller a second request would mean "at once, whatever the rotor does".
  void AskToLand() {
    if (!asked_to_land_) controller_.Signal(SIGINT);
    asked_to_land_ = true;
  }

  void FollowTelemetry(milliseconds limit) {
    const auto sample = hooks_.telemetry(limit);
    if (!sample) return;
    if (sample->cycle != last_cycle_) {
      last_progress_ = Clock::now();
      listened_ = 0;
    }
    last_cycle_ = sample->cycle;
    hooks_.progress(*sample);
  }

  void HeedInterrupts() {
    const int count = hooks_.interrupts();
    if (count == 0) return;
    if (!result_.interrupted) {
      result_.interrupted = true;
      if (blind_.empty()) hooks_.say("landing the rotor (Ctrl-C again ends at once)");
      AskToLand();
    } else if (count > 1) {
      result_.trouble = "ended at once on request: the rotor was not landed";
      EndControllerAtOnce();
    }
  }

  /// Its second signal of the kind counts from half a second after the first.
  void EndControllerAtOnce() {
    controller_.Signal(SIGINT);
    if (controller_.WaitFor(kSecondSignal)) return;
    controller_.Signal(SIGINT);
    if (!controller_.WaitFor(plan_.grace)) controller_.Signal(SIGKILL);
  }

  /// A rig that ended orderly does so at the goodbye of a controller that is about to end, too.
  void WatchPlant() {
    const auto ended = plant_ ? plant_->Poll() : std::nullopt;
    if (!ended) return;
    if (controller_.WaitFor(plan_.notice)) return;
    result_.trouble =
        fmt::format("{} {} while {} went on", plant_->name(), ended->Text(), controller_.name());
  }

  void WatchProgress() {
    if (!blind_.empty()) {
      if (controller_.Silent() < plan_.hung_limit) return;
      result_.trouble = fmt::format("{} hangs: no thread of it has run for {} s, it is {}; ended",
                                    controller_.name(), plan_.hung_limit.count() / 1000,
                                    StateOf(controller_.pid()));
      return;
    }
    if (Clock::now() - last_progress_ < plan_.silence_limit) return;
    // Not by the clock alone: where this program itself stood still, what it missed lies before it.
    if (++listened_ < kListens) return;
    std::string why =
        fmt::format("no telemetry for {} s: {} is {}", plan_.silence_limit.count() / 1000,
                    controller_.name(), StateOf(controller_.pid()));
    if (plant_) why += fmt::format(", {} is {}", plant_->name(), StateOf(plant_->pid()));
    GoBlind(why);
  }

  void Finish() {
    const bool by_itself = controller_.Poll().has_value();
    result_.controller = by_itself ? *controller_.Poll() : controller_.End(plan_.grace);
    if (plant_) result_.plant = plant_->WaitFor(plan_.notice);
    if (plant_ && !result_.plant) plant_->End(plan_.grace);
    if (!blind_.empty()) {
      result_.trouble = fmt::format("{}; {}", blind_,
                                    result_.trouble.empty()
                                        ? fmt::format("{} was asked to land the rotor, and {}",
                                                      controller_.name(), result_.controller.Text())
                                        : result_.trouble);
    }
    if (!result_.trouble.empty()) {
      result_.trouble += (plant_ ? Said(*plant_) : "") + Said(controller_);
      return;
    }
    const bool plant_failed =
        result_.plant && (result_.plant->signalled || result_.plant->code != 0);
    const bool orderly = !result_.controller.signalled &&
                         (result_.controller.code == 0 || result_.controller.code == 4);
    if (plant_failed) {
      result_.trouble =
          fmt::format("{} {}{}", plant_->name(), result_.plant->Text(), Said(*plant_));
    }
    if (!orderly) {
      result_.trouble += fmt::format("{}{} {}{}", plant_failed ? "\n" : "", controller_.name(),
                                     result_.controller.Text(), Said(controller_));
    }
  }

  const RunPlan& plan_;
  const RunHooks& hooks_;
  std::unique_ptr<ChildProcess> plant_;  ///< null: a rig is there already
  ChildProcess controller_;
  RunResult result_;
  std::string blind_;  ///< why the run is not followed any more; empty: it is
  bool asked_to_land_{false};
  std::uint64_t last_cycle_{0};
  Clock::time_point last_progress_;
  int listened_{};  ///< turns since, after the limit of silence
};

}  // namespace

RunResult Supervise(const RunPlan& plan, const RunHooks& hooks) {
  return Run(plan, hooks).UntilTheEnd();
}

}  // namespace levitas::cli
