#pragma once
// A whole diagnosis from files: load, search, measure the gain on data not used for it.
//
// Thread   blocks the caller, two threads inside. Failure: BadInput.

#include <string>
#include <vector>

#include "config/rig_file.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/gain.hpp"
#include "diagnosis/load.hpp"

namespace levitas::diagnosis {

struct SessionInputs {
  config::RigFile rig;
  std::vector<std::string> data, holdout;
  std::vector<std::string> healthy;  ///< earlier records of the same rig, known to be well
  std::string scratch_folder;
  Settings settings;
};

struct SessionAnswer {
  Answer answer;
  std::vector<Term> terms;  ///< refer to `view`
  std::shared_ptr<const RigView> view;
  Gain fitted, held_out;
  std::vector<double> ratio_before, ratio_after;  ///< spectra of the worst channel, over noise
  double line_spacing_hz{};
  std::size_t shown_channel{};
  double seconds_of_data{};
};

[[nodiscard]] SessionAnswer DiagnoseFiles(const SessionInputs& inputs);
/// The same on records that are in memory; empty `holdout` keeps back stretches of `records`
/// (model_run.hpp).
[[nodiscard]] SessionAnswer DiagnoseRecords(const config::RigFile& rig,
                                            const std::vector<Record>& records,
                                            const std::vector<Record>& holdout,
                                            const Settings& settings,
                                            const std::vector<Record>& healthy = {});

}  // namespace levitas::diagnosis
