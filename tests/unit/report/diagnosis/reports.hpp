#pragma once
// Reports of a diagnosis, written by hand: what readers make of them needs no search.

#include <limits>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis::test {

inline NamedParameter ParameterAt(const char* place, double value = 120.0) {
  NamedParameter parameter;
  parameter.effect = "eddy_current";
  parameter.key = "tau_us";
  parameter.name = std::string("tau_us[") + place + "]";
  parameter.unit = "us";
  parameter.value = value;
  parameter.low = value - 10.0;
  parameter.high = value + 10.0;
  parameter.location.name = place;
  return parameter;
}

/// One cause on one axis, another effect that cannot be, validation data that show a gain.
inline DiagnosisReport OneCause() {
  DiagnosisReport report;
  report.rig_name = "test_rig";
  report.rig_channels = {"de_x", "de_y"};
  report.verdict = Verdict::kEffect;
  report.verdict_sentence = "Eddy currents on de_x.";
  report.headline = "Eddy currents slow the magnet at de_x [eddy_current].";
  report.severity_sentence = "Force falls off.";
  report.action = "Check the yoke.";
  report.causes = {{"eddy_current", "de_x"}};
  report.evidence_nat = 40.0;
  report.confidence = 0.98;
  report.parameters = {ParameterAt("de_x")};
  report.fitted = {.nominal_percent = 70.0,
                   .calibrated_percent = 75.0,
                   .extended_percent = 90.0,
                   .ceiling_percent = 91.0,
                   .achieved = {0.95, 0.9, 0.99},
                   .channels = {}};
  report.validation = report.fitted;
  report.validation.meaningful = true;
  report.validation.beyond_calibration = 0.8;
  report.validation.nominal_over_noise = 8.0;
  report.validation.calibrated_over_noise = 4.0;
  report.validation.extended_over_noise = 1.1;
  report.next_experiment = "record a run-up";
  ReportCandidate named{
      .effect = "eddy_current", .place = "de_x", .reason = "named", .validation_nat = {}};
  named.evidence_nat = 40.0;
  named.refitted = true;
  ReportCandidate impossible{
      .effect = "shaft_bow", .place = "rotor", .reason = "needs rotation", .validation_nat = {}};
  impossible.evidence_nat = -std::numeric_limits<double>::infinity();
  report.candidates = {named, impossible};
  report.seconds_of_data = report.seconds_used = 12.0;
  report.spectra = {.channel = "de_x",
                    .line_spacing_hz = 10.0,
                    .nominal = {1.0, 8.0, 4.0},
                    .calibrated = {1.0, 4.0, 2.0},
                    .extended = {1.0, 1.0, 1.0}};
  report.extended_rig = "name: extended\n";
  report.calibrated_rig = "name: calibrated\n";
  return report;
}

}  // namespace levitas::diagnosis::test
