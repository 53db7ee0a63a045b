#pragma once
// Listens to the buses of the loop beside it and measures the delay of the path, while it runs.
//
// Path     sockets of its own: what the loop sends comes to them through the driver's loop-back.
//          The loop does not know of it.
// Judged   once, after kEnough frames: a delay that differs from the one that margins and verdict
//          are computed with by more than kTolerance periods is news. The median has the width of a
//          bin of the histogram, 4.4 %.
// Thread   its own, at normal priority, which looks every 5 ms, at a bounded number of frames.
// Failure  sockets that cannot be made are said once; nothing is measured then.

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "hil/can/bus_access.hpp"
#include "hil/can_port/delay_meter.hpp"
#include "hil/socketcan/can_connection.hpp"

namespace levitas::controller_program {

class DelayWatch {
 public:
  static constexpr std::uint64_t kEnough = 10'000;
  static constexpr double kTolerance = 0.25;

  /// `expected_periods`: of the rig as margins and verdict take it.
  DelayWatch(const socketcan::CanConnection& plan, double expected_periods);
  ~DelayWatch();
  DelayWatch(const DelayWatch&) = delete;
  DelayWatch& operator=(const DelayWatch&) = delete;

  [[nodiscard]] const can_port::DelayMeter& meter() const noexcept { return meter_; }
  [[nodiscard]] double expected_periods() const noexcept { return expected_periods_; }
  /// What people should hear, once. Main thread.
  [[nodiscard]] std::string TakeNews();

 private:
  void Listen() noexcept;

  can_port::DelayMeter meter_;
  double expected_periods_;
  std::string news_;
  bool judged_{false};
  std::unique_ptr<can::BusAccess> access_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// What the measurement says against the delay that was computed with; empty when they agree.
[[nodiscard]] std::string DelayObjection(const can_port::DelayFigures& acting,
                                         double expected_periods);

}  // namespace levitas::controller_program
