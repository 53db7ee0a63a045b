#pragma once
// A modal identification from responses to files: JSON, pictures; any identified rig as its file.
//
// Failure   BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "identification/modal/decibel_fit.hpp"

namespace levitas::report {

[[nodiscard]] nlohmann::ordered_json ModalJson(const identification::ModalResult& result);
[[nodiscard]] nlohmann::ordered_json DecibelJson(const identification::ModalResult& result,
                                                 const identification::DecibelFit& fit);

/// <prefix>_bode.svg, _validation.svg, _campbell.svg, _stabilisation.svg; nothing without prefix.
/// The names of the files.
std::vector<std::string> WriteModalPictures(
    const std::string& prefix, const identification::ModalResult& result,
    const std::vector<identification::FrequencyResponse>& responses);

void WriteRigFile(const std::string& path, const configuration::RigFile& rig);

}  // namespace levitas::report
