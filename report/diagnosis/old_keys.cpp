#include "report/diagnosis/old_keys.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace levitas::report {
namespace {

void Add(nlohmann::ordered_json& json, const std::string& old_key, const std::string& key) {
  if (json.contains(key)) json[old_key] = json[key];
}

}  // namespace

void AddOldKeys(nlohmann::ordered_json& diagnosis) {
  if (diagnosis.contains("fit_percent")) {
    for (const std::string when : {"before", "calibrated", "after"}) {
      Add(diagnosis["fit_percent"], "holdout_" + when, "validation_" + when);
    }
  }
  if (diagnosis.contains("candidates")) {
    for (nlohmann::ordered_json& candidate : diagnosis["candidates"]) {
      Add(candidate, "held_out_nat", "validation_nat");
    }
  }
  Add(diagnosis, "runs_held_out", "runs_validation");
}

}  // namespace levitas::report
