#include "benchmark/lives/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/rotational_speed.hpp"

namespace levitas::lives {
namespace {

constexpr std::int64_t kExcitedNs = 100'000'000;  // a test signal has an effect for so long
constexpr std::int64_t kFreeNs = 200'000'000;
constexpr std::int64_t kArrivesNs = 100'000'000;   // a new controller takes this to look about
constexpr std::int64_t kLastsNs = 200'000'000;     // what a cause may have an effect after its end
constexpr std::int64_t kSwingsNs = 100'000'000;    // the rotor is caught within so long
constexpr std::int64_t kBlindStallNs = 1'000'000;  // shorter ones must not make it touch
constexpr std::int64_t kWatchdogSlackPeriods = 2;  // counted from the last current that was taken

bool IsSensorFault(Fault fault) {
  return fault == Fault::kSensorOutOfRange || fault == Fault::kSensorFrozen ||
         fault == Fault::kSensorNotFinite;
}

bool During(std::int64_t now_ns, std::int64_t from_ns, std::int64_t to_ns, std::int64_t after_ns) {
  return now_ns >= from_ns && now_ns <= to_ns + after_ns;
}

// Duplicates and older messages among the new ones are no cause for anything.
bool TakesAway(const LineTrouble& trouble) {
  return trouble.lost > 0.0 || trouble.burst > 0 || trouble.delay_ns > 0 || trouble.jitter_ns > 0;
}

bool AnyNear(const std::vector<LineTrouble>& troubles, std::int64_t now_ns) {
  return std::any_of(troubles.begin(), troubles.end(), [now_ns](const LineTrouble& t) {
    return TakesAway(t) && During(now_ns, t.from_ns, t.to_ns, kLastsNs);
  });
}

bool Falsifies(Falsified what) {
  return what == Falsified::kPosition || what == Falsified::kPositionHeld;
}

}  // namespace

bool Judge::Stalled(std::int64_t shortest_ns, std::int64_t after_ns) const {
  return std::any_of(plan_.actions.begin(), plan_.actions.end(), [&](const Action& action) {
    return action.deed == Deed::kStall && action.duration_ns >= shortest_ns &&
           During(now_ns_, action.at_ns, action.at_ns + action.duration_ns, after_ns);
  });
}

bool Judge::Misread(std::int64_t after_ns) const {
  return std::any_of(plan_.falsehoods.begin(), plan_.falsehoods.end(), [&](const Falsehood& f) {
    return Falsifies(f.what) && During(now_ns_, f.from_ns, f.to_ns, after_ns);
  });
}

bool Judge::Did(Deed deed) const {
  return std::any_of(plan_.actions.begin(), plan_.actions.end(), [&](const Action& action) {
    return action.deed == deed && action.at_ns <= now_ns_;
  });
}

void Judge::Found(Harm harm, const std::string& how) {
  for (const HarmFound& known : result_.harms) {
    if (known.harm == harm) return;
  }
  result_.harms.push_back({harm, static_cast<double>(now_ns_) * 1e-9, speed_rpm_, how});
}

// The rig heard no new current for as long as its watchdog waits: what is only late must be later
// than that. (A controller without a frame sends what the rig has had already.)
bool Judge::CurrentsStayedAway() const {
  const std::int64_t waits_ns = (plan_.watchdog_periods - kWatchdogSlackPeriods) * period_ns_;
  const auto long_enough = [&](const LineTrouble& t) {
    if (!TakesAway(t) || !During(now_ns_, t.from_ns, t.to_ns, kLastsNs)) return false;
    return t.lost > 0.0 || t.burst > 0 || t.delay_ns + t.jitter_ns >= waits_ns;
  };
  return std::any_of(plan_.current_troubles.begin(), plan_.current_troubles.end(), long_enough) ||
         std::any_of(plan_.frame_troubles.begin(), plan_.frame_troubles.end(), long_enough) ||
         Stalled(waits_ns, kLastsNs);
}

bool Judge::Documented(const ControllerView& controller, bool by_the_rig) const {
  if (!controller.there || Did(Deed::kRestartRig) || Did(Deed::kKill)) return true;
  if (by_the_rig) return CurrentsStayedAway();
  const bool frames = AnyNear(plan_.frame_troubles, now_ns_);
  const bool currents = AnyNear(plan_.current_troubles, now_ns_);
  const bool stalled = Stalled(0, kLastsNs);
  const Fault cause = controller.released;
  if (cause == Fault::kSensorOutOfRange && (frames || currents || stalled)) return true;  // flung
  if (IsSensorFault(cause)) return Misread(kLastsNs);
  if (cause == Fault::kFrameMissing) return frames || stalled;
  if (cause == Fault::kAmplifierFault) return frames || currents || stalled;
  // A levitated stop is given up where the law does not get through to the rotor.
  if (cause == Fault::kOrbitExceeded) return frames || currents || stalled || Misread(kLastsNs);
  return false;
}

// What the law cannot prevent, docs/safety.md: it was not there, it was told a wrong position that
// looks like a right one, or the line fails on within a levitated stop.
bool Judge::ContactIsDocumented(const ControllerView& controller) const {
  if (Stalled(kBlindStallNs, kSwingsNs) || Misread(kSwingsNs)) return true;
  return controller.out.mode == Mode::kTripped &&
         (AnyNear(plan_.frame_troubles, now_ns_) || AnyNear(plan_.current_troubles, now_ns_));
}

void Judge::Released(const ControllerView& controller) {
  const bool by_the_rig = controller.there && controller.out.current.amplifiers_enabled;
  if (Documented(controller, by_the_rig)) {
    ++result_.releases;
    result_.released_rpm = std::max(result_.released_rpm, speed_rpm_);
    if (touch_periods_ > 0 && now_ns_ - touch_first_ns_ <= kContactNs) touch_periods_ = 0;
    return;
  }
  Found(Harm::kReleasedAtSpeed,
        fmt::format("{} in mode {}, first fault {}, then {}",
                    by_the_rig ? "by the rig's watchdog" : "by the controller",
                    Name(controller.out.mode), Name(controller.out.fault),
                    Name(controller.released)));
}

// Also what is documented has its measure: then the magnets have to let go.
void Judge::Touched(double contact_n, const ControllerView& controller) {
  if (ContactIsDocumented(controller)) {
    ++result_.documented_contacts;
    if (static_cast<std::int64_t>(++borne_periods_) * period_ns_ <= kContactNs) return;
  }
  if (touch_periods_++ == 0) {
    touch_first_ns_ = now_ns_;
    touch_rpm_ = speed_rpm_;
  }
  touch_most_n_ = std::max(touch_most_n_, contact_n);
}

void Judge::NoteSignals(double contact_n, const ControllerView& controller) {
  double most_a = 0.0;
  double most_m = 0.0;
  for (const double value : controller.asked.excitation_a)
    most_a = std::max(most_a, std::abs(value));
  for (const double value : controller.asked.excitation_m)
    most_m = std::max(most_m, std::abs(value));
  result_.most_excitation_a = std::max(result_.most_excitation_a, most_a);
  result_.most_excitation_m = std::max(result_.most_excitation_m, most_m);
  if (most_a > 0.0 || most_m > 0.0) excited_ns_ = now_ns_;
  if (contact_n > 0.0 && energised_ && now_ns_ - excited_ns_ < kExcitedNs && excited_ns_ > 0) {
    ++result_.excited_contacts;
  }
}

void Judge::Sampled(std::int64_t now_ns, const plant::Plant& plant, bool energised,
                    const ControllerView& controller) {
  now_ns_ = now_ns;
  speed_rpm_ = RadPerSToRpm(std::abs(plant.speed_rad_per_s()));
  result_.highest_rpm = std::max(result_.highest_rpm, speed_rpm_);
  const bool turning = std::abs(plant.speed_rad_per_s()) > turning_rad_per_s_;
  const double contact_n = plant.ContactForce();
  const Fault fault = controller.out.fault;
  if (result_.fault == Fault::kNone && controller.there) result_.fault = fault;
  if (turning && energised && contact_n > 0.0 && controller.there) {
    Touched(contact_n, controller);
  } else {
    borne_periods_ -= std::min<std::uint64_t>(borne_periods_, 1);
  }
  if (turning && energised_ && !energised) Released(controller);
  energised_ = energised;
  NoteSignals(contact_n, controller);
  if (turning && controller.there && energised && controller.out.mode == Mode::kLanding) {
    Found(Harm::kLandedAtSpeed, "the controller lowers the rotor");
  }
  const bool free = turning && !energised && controller.there &&
                    now_ns - controller.since_ns > kArrivesNs &&
                    !controller.out.current.drive_enabled;
  free_periods_ = free ? free_periods_ + 1 : 0;
  if (static_cast<std::int64_t>(free_periods_) * period_ns_ > kFreeNs) {
    Found(Harm::kNotBraked,
          fmt::format("mode {}, fault {}", Name(controller.out.mode), Name(fault)));
  }
}

void Judge::Ended(std::int64_t now_ns, const plant::Plant& plant) {
  now_ns_ = now_ns;
  speed_rpm_ = RadPerSToRpm(std::abs(plant.speed_rad_per_s()));
  if (std::abs(plant.speed_rad_per_s()) <= turning_rad_per_s_) return;
  Found(Harm::kLeftTurning, "the controller has ended");
}

void Judge::Finish() {
  result_.periods_touched = touch_periods_;
  if (touch_periods_ == 0) return;
  result_.harms.push_back({Harm::kTouchedUnderCurrent, static_cast<double>(touch_first_ns_) * 1e-9,
                           touch_rpm_,
                           fmt::format("{} periods, up to {:.0f} N, first fault {}", touch_periods_,
                                       touch_most_n_, Name(result_.fault))});
}

}  // namespace levitas::lives
