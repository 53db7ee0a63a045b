#pragma once
// A modal identification from responses to files: JSON, pictures, the identified rig.
//
// Rig file  what the file can hold of the model: ki and ks (as force constant and gap) and sensor
//           gain per bearing (mean of its axes), delay, mean damping ratio of the bending modes.
//           The shaft and with it frequencies, deflections and gyroscopic matrix stay the file's.
// Failure   BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "config/rig_file.hpp"
#include "identification/modal/identify_modal.hpp"

namespace levitas::cli {

[[nodiscard]] nlohmann::ordered_json ModalJson(const identification::ModalResult& result);

/// <prefix>_bode.svg, _validation.svg, _campbell.svg, _stabilisation.svg; nothing without prefix.
void WriteModalPictures(const std::string& prefix, const identification::ModalResult& result,
                        const std::vector<identification::FrequencyResponse>& responses);

void WriteIdentifiedRig(const std::string& path, const config::RigFile& rig,
                        const identification::ModalResult& result);

}  // namespace levitas::cli
