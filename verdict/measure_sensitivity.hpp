#pragma once
// The sensitivity peaks of the loop that ran, measured from the test signals of its record, beside
// those computed from its files.
//
// Equation  S = U E^-1 (signals added to the current) or I + Y E^-1 (added to the reading) on the
//           lines of the test signals, one axis excited at a time, all levitated
//           (identification/frf/frequency_response.hpp); peak and zone as ISO 14839-3 asks for them
//           (identification/frf/measured_sensitivity.hpp). Computed: analysis/sensitivity.hpp at
//           the same speed, taken from the caller's sweep where that holds it within 1 rpm.
// Units     rad/s, Hz. Thread: any, offline.
// Failure   none: where the record does not carry a measurement, `why_not` says what it lacks.
// Not done  a measurement between the speeds at which test signals were given.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/sensitivity.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::session {
struct Recording;
}

namespace levitas::verdict {

struct MeasuredAxis {
  std::string channel;
  double peak{};                       ///< [1] max |S_ii|, fitted over neighbouring lines
  double sigma{};                      ///< [1] its standard deviation
  double line_peak{};                  ///< [1] the largest single line, noise included
  double frequency_hz{};               ///< of the peak
  std::optional<analysis::Zone> zone;  ///< empty: see `refused`
  std::string refused;                 ///< why the lines do not carry a grade
  double computed_peak{};              ///< [1] of the files, at this speed
  bool differs{};  ///< graded, the computed loop stable, and more than 20 % apart
};

struct MeasuredSpeed {
  double speed_rad_per_s{};
  std::vector<MeasuredAxis> axes;
};

struct MeasuredSensitivity {
  std::vector<MeasuredSpeed> speeds;  ///< ascending
  std::string why_not;                ///< one clause; empty when there are speeds
};

/// Of a record that holds test signals; `computed`: of this rig and law at some speeds.
[[nodiscard]] MeasuredSensitivity MeasureSensitivity(
    const session::Recording& record, const configuration::RigFile& rig, const law::LawConfig& law,
    std::span<const analysis::SensitivityResult> computed);

/// The axis' measured and graded peak at this speed (within 1 rpm); null without one.
[[nodiscard]] const MeasuredAxis* FindGraded(const MeasuredSensitivity& measured,
                                             const std::string& channel, double speed_rad_per_s);

}  // namespace levitas::verdict
