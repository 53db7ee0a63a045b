#pragma once
// A geared rotor's identification as files: JSON, full spectra as a picture.
//
// Failure   BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "identification/geared/full_spectrum.hpp"
#include "identification/geared/half_spectrum.hpp"

namespace levitas::report {

[[nodiscard]] nlohmann::ordered_json GearedJson(const identification::GearedParameters& found);
/// Couplings and lines of the measured torsion.
[[nodiscard]] nlohmann::ordered_json TorsionJson(const identification::HalfSpectrum& half);
/// How well the probes of a shaft see its gear, for people; `shaft` begins the line.
[[nodiscard]] std::string ProbePlaneText(const std::string& shaft,
                                         const identification::ProbePlane& plane);
void WriteGearedPicture(const std::string& path,
                        const std::vector<identification::GearedLine>& lines,
                        const identification::HalfSpectrum& half = {});

}  // namespace levitas::report
