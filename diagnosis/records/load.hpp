#pragma once
// Measured data for a diagnosis: sessions, or CSV (also .xz) or MAT files of docs/formats.md.
//
// CSV, MAT   go through session::ImportCsv or ImportMat into a scratch file in `scratch_folder`,
//            so that all ways see the same rows. Currents are the commanded ones.
// Kind       by the name's ending; other files must be sessions, and are refused with the ways
//            there are when they are not.
// Failure    BadInput with file and line; for records of another rig or without flight.
// Thread     any, each with a scratch folder of its own.

#include <string>
#include <vector>

#include "config/rig_file.hpp"
#include "diagnosis/model/model_run.hpp"

namespace levitas::diagnosis {

inline constexpr double kShortest = 0.5;  ///< [s] of free flight: a model settles for 0.3

[[nodiscard]] Record LoadRecord(const std::string& path, const config::RigFile& rig,
                                const std::string& scratch_folder);

/// Largest distance of the rotor from the centre in any record [m], at the sensors.
[[nodiscard]] double LargestOrbit(const std::vector<Record>& records, std::size_t axes);

}  // namespace levitas::diagnosis
