#pragma once
// Statistics of the programs as JSON, for --json.

#include <nlohmann/json.hpp>
#include <string>

#include "common/histogram.hpp"

namespace levitas::transport {

/// {"count", "p50_ns", "p99_ns", "p999_ns", "max_ns"}
[[nodiscard]] inline nlohmann::ordered_json HistogramJson(const Histogram& histogram) {
  return {{"count", histogram.count()},
          {"p50_ns", histogram.Percentile(0.5)},
          {"p99_ns", histogram.Percentile(0.99)},
          {"p999_ns", histogram.Percentile(0.999)},
          {"max_ns", histogram.max_ns()}};
}

/// Behind `schema` ("levitas_<kind>_1") and `version`, as every JSON file of the commands begins.
/// Throws Problem (exit status 1) when the file cannot be written.
void WriteJson(const std::string& kind, const nlohmann::ordered_json& value,
               const std::string& path);

}  // namespace levitas::transport
