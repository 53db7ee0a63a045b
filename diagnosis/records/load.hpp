#pragma once
// A recorded run of any format (session/exchange/recording.hpp) as the rows of a diagnosis.
//
// Currents   are the commanded ones.
// Failure    BadInput with file and line; for records of another rig or without flight.
// Thread     any.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "diagnosis/model/model_run.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::diagnosis {

inline constexpr double kShortest = 0.5;  ///< [s] of free flight: a model settles for 0.3

/// Rows, times and mean speed of a recording; its name is that of the file, without folder.
[[nodiscard]] Record RecordOf(session::Recording recording);

[[nodiscard]] Record LoadRecord(const std::string& path, const configuration::RigFile& rig);

/// Largest distance of the rotor from the centre in any record [m], at the sensors.
[[nodiscard]] double LargestOrbit(const std::vector<Record>& records, std::size_t axes);

}  // namespace levitas::diagnosis
