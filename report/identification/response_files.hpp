#pragma once
// Frequency responses as files: CSV for other tools, JSON, and the Bode picture with or without a
// model next to the data.
//
// Failure  BadInput when a file cannot be written.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "identification/frf/frequency_response.hpp"

namespace levitas::report {

using identification::FrequencyResponse;

/// One row per speed and line: plant, its standard deviation, coherence and sensitivity.
void WriteResponseCsv(const std::string& path, const std::vector<FrequencyResponse>& responses);

[[nodiscard]] nlohmann::ordered_json ResponseJson(const FrequencyResponse& response);

/// A model's plant on the lines of a response; empty = data only.
using ModelLines = std::vector<Eigen::MatrixXcd>;

/// Magnitude and phase of every pair of places, both planes in one panel, lines beyond their noise
/// only; with a model in place of the phase the residual in multiples of the noise.
void WriteBode(const std::string& path, const FrequencyResponse& response,
               const ModelLines& model = {});

}  // namespace levitas::report
