#include "programs/controller/watchman.hpp"

#include <fmt/core.h>
#include <poll.h>

#include <chrono>
#include <thread>
#include <utility>

#include "common/rotational_speed.hpp"
#include "rt/clock.hpp"
#include "rt/say.hpp"
#include "rt/stop_signal.hpp"
#include "rt/thread_trouble.hpp"

namespace levitas::controller_program {

namespace {
constexpr auto kLookEvery = std::chrono::milliseconds(20);
}  // namespace

Watchman::Watchman(loop::ControlLoop& loop, loop::CommandArbiter& arbiter,
                   const ControllerOptions& options, const RigConnection& rig,
                   const gpio::GpiodLines* lines, std::function<void()> tell_news)
    : loop_(loop),
      arbiter_(arbiter),
      options_(options),
      rig_(rig),
      lines_(lines),
      tell_news_(std::move(tell_news)),
      partner_(rt::MonotonicNowNs(), static_cast<std::int64_t>(options.partner_timeout_s * 1e9)) {}

bool Watchman::Watch(const std::atomic<bool>& running) noexcept {
  while (running.load()) {
    std::this_thread::sleep_for(kLookEvery);
    if (running.load()) rt::Guarded("main", [this] { Look(); });
  }
  rt::Guarded("main", [this] { TellEnd(); });
  return stayed_;
}

void Watchman::Look() {
  LookAtGuard();
  LookAtParent();
  LookAtPartner();
  tell_news_();
  TellEnd();
  if (rt::QuitSignal()) {
    if (!landing_) arbiter_.RequestEmergencyStop();
    Land("emergency stop by SIGQUIT");
  }
  const int asked = rt::StopSignals();
  if (asked > 0) Land("landing, asked by a signal (the same signal again ends at once)");
  if (rt::Troubles() > 0) Land("landing, since a thread failed");
  if (!landing_) return;
  // Without a rig there is nothing to land; who asks again does not wait for it.
  if (asked > 1 || !partner_.present()) loop_.Abort();
}

void Watchman::Land(const char* why) {
  if (landing_) return;
  landing_ = true;
  arbiter_.RequestStop();
  rt::Say(fmt::format("amb-controller: {}", why));
}

void Watchman::LookAtGuard() {
  if (!guarded_ || lines_ == nullptr || lines_->guard_alive()) return;
  guarded_ = false;
  Land("the guard of the enable line has ended: landing");
}

void Watchman::LookAtParent() {
  if (orphaned_ || options_.life_line < 0) return;
  pollfd end{.fd = options_.life_line, .events = POLLIN, .revents = 0};
  if (::poll(&end, 1, 0) <= 0 || (end.revents & (POLLHUP | POLLERR | POLLNVAL)) == 0) return;
  orphaned_ = true;
  Land("the program that started this one has ended: landing");
}

void Watchman::TellEnd() {
  const loop::EndNews news = arbiter_.news();
  const double rpm = RadPerSToRpm(news.speed_rad_per_s);
  if (news.overdue && !overdue_said_) {
    overdue_said_ = true;
    rt::Say(
        fmt::format("amb-controller: the landing takes longer than its limit (speed over the "
                    "deceleration of the files, and {:.0f} s) at {:.0f} rpm, and the speed does "
                    "not fall: emergency stop; the rotor stays levitated while it turns (the same "
                    "signal again ends at once)",
                    loop::RunDown::kMarginS, rpm));
  }
  if (news.brake_fails && !brake_said_) {
    brake_said_ = true;
    rt::Say(
        fmt::format("amb-controller: released, and the brake does not slow the rotor down: its "
                    "speed of {:.0f} rpm falls by less than {:.0f} % of what the files' "
                    "deceleration gives. Ending; the drive is told to go on braking",
                    rpm, 100.0 * loop::RunDown::kBrakeShare));
  }
}

void Watchman::LookAtPartner() {
  if (!stayed_) return;
  using Word = transport::PartnerWatch::Say;
  const Word word = partner_.Check(rt::MonotonicNowNs(), loop_.frames_heard());
  if (word == Word::kFound) rt::Say("amb-controller: rig found");
  if (word == Word::kMissing) {
    const std::string remedy =
        rig_.virtual_rig()
            ? fmt::format("start {} with the same --rig, --port and --pace", rig_.SimulatedRig())
            : "is the rig powered, and does candump show its positions (0x110)?";
    rt::Say(fmt::format(
        "amb-controller: no sensor frames at {}; {} (giving up {} s after its last message)",
        rig_.Where(), remedy, options_.partner_timeout_s));
  }
  if (word != Word::kGiveUp) return;
  rt::Say(fmt::format("amb-controller: no rig for {} s, ending", options_.partner_timeout_s));
  loop_.Abort();
  stayed_ = false;
}

}  // namespace levitas::controller_program
