#pragma once
// What an export of a session holds: names of its columns, and the numbers of a row.
//
// Columns   time_s, rotor_angle_rad, speed_rpm, then per channel position [m], control current and
//           excitation [A], and an injection into the measured position [m] when the scenario asks
//           for one (docs/formats.md).
// Time      of the sample. In real time it starts at 0; when the rig restarts it runs on.
// Thread    one. Failure: none.

#include <cstdint>
#include <string>
#include <vector>

#include "controller/cycle/cycle_io.hpp"
#include "session/session_header.hpp"

namespace levitas::session {

class ExportRows {
 public:
  // Of the values behind the time.
  static constexpr std::size_t kAngle = 0;
  static constexpr std::size_t kSpeed = 1;

  explicit ExportRows(const SessionHeader& header);

  /// The time is the first.
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }

  /// The time [ns] of a record with a sensor frame; `values` becomes what stands behind it. Call in
  /// order.
  std::int64_t Next(const cycle::CycleRecord& record, std::vector<double>& values);

 private:
  std::int64_t TimeOf(const cycle::CycleInputs& in);

  std::vector<std::string> names_;
  std::size_t axes_;
  bool injects_position_;
  std::uint64_t period_ns_;
  bool from_zero_;
  bool started_{false};
  std::uint32_t rig_session_{};
  std::uint64_t cycle_{};
  std::uint64_t time_ns_{};
  std::uint64_t offset_ns_{};
};

}  // namespace levitas::session
