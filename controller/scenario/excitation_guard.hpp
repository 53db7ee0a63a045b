#pragma once
// The last word on test signals, wherever they come from: what all of them together ask for is
// limited so that the law keeps something to catch the rotor with, and ends before the rotor can
// reach its touchdown bearings.
//
// Sum        in each bearing the injected current (x, y) is at most kShare of what the coils
//            leave the law, the injected shift at most kShiftShare of the clearance, and of both at
//            once the two shares that are used add up to 1 at most, since the law answers a shift
//            with current of its own; beyond it all are scaled alike, so that the direction stays.
// Radius     of each bearing now, |p|, and ahead, |p + T v|, with v the velocity through a
//            first-order filter of kVelocityS (noise of 1 um gives some 2 um ahead). T is kAheadS
//            while currents are injected, kShiftAheadS with shifts alone. Beyond kCutFraction of
//            the clearance every signal is cut off in that very cycle; below kQuietFraction they
//            come back with a time constant of kRecoveryS, or at once where none has been asked
//            for kQuietTimeS.
// Why        a test current of the whole limit makes the rotor faster than the law, which has then
//            nothing left, can stop it within the clearance. The share leaves it 40 % of the limit.
//            A shift leaves the law all of its current. The times ahead were chosen by trial on
//            the shipped rigs. Proven in pairs: tests/loop/lives.
// Beside it  the limit of the orbit that a step sets (orbit_limiter.hpp) acts on the step's own
//            signals, earlier and more gently.
// Told       what is taken away is counted, and its beginning is a notice: again only after
//            kQuietTimeS without.
// Frame      positions as read; a wrong polarity changes no radius. Units: SI.
// Thread     loop thread; TakeNotice: any one other. No allocation after construction, no throw. A
//            position that is no number cuts the signals off.
// Not done   what moves the rotor besides the test signals is not the guard's to stop.

#include <array>
#include <cstdint>
#include <string>

#include "common/axes.hpp"
#include "common/rig_numbers.hpp"
#include "common/spsc_ring.hpp"

namespace levitas::scenario {

/// Without axes nothing is limited.
struct GuardLimits {
  std::size_t axes{};
  double period_s{};
  double current_a{};       ///< what the coils leave the law in an axis
  AxisArray clearance_m{};  ///< per bearing
};
/// `law_limit_a`: the law's own limit, 0 where it has none.
[[nodiscard]] GuardLimits LimitsOf(const RigNumbers& rig, double law_limit_a) noexcept;

/// Why something was taken from the test signals.
enum class Reduced : std::uint8_t {
  kCurrentSum,  ///< [A]
  kShiftSum,    ///< [m]
  kRadius,      ///< [1] of the clearance, now or ahead
  kOrbitLimit,  ///< by the step's own limit; no numbers
};
inline constexpr std::size_t kReducedCount = 4;

struct GuardNotice {
  Reduced why{};
  std::size_t bearing{};
  double asked{};  ///< or how far the rotor was
  double allowed{};
};
/// One sentence for people.
[[nodiscard]] std::string Text(const GuardNotice& notice, const RigNumbers& rig);

/// What the guard took away.
struct GuardCounts {
  std::array<std::uint64_t, kReducedCount> cycles{};  ///< by Reduced
  double farthest{};  ///< largest radius, now or ahead, of the clearance, while signals were asked
};

class ExcitationGuard {
 public:
  static constexpr double kShare = 0.6;
  static constexpr double kShiftShare = 0.3;
  static constexpr double kAheadS = 2e-3;
  static constexpr double kShiftAheadS = 1e-3;
  static constexpr double kVelocityS = 0.5e-3;
  static constexpr double kCutFraction = 0.75;
  static constexpr double kQuietFraction = 0.5;
  static constexpr double kRecoveryS = 1.0;
  static constexpr double kQuietTimeS = 1.0;

  explicit ExcitationGuard(const GuardLimits& limits);

  /// Once per cycle, with the newest positions; reduces the two in place.
  void Limit(const AxisArray& position_m, AxisArray& excitation_a,
             AxisArray& excitation_m) noexcept;
  /// In this cycle a step's own limit has reduced its signals.
  void NoteOrbitLimit() noexcept { Note(Reduced::kOrbitLimit, {}); }

  [[nodiscard]] const GuardCounts& counts() const noexcept { return counts_; }
  bool TakeNotice(GuardNotice& notice) noexcept { return notices_.Take(notice); }

 private:
  struct Farthest {
    std::size_t bearing{};
    double share{};  ///< of the clearance
  };

  [[nodiscard]] Farthest Look(const AxisArray& position_m, double ahead_s) noexcept;
  [[nodiscard]] bool Lately(std::uint64_t cycle) const noexcept {
    return cycle != 0 && cycle_ - cycle <= quiet_cycles_;
  }
  void Follow(const AxisArray& position_m) noexcept;
  void LimitSum(std::size_t bearing, AxisArray& excitation_a, AxisArray& excitation_m) noexcept;
  void Note(Reduced why, const GuardNotice& notice) noexcept;

  GuardLimits limits_;
  double smooth_;
  double recover_;
  double gain_{1.0};
  bool any_{false};
  AxisArray last_m_{};
  AxisArray velocity_m_per_s_{};
  GuardCounts counts_;
  std::uint64_t cycle_{0};
  std::uint64_t quiet_cycles_;
  std::uint64_t asked_cycle_{0};    ///< the latest with a signal; 0: none yet
  std::uint64_t current_cycle_{0};  ///< the latest with a current
  std::array<std::uint64_t, kReducedCount> noted_cycle_{};  ///< the latest, plus 1
  SpscRing<GuardNotice> notices_{16};
};

}  // namespace levitas::scenario
