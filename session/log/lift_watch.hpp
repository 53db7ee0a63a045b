#pragma once
// What a lift came to before it was given up, so that a trip can name the reason.
//
// Means    exponential, time constant kLiftMemoryS: place and control current of every axis and the
//          share of cycles in which it was limited, over the records of mode lift with a new frame.
// Sag      distance of the mean place of a bearing from the centre, where the lift ends. Probes
//          and amplifiers turned round change signs only, and a distance has none.
// Reason   at the limit: the magnets give all they have, to one side. From limit to limit: the
//          loop is unstable, and no load. Sag beyond the settle radius: the law
//          holds the load too softly, or has not integrated long enough. Else it swings.
//          Of an axis that was at its limit until a protection tripped, only the first two.
// Ended    by levitation: a later trip has reasons of its own.
// Units    SI. Thread: the recorder's, or any reader's. Failure: none.
// Not done the lift itself, which is the supervisor's (controller/supervisor).

#include <array>
#include <cstddef>

#include "common/axes.hpp"
#include "controller/cycle/cycle_io.hpp"

namespace levitas::session {

inline constexpr double kLiftMemoryS = 0.1;  ///< [s] several periods of a rigid mode

enum class LiftReason { kUnknown, kAtLimit, kLimitToLimit, kSags, kSwings };

class LiftWatch {
 public:
  explicit LiftWatch(double period_s) noexcept;

  /// Call once per record, in order.
  void Add(const cycle::CycleRecord& record) noexcept;
  /// Why the bearing of this axis did not settle within `settle_radius_m`.
  [[nodiscard]] LiftReason ReasonOf(std::size_t axis, double settle_radius_m) const noexcept;
  /// Why the current of this axis stayed at its limit; kUnknown but in a lift.
  [[nodiscard]] LiftReason ReasonOfLimit(std::size_t axis) const noexcept;
  [[nodiscard]] double SagOf(std::size_t axis) const noexcept;    ///< [m] of the axis' bearing
  [[nodiscard]] double StartOf(std::size_t axis) const noexcept;  ///< [m] the same, where it lay
  /// [A] magnitude of the mean control current of the axis.
  [[nodiscard]] double CurrentOf(std::size_t axis) const noexcept;

 private:
  AxisArray start_m_{}, place_m_{}, current_a_{};
  /// Of cycles with the current at its limit: their share, and how many more on one side.
  std::array<double, kMaxAxes> limited_share_{}, limited_side_{};
  double weight_{};  ///< [1] of a new record
  bool filled_{false};
};

}  // namespace levitas::session
