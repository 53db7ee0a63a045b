#pragma once
// The measured torsion of a session as columns in memory.
//
// Rows      one per sampling instant, in the order of the record; `rig_session` and `cycle` name
//           the sensor frame of the same instant. Instants whose batch was lost are missing.
// Signs     torsion_batch.hpp. Units SI.
// Thread    any.
// Failure   BadInput: no session, or its rig cannot be read. Without gauges: no couplings, no rows.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "session/log/session_header.hpp"

namespace levitas::session {

struct TorsionRecording {
  std::vector<std::string> couplings;  ///< "motor to pinion"
  std::vector<std::uint32_t> rig_session;
  std::vector<std::uint64_t> cycle;
  std::vector<std::vector<double>> torque_n_m;  ///< per coupling
  std::vector<std::vector<double>> twist_rad;   ///< per coupling

  [[nodiscard]] std::size_t rows() const noexcept { return cycle.size(); }
  /// The row of an instant; none when its batch was lost.
  [[nodiscard]] std::optional<std::size_t> RowOf(std::uint32_t of_session,
                                                 std::uint64_t of_cycle) const noexcept;
};

/// Names of the couplings that a session's rig measures; empty for a rig without gauges.
[[nodiscard]] std::vector<std::string> GaugedCouplings(const SessionHeader& header);

[[nodiscard]] TorsionRecording LoadTorsion(const std::string& path);

}  // namespace levitas::session
