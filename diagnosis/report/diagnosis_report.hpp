#pragma once
// Report of one diagnosis as plain data: the one result that the terminal, diagnosis.json, the
// page, the rig files, the next scenario and the benchmark read.
//
// Made by   BuildReport of diagnosis/report for a rotor and of diagnosis/levitator for a ball
//           between two magnets, once, from the result of a search.
// Units     of parameters and calibrated values those of the rig file's keys, named in `unit`;
//           fits in percent; evidence in nats; shares and confidence as fractions of 1.
// Effects   by name, as files and people have them; each comes from an id of the catalogue.
// Frame     phases are relative to the key phasor, as in the rig file.
// Thread    any; plain values, no reference to the rig or to the records.
// Not done  no layout: sentences and rig files are text, tables and pictures are made by readers.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/inference/verdict.hpp"
#include "diagnosis/model/location.hpp"
#include "diagnosis/record_errors/record_error.hpp"
#include "plant_sim/effect/workshop.hpp"

namespace levitas::diagnosis {

/// The rig file's own value of the same quantity, and its sum with the estimate.
struct OfFile {
  double nominal{}, total{};  ///< unit of the parameter
};

struct NamedParameter {
  std::string effect, name, unit;  ///< name: "tau_us[de_x]"
  double value{}, low{}, high{};
  std::string key;  ///< "tau_us"
  Location location;
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
  double evidence_nat{};                 ///< -infinity: the effect cannot be present
  bool refitted{};                       ///< on the nonlinear model; else from the linear screen
  std::string reason;                    ///< why the effect is not the answer; "named" for a cause
  std::optional<double> validation_nat;  ///< gain in likelihood on records that were not fitted
};

/// A share with its 5 to 95 % interval.
struct ReportShare {
  double fraction{}, low{}, high{};
};

/// One-step prediction on the same data by three models, and the fit that noise alone leaves
/// (gain.hpp).
struct ReportFit {
  double nominal_percent{}, calibrated_percent{}, extended_percent{}, ceiling_percent{};
  double nominal_over_noise{}, calibrated_over_noise{}, extended_over_noise{};  ///< squared
  ReportShare achieved;            ///< of the achievable gain, nominal to extended
  double beyond_calibration{};     ///< share of the calibrated model's excess that causes remove
  bool meaningful{};               ///< the nominal model leaves enough beyond the noise
  bool calibration_is_complete{};  ///< the calibrated model leaves next to nothing beyond the noise
  struct Channel {
    std::string name;
    double nominal_percent{}, extended_percent{};
    ReportShare achieved;
  };
  std::vector<Channel> channels;
};

/// A quantity of a forecast: where 90 of 100 rigs lie that the fitted data cannot tell from this
/// one, and what was measured.
struct ReportForeseen {
  double low{}, high{}, measured{};
  bool covered{};
};

/// Forecast of validation records (forecast_interval.hpp).
struct ReportForecast {
  ReportForeseen fit_percent, residual_um;
  double better_than_file{};  ///< chance that it is, before the records are seen
  struct Band {
    double from_rpm{}, to_rpm{};
    ReportForeseen fit_percent, residual_um;
  };
  std::vector<Band> by_speed;
};

/// Share of the rig file's error on the fitted data (error_shares.hpp).
struct ReportErrorShare {
  std::string effect;  ///< empty: shapes of the modes
  std::string place;   ///< of a cause; empty for the calibrated numbers of an effect
  double fraction{};
};

/// Residual after calibration and causes (residual.hpp).
struct ReportResidual {
  double frequency_hz{};
  double order{};  ///< of rotation; 0: not bound to it
  std::string coherent_with{"nothing"};
  std::string channel;  ///< the worst one
  double sigma{};       ///< excess of its worst band in standard deviations
  double explained{};   ///< share of the calibrated model's excess that the causes remove
};

/// Power of the residuals over the sensors' noise in one channel, line by line.
struct ReportSpectra {
  std::string channel;
  double line_spacing_hz{};
  std::vector<double> nominal, calibrated, extended;
};

/// Effects that these records cannot show (excitation_coverage.hpp).
struct ReportCoverage {
  bool turns{true}, excited{true};
  std::string sentence;  ///< empty when every effect is observable
  std::vector<std::string> effects;
  std::string missing_records;
};

/// Effects that the data cannot separate from one cause.
struct ReportTie {
  std::string cause;
  std::vector<std::string> others;
};

/// Three models on one quantity of one record.
struct ReportRunFit {
  struct Percent {
    double value{}, low{}, high{};
  };
  Percent nominal, calibrated, extended;
  double ceiling_percent{};
};

/// The fits of one record where a diagnosis judges records one by one.
struct ReportRun {
  std::string name;
  std::optional<ReportRunFit> current, lower_current;  ///< of the coils, where measured
  ReportRunFit motion;
};

/// A closed loop of a rig and a law over a range of speeds.
struct ReportLoop {
  std::optional<bool> levitates{};  ///< none: not judged
  double rpm{};                     ///< where it is worst, when it does not
  std::string why{};                ///< not, or not judged
};

/// Of one law of the records: whether the rig as given and the two that are written levitate.
struct ReportLevitation {
  std::string law;  ///< and where it is from
  double from_rpm{}, to_rpm{};
  ReportLoop rig_file{}, extended_rig{}, calibrated_rig{};
};

/// levitation.hpp
struct ReportLevitations {
  std::vector<ReportLevitation> by_law;
  std::vector<std::string> records_without_law;
  std::vector<std::string> sentences;  ///< of what does not levitate or was not judged
};

/// What severity is judged by; 0 where it is not known.
struct ReportScale {
  double rotor_mass_kg{}, rated_speed_rad_per_s{}, clearance_m{};
};

/// The rotor to draw; z along the shaft from the drive end. Empty for geared shafts and a ball.
struct ReportRotor {
  struct Piece {
    double from_m{}, to_m{}, outer_m{}, inner_m{};  ///< diameters
    bool disc{};                                    ///< on the shaft, its width not known
  };
  struct Bearing {
    std::string name;
    double magnet_z_m{}, sensor_z_m{};
  };
  std::vector<Piece> pieces;
  std::vector<Bearing> bearings;
};

/// A place on the drawn rotor that a cause names.
struct ReportMark {
  double z_m{};
  std::string text;
};

/// When and of which files; what is empty is not said.
struct ReportOrigin {
  std::string date_utc, program_version, rig_file;
  std::vector<std::string> records, validation, healthy;
  bool quick{};
};

enum class Severity { kNotSaid, kSlight, kMarked, kSevere };

struct DiagnosisReport {
  std::string rig_name;
  std::vector<std::string> rig_channels;
  Verdict verdict{};
  std::string verdict_sentence;
  std::string headline;           ///< the verdict in words of the workshop (advice.hpp)
  std::string certainty;          ///< "nearly certain"
  Severity severity{};            ///< of the first cause
  std::string severity_sentence;  ///< what it does to the machine, and how severe that is
  std::string action;             ///< whether to stop, what to check
  bool undecided{};               ///< verdict none, with a candidate that may well be there
  /// Of numbers that are off under verdict none: what healthy records would show.
  std::string healthy_proposal;
  std::string healthy_record;       ///< the last accepted session of the rig, where one was found
  std::vector<ReportCause> causes;  ///< in the order of selection
  std::vector<std::string> also_possible;  ///< effects not separable from the first cause
  std::vector<ReportTie> ties;             ///< of every cause, where the search decides them all
  double evidence_nat{};                   ///< of all causes together
  double confidence{};                     ///< probability that the verdict is right
  std::string place;                       ///< "magnet", "sensor" ...; empty for a healthy rig
  std::vector<std::string> channels;       ///< affected ones
  std::vector<NamedParameter> parameters;  ///< of the causes
  std::vector<CalibratedValue> calibrated;
  std::vector<std::string> taken_by_causes;  ///< values not calibrated because a cause has them
  ReportFit fitted, validation;
  std::vector<ReportErrorShare> error_shares;  ///< the largest first
  std::optional<ReportForecast> forecast;      ///< of validation records that were given
  bool separate_validation{};                  ///< on records that were given for it
  bool validation_is_faster{};  ///< the rotor turns faster in them than in the fitted ones
  std::vector<ReportRun> validation_runs, fitted_runs;
  ReportResidual residual;
  ReportSpectra spectra;
  ReportCoverage coverage;
  double seconds_of_data{};                    ///< in flight
  double seconds_used{};                       ///< of them, by a search that takes spans
  bool stopped{};                              ///< the search was ended before its end
  Doubt doubt{};                               ///< of a suspected cause
  double probability{};                        ///< that it is there
  std::string suspected_because;               ///< the doubt in a sentence; else empty
  std::vector<std::string> outside_tolerance;  ///< calibrated numbers beyond kOutside tolerances
  /// Mended before the search where columns can mend them.
  std::vector<RecordErrors> record_errors;
  std::string input_warning;     ///< why units, signs or the rig file are to be doubted; or empty
  std::string healthy_sentence;  ///< changes by healthy records; empty without them
  bool changed_since_healthy{};  ///< a value is far from that of the healthy records
  bool needs_experiment{};       ///< a further record would decide something
  std::string next_experiment;
  std::vector<ReportCandidate> candidates;  ///< best first
  /// Words in place of the catalogue's, where those speak of a rotor and this is none.
  std::vector<effect::Words> own_words;
  ReportScale scale;
  ReportRotor rotor;
  std::vector<ReportMark> marks;
  ReportOrigin origin;
  std::string extended_rig, calibrated_rig;  ///< text of the rig files; empty where not asked for
  ReportLevitations levitation;              ///< of those two
};

}  // namespace levitas::diagnosis
