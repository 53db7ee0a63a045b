#pragma once
// Report of one diagnosis as plain data: the one result that writers read.
//
// Made by   BuildReport (build_report.hpp), once, from the result of a search.
// Units     of parameters and calibrated values those of the rig file's keys, named in `unit`;
//           fits in percent; evidence in nats; shares and confidence as fractions of 1.
// Frame     phases are relative to the key phasor, as in the rig file.
// Thread    any; plain values, no reference to the rig or to the records.
// Not done  no spectra and no rig files: they need the model (diagnose_files.hpp,
//           extended_rig.hpp).

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace levitas::diagnosis {

/// Defined in diagnosis/inference/diagnose.hpp.
enum class Verdict;

/// The rig file's own value of the same quantity, and its sum with the estimate.
struct OfFile {
  double nominal{}, total{};  ///< unit of the parameter
};

struct NamedParameter {
  std::string effect, name, unit;  ///< name: "tau_us[de_x]"
  double value{}, low{}, high{};
  std::string key, place;         ///< "tau_us", "de_x"
  bool form{};                    ///< the bracket is no interval but the distance to other forms
  double si{1.0};                 ///< of one unit
  std::optional<OfFile> of_file;  ///< where the parameter is an addition to the file's
};

struct CalibratedValue {
  std::string effect, place, key, unit;
  double nominal{};   ///< of the rig file
  double expected{};  ///< of earlier healthy records; else the nominal one
  double calibrated{};
  double deviation{};                                  ///< standard deviation that the data leave
  double tolerance{};                                  ///< standard deviation on a healthy rig
  std::optional<double> nominal_phase_rad, phase_rad;  ///< of a harmonic
  std::optional<double> expected_phase_rad;
  double moved{};      ///< from what was expected, in tolerances
  double proven{};     ///< the same in standard deviations
  double from_file{};  ///< from the nominal value, in tolerances of the rig file
  double learned{};    ///< of that, what healthy records have shown
};

/// A named cause.
struct ReportCause {
  std::string effect, place;
};

/// An effect at its best place.
struct ReportCandidate {
  std::string effect, place;
  double evidence_nat{};  ///< -infinity: the effect cannot be present
  bool refitted{};        ///< on the nonlinear model; else from the linear screen
};

/// One-step prediction on the same data by three models, and the fit that noise alone leaves.
struct ReportFit {
  double nominal_percent{}, calibrated_percent{}, extended_percent{}, ceiling_percent{};
};

/// A share with its 5 to 95 % interval.
struct ReportShare {
  double fraction{}, low{}, high{};
};

/// Share of the achievable gain on validation data (gain.hpp).
struct ReportGain {
  ReportShare achieved;
  double beyond_calibration{};  ///< share of the calibrated model's excess that the causes remove
  bool meaningful{};            ///< the nominal model leaves enough beyond the noise
  struct Channel {
    std::string name;
    ReportShare achieved;
  };
  std::vector<Channel> channels;
};

/// Residual after calibration and causes (residual.hpp).
struct ReportResidual {
  double frequency_hz{};
  double order{};  ///< of rotation; 0: not bound to it
  std::string coherent_with;
  std::string channel;  ///< the worst one
  double sigma{};       ///< excess of its worst band in standard deviations
  double explained{};   ///< share of the calibrated model's excess that the causes remove
};

/// Effects that these records cannot show (excitation_coverage.hpp).
struct ReportCoverage {
  std::string sentence;  ///< empty when every effect is observable
  std::vector<std::string> effects;
  std::string missing_records;
};

struct DiagnosisReport {
  Verdict verdict{};
  std::vector<ReportCause> causes;         ///< in the order of selection
  std::vector<std::string> also_possible;  ///< effects not separable from the first cause
  double confidence{};                     ///< probability that the verdict is right
  std::string place;                       ///< "magnet", "sensor" ...; empty for a healthy rig
  std::vector<std::string> channels;       ///< affected ones
  std::vector<NamedParameter> parameters;  ///< of the causes
  std::vector<CalibratedValue> calibrated;
  ReportFit fitted, validation;
  ReportGain gain;
  ReportResidual residual;
  ReportCoverage coverage;
  std::string input_warning;     ///< why units, signs or the rig file are to be doubted; or empty
  std::string healthy_sentence;  ///< changes by healthy records; empty without them
  std::string next_experiment;
  std::vector<ReportCandidate> candidates;  ///< best first
};

}  // namespace levitas::diagnosis
