#pragma once
// Synchronous amplitudes of a recorded run: what of every axis and of every control current turns
// with the rotor, at speeds that the record holds and over all speeds that it passes.
//
// Equation  s(n) = m + sum_k (a_k cos k theta + b_k sin k theta)     over whole turns,
//           least squares; theta is the recorded angle of the bearing's own shaft, k the orders
//           asked for, all fitted at once. The amplitude of order k is hypot(a_k, b_k): peak, not
//           rms. Standing still only m is left.
// Rows      levitated and without a test signal: what an excitation moves is no answer to rotation.
// Held      speeds that differ by at most 0.2 % or 0.25 rad/s for 0.2 s or longer; of the longest
//           such stretch the last second counts. A speed that is only passed is taken from the
//           nearest window of turn_windows.hpp, when its mean is within 2 %.
// Radius    largest distance of a bearing's reading from the centre of its clearance in the rows
//           taken; of a bearing with one axis the largest |x|.
// Absent    an order beyond half the sampling rate is no number (NaN).
// Frame     bearing frame; units SI. Thread any; offline.
// Failure   std::invalid_argument when an order is not above zero.

#include <optional>
#include <vector>

#include "session/exchange/recording.hpp"

namespace levitas::analysis {

struct SynchronousRequest {
  std::vector<double> orders{1.0};
  double standstill_rad_per_s{1.0};  ///< slower counts as standing
  std::vector<double> shaft_ratio;   ///< per bearing, with its sign; empty: one rotor
  std::size_t axes_per_bearing{2};   ///< one on rigs with a single axis
};

struct OrderAmplitudes {
  double mean{};
  std::vector<double> amplitude;  ///< one per order; standing still: none
};

struct SynchronousRows {
  session::RowRange rows;
  double speed_rad_per_s{};                 ///< mean, without its sign
  double turns{};                           ///< of the first shaft
  bool held{};                              ///< else passed
  std::vector<OrderAmplitudes> position_m;  ///< per axis
  std::vector<OrderAmplitudes> current_a;   ///< per axis
  std::vector<double> largest_radius_m;     ///< per bearing
};

class SynchronousAnalysis {
 public:
  SynchronousAnalysis(const session::Recording& recording, SynchronousRequest request);

  /// Speeds that the record holds, ascending; 0 where it stands.
  [[nodiscard]] const std::vector<double>& HeldSpeeds() const noexcept { return held_rad_per_s_; }
  /// Nothing when the record neither holds nor passes that speed.
  [[nodiscard]] std::optional<SynchronousRows> At(double speed_rad_per_s) const;
  /// Windows of at least four turns and 0.1 s, in the order of the record.
  [[nodiscard]] std::vector<SynchronousRows> OverSpeed() const;

  [[nodiscard]] bool Standing(double speed_rad_per_s) const noexcept {
    return speed_rad_per_s <= request_.standstill_rad_per_s;
  }

 private:
  struct Stretch {
    session::RowRange rows;
    double speed_rad_per_s{};
  };
  struct Quiet;  ///< columns of rotation, levitated and unexcited

  [[nodiscard]] Quiet QuietRows() const;
  [[nodiscard]] double MeanSpeed(const session::RowRange& rows) const;
  void FindHeld();
  [[nodiscard]] SynchronousRows Fit(const session::RowRange& rows) const;
  [[nodiscard]] session::RowRange LastWholeTurns(const session::RowRange& rows) const;
  [[nodiscard]] std::optional<session::RowRange> Passed(double speed_rad_per_s) const;
  void FitBearing(std::size_t bearing, SynchronousRows& made) const;

  const session::Recording& recording_;
  SynchronousRequest request_;
  std::vector<std::uint8_t> levitated_;  ///< and without a test signal
  std::vector<session::RowRange> windows_;
  std::vector<Stretch> held_;
  std::vector<double> held_rad_per_s_;
};

}  // namespace levitas::analysis
