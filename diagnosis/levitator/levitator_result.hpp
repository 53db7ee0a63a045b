#pragma once
// A whole diagnosis of a levitator: records in, cause, extended rig and fits per run out.
//
// Fitting    on four seconds of every record, spread over them, at most; fits are given for whole
//            records.
// Validation the records given as such. Without any, each record in turn: parameters of the same
//            causes are fitted to the others and judged on it, with nothing of its own; a lone
//            record is fitted on its first two thirds and judged on the last.
// Healthy    records of the same rig in good condition. Errors of the file that they show are no
//            cause; the search starts from the model that explains them (origin.hpp).
// Report     the same plain data as for a rotor (build_report.hpp).
// Thread     blocks the caller, every processor inside. Failure: BadInput.

#include <string>
#include <vector>

#include "diagnosis/diagnose/diagnose_files.hpp"
#include "diagnosis/levitator/run_fit.hpp"
#include "diagnosis/levitator/search.hpp"
#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::levitator {

/// The models on one record that was not used to fit them.
struct ValidationRun {
  std::string name;
  RunFit nominal, calibrated, extended;
  double current_ceiling{}, motion_ceiling{};
  Fit achieved;  ///< percent of the achievable gain, nominal to extended
  Fit beyond_calibration;
};

struct LevitatorResult {
  Found found;
  std::vector<ValidationRun> fitted, validation;
  diagnosis::DiagnosisReport report;
};

[[nodiscard]] LevitatorResult Diagnose(const diagnosis::DiagnosisRequest& inputs);
/// The same on records in memory.
[[nodiscard]] LevitatorResult Diagnose(const configuration::RigFile& rig,
                                       const std::vector<Series>& data,
                                       const std::vector<Series>& validation,
                                       const diagnosis::Settings& settings,
                                       const std::vector<Series>& healthy = {});

/// The rig file with the causes of a fit, made relative to `origin`, and nothing else that was
/// fitted; values in the file's keys and its list of effects.
[[nodiscard]] std::string ExtendedRig(const configuration::RigFile& file, const Theta& origin,
                                      const Found& found);
/// The rig file as it was judged: with the causes, the calibrated values and what healthy records
/// have shown.
[[nodiscard]] std::string CalibratedRig(const configuration::RigFile& file, const Theta& origin,
                                        const Found& found);

}  // namespace levitas::levitator
