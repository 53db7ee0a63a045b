#pragma once
// A geared rotor's identification as files: JSON, full spectra as a picture.
//
// Failure   BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "identification/geared/full_spectrum.hpp"
#include "identification/geared/half_spectrum.hpp"

namespace levitas::cli {

[[nodiscard]] nlohmann::ordered_json GearedJson(const identification::GearedParameters& found);
/// Couplings and lines of the measured torsion.
[[nodiscard]] nlohmann::ordered_json TorsionJson(const identification::HalfSpectrum& half);
void WriteGearedPicture(const std::string& path,
                        const std::vector<identification::GearedLine>& lines,
                        const identification::HalfSpectrum& half = {});

}  // namespace levitas::cli
