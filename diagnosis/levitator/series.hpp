#pragma once
// A record of a ball between two magnets on a voltage, as the models are driven with it.
//
// Rows       of one period each; where frames are missing the models start anew (`restart`).
// Counted    from the end of the lift-off on: three seconds, or a fifth of a shorter record.
// Sign       position x up, towards the upper magnet; `asked` is what the duty would drive at last.
// Thread     plain data. Failure: BadInput for rigs with other coils, and records without a second
//            of flight.

#include <array>
#include <string>
#include <vector>

#include "analysis/records/innovations.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::levitator {

struct Series {
  std::string name;
  std::vector<double> time_s;
  std::array<std::vector<double>, 2> asked_a;     ///< upper, lower
  std::array<std::vector<double>, 2> measured_a;  ///< as probed; empty without probes
  std::array<bool, 2> idle{};                     ///< never asked for anything
  std::vector<double> position_m;                 ///< as measured
  std::vector<bool> restart;                      ///< the row before is missing
  std::vector<bool> counts;

  [[nodiscard]] std::size_t size() const { return time_s.size(); }
  [[nodiscard]] bool has_currents() const { return !measured_a[0].empty(); }
};

/// One axis, two coils on a voltage, forces that fall exponentially with the gap.
[[nodiscard]] bool IsLevitator(const plant::PlantConfig& rig);

[[nodiscard]] Series MakeSeries(const std::string& name, const configuration::RigFile& rig,
                                const std::vector<analysis::RecordedRow>& rows);

/// A stretch of a record, its first half second to settle in; `phase` 0 to 1 says where it lies.
[[nodiscard]] Series Stretch(const Series& series, double seconds, double phase);

}  // namespace levitas::levitator
