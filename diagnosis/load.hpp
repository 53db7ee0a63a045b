#pragma once
// Measured data for a diagnosis: sessions, or CSV (also .xz) or MAT files of docs/formats.md.
//
// CSV, MAT   go through session::ImportCsv or ImportMat into a scratch file in `scratch_folder`,
//            so that all ways see the same rows. Currents are the commanded ones.
// Failure    BadInput with file and line; for records of another rig or shorter than kShortest.

#include <string>
#include <vector>

#include "config/rig_file.hpp"
#include "diagnosis/model_run.hpp"

namespace levitas::diagnosis {

inline constexpr double kShortest = 1.0;  ///< [s]

[[nodiscard]] Record LoadRecord(const std::string& path, const config::RigFile& rig,
                                const std::string& scratch_folder);

/// Largest distance of the rotor from the centre in any record [m], at the sensors.
[[nodiscard]] double LargestOrbit(const std::vector<Record>& records, std::size_t axes);

}  // namespace levitas::diagnosis
