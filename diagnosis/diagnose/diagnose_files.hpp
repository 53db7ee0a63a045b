#pragma once
// A whole diagnosis from files: load, search, measure the gain on data not used for it.
//
// Thread   blocks the caller, every processor inside. Failure: BadInput.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "diagnosis/diagnose/known_laws.hpp"
#include "diagnosis/inference/diagnose.hpp"
#include "diagnosis/inference/error_shares.hpp"
#include "diagnosis/inference/events.hpp"
#include "diagnosis/inference/forecast_interval.hpp"
#include "diagnosis/inference/gain.hpp"
#include "diagnosis/record_errors/record_error.hpp"
#include "diagnosis/records/load.hpp"

namespace levitas::diagnosis {

struct DiagnosisRequest {
  configuration::RigFile rig;
  std::vector<std::string> data, holdout;
  std::vector<std::string> healthy;  ///< earlier records of the same rig, known to be well
  Settings settings;
  KnownLaws known_laws;  ///< of `data` and `holdout`, whose paths they name
  bool as_is{};          ///< no errors of records are looked for
};

struct DiagnosisResult {
  SearchResult answer;
  std::vector<Term> terms;             ///< that were searched; refer to `view`
  std::vector<double> file_tolerance;  ///< per term, before healthy records; empty without them
  std::shared_ptr<const RigView> view;
  Gain fitted, validation;
  std::vector<ErrorShare> error_shares;  ///< of the rig file's error on the fitted data
  std::optional<Forecast> forecast;      ///< of the user's validation data
  /// Spectra of the worst channel, over noise.
  std::vector<double> ratio_before, ratio_calibrated, ratio_after;
  double line_spacing_hz{};
  std::size_t shown_channel{};
  LostFrames lost_frames;                 ///< of the fitted records
  double seconds_of_data{};               ///< in flight
  double seconds_used{};                  ///< of them, by a search that takes spans
  double fastest_rad_per_s{};             ///< of the rotor, in flight
  bool excited{};                         ///< a recorded test signal is in the records
  bool separate_validation{};             ///< the held-out data are records of their own
  double validation_fastest_rad_per_s{};  ///< in those
  std::vector<RecordErrors>
      record_errors;     ///< of files; what could be mended was, before the search
  KnownLaws known_laws;  ///< with the speeds of their records
};

/// Looks for errors of the records first (record_errors/find.hpp), but for `as_is`; a refusal for
/// another reason names them.
[[nodiscard]] DiagnosisResult DiagnoseFiles(const DiagnosisRequest& inputs);
/// The same on records that are in memory; empty `holdout` keeps back stretches of `records`
/// (model_run.hpp).
[[nodiscard]] DiagnosisResult DiagnoseRecords(const configuration::RigFile& rig,
                                              const std::vector<Record>& records,
                                              const std::vector<Record>& holdout,
                                              const Settings& settings,
                                              const std::vector<Record>& healthy = {});

}  // namespace levitas::diagnosis
