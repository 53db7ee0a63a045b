#pragma once
// How a rotor runs down that is to be landed, or that lies on its touchdown bearings: whether it
// still slows down, and whether its brake does anything. Whether it stands the supervisor says.
//
// Window    a fall of the speed is looked for from one edge of a window to the next; it is missed
//           when two windows in a row are without it, since one wrong frame spoils at most two
//           edges of which one shows a fall.
// Overdue   t > |v0| / a + landing ramp + kMarginS since Begin, with the speed v0 then and the rate
//           a of the files, and a fall by a standstill speed is missed in windows of
//           kMarginS / 2 + 2 v_standstill / a. While the speed falls a landing is never overdue.
// Brake     fails when a fall by kBrakeShare of what the rate gives is missed in windows of
//           max(kBrakeS, 2 v_standstill / a). A rotor without a brake loses less by windage and
//           friction; a drive ten times weaker than its file counts as one.
// Units     SI; times in cycles. A speed that is not finite does not fall.
// Thread    loop thread; no allocation. Failure: none.

#include <cstdint>

namespace levitas::loop {

struct RunDownLimits {
  double period_s{};
  double deceleration_rad_per_s2{};  ///< of the files; 0: unknown, no time follows from the speed
  double standstill_rad_per_s{};
  double landing_ramp_s{};
};

class RunDown {
 public:
  static constexpr double kMarginS = 10.0;
  static constexpr double kBrakeS = 1.0;
  static constexpr double kBrakeShare = 0.1;

  explicit RunDown(const RunDownLimits& limits) noexcept;

  /// Once per cycle, with the speed of the newest frame and whether the rotor is known to stand.
  void Look(std::uint64_t cycle, double speed_rad_per_s, bool standing) noexcept;
  /// The landing was asked for in this cycle, or the magnets let go.
  void Begin(std::uint64_t cycle) noexcept;

  [[nodiscard]] bool standing() const noexcept { return standing_; }
  [[nodiscard]] bool Overdue(std::uint64_t cycle) const noexcept;
  /// Since Begin.
  [[nodiscard]] bool brake_fails() const noexcept { return brake_.missed >= kMissed; }
  /// Magnitude, of the newest frame.
  [[nodiscard]] double speed_rad_per_s() const noexcept { return speed_rad_per_s_; }

 private:
  static constexpr int kMissed = 2;
  struct Windows {
    std::uint64_t cycles{1};
    double fall_rad_per_s{};  ///< wanted from edge to edge
    std::uint64_t since{0};
    double from_rad_per_s{};
    int missed{0};  ///< in a row
  };

  [[nodiscard]] std::uint64_t Cycles(double seconds) const noexcept;
  void Step(Windows& windows, std::uint64_t cycle) const noexcept;
  void Start(Windows& windows, std::uint64_t cycle) const noexcept;

  RunDownLimits limits_;
  double speed_rad_per_s_{};
  bool standing_{false};
  std::uint64_t begin_{0};
  std::uint64_t limit_cycles_{0};
  Windows fall_, brake_;
};

}  // namespace levitas::loop
