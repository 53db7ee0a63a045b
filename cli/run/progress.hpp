#pragma once
// The progress of a run for people: one line redrawn on a terminal; everywhere else, where it ends
// in a file, one line per change of mode with what the mode before it has seen.
//
// Figures   mode, speed, largest orbit radius per bearing since the previous line (at the sensors,
//           from decimated telemetry: the verdict, not this line, is exact), the rig's time, and
//           how fast it passes.
// Thread    one. Failure: none.

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/enums.hpp"

namespace levitas::cli {

struct ProgressSample {
  std::uint64_t cycle{};
  Mode mode{};
  double speed_rad_per_s{};
  std::vector<double> position_m;  ///< bearing frame, two axes per bearing
};

class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  using Out = std::function<void(const std::string&)>;

  /// `out` takes what is to be written, as it is.
  Progress(std::vector<std::string> bearings, double period_s, Out out, bool terminal);
  void Show(const ProgressSample& sample, Clock::time_point now = Clock::now());
  /// Ends a redrawn line, so that what follows starts on a line of its own.
  void Close();

 private:
  [[nodiscard]] std::string Orbits() const;
  [[nodiscard]] std::string Time(const ProgressSample& sample) const;
  void Redraw(const ProgressSample& sample);
  void Tell(const ProgressSample& sample) const;
  void Forget();
  void Measure(const ProgressSample& sample, Clock::time_point now);

  std::vector<std::string> bearings_;
  double period_s_;
  Out out_;
  bool terminal_;
  bool drawn_{false};
  bool started_{false};
  Mode mode_{Mode::kOff};
  std::vector<double> largest_m_;
  double top_rpm_{0.0};
  std::uint64_t rate_cycle_{0};
  Clock::time_point rate_time_;
  Clock::time_point drawn_time_;
  double times_real_time_{0.0};
};

}  // namespace levitas::cli
