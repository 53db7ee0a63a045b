#include "diagnosis/diagnose/diagnose_files.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/records/recorded_rows.hpp"
#include "common/each_in_parallel.hpp"
#include "common/problem.hpp"
#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/events.hpp"
#include "diagnosis/inference/forecast.hpp"
#include "diagnosis/inference/mains_lines.hpp"
#include "diagnosis/model/turns.hpp"
#include "diagnosis/record_errors/find.hpp"
#include "diagnosis/records/input_checks.hpp"
#include "diagnosis/records/levitated_interval.hpp"
#include "diagnosis/records/same_rows.hpp"

namespace levitas::diagnosis {
namespace {

std::vector<Record> Load(const std::vector<std::string>& paths, const DiagnosisRequest& inputs) {
  std::vector<Record> records(paths.size());
  EachThatMayFail(paths.size(), 0,
                  [&](std::size_t i) { records[i] = LoadRecord(paths[i], inputs.rig); });
  return records;
}

/// Takes the columns for what they are; adds the records that were not right to `found`.
void Mend(const RigView& rig, std::vector<Record>& records, std::vector<RecordErrors>& found) {
  std::vector<RecordErrors> errors = FindErrorsOfRecords(rig, records);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].times_s = {};
    if (errors[i].errors.empty()) continue;
    records[i] = Mended(rig, records[i], errors[i]);
    records[i].mean_speed_rad_per_s = analysis::MeanSpeed(records[i].rows);
    found.push_back(std::move(errors[i]));
  }
}

double Seconds(const Record& record, const RigView& rig) {
  return static_cast<double>(record.rows.size()) * rig.period_s;
}

/// Of geared shafts: angles that say where every wheel stands.
void FollowTurns(const RigView& rig, std::vector<Record>& records) {
  if (!rig.geared() || records.empty()) return;
  for (Record& record : records) Unwrap(record, rig.period_s);
  const Gains gains = Search(rig, {}).DesignGains(records, kFast);
  for (std::size_t i = 0; i < records.size(); ++i) ChooseTurn(rig, gains[i], records[i]);
}

double Fastest(const std::vector<Record>& records) {
  double fastest = 0.0;
  for (const Record& record : records) {
    for (const analysis::RecordedRow& row : record.rows) {
      fastest = std::max(fastest, std::abs(row.sample.speed_rad_per_s));
    }
  }
  return fastest;
}

/// To each law the speeds, in flight, of those of its records that are among `paths`.
void AddSpeeds(const std::vector<std::string>& paths, const std::vector<Record>& records,
               KnownLaws& known) {
  for (LawOfRecords& of : known.laws) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (std::find(of.records.begin(), of.records.end(), paths[i]) == of.records.end()) continue;
      for (const analysis::RecordedRow& row : records[i].rows) {
        if (row.levitated) of.Add(std::abs(row.sample.speed_rad_per_s));
      }
    }
  }
}

/// Speed range, duration and excitation of the records.
void Describe(const std::vector<Record>& records, const std::vector<Record>& holdout,
              DiagnosisResult& out) {
  out.fastest_rad_per_s = Fastest(records);
  out.separate_validation = !holdout.empty();
  out.validation_fastest_rad_per_s = Fastest(holdout);
  for (const Record& record : records) {
    out.seconds_of_data += Seconds(record, *out.view);
    for (const analysis::RecordedRow& row : record.rows) {
      out.excited = out.excited || std::any_of(row.excitation_a.begin(), row.excitation_a.end(),
                                               [](double value) { return value != 0.0; });
    }
  }
}

/// What was found instead of flight.
std::string NotLevitated(const RigView& rig, const Record& record) {
  double clearance_m = 0.0;
  double nearest_m = std::numeric_limits<double>::infinity();
  double farthest_m = 0.0;
  for (const analysis::RecordedRow& row : record.rows) {
    if (!row.levitated) continue;
    for (std::size_t a = 0; a + 1 < rig.axes; a += 2) {
      const double away_m = std::hypot(row.sample.position_m[a], row.sample.position_m[a + 1]);
      nearest_m = std::min(nearest_m, away_m);
      farthest_m = std::max(farthest_m, away_m);
      clearance_m = rig.bearing(a).touchdown.clearance_m;
    }
  }
  return fmt::format(
      "readings are {:.4g} to {:.4g} um off the centre, free is within {:.0f} % of the touchdown "
      "clearance of {:.4g} um, with the amplifiers on: was the rotor lifted, are the units and the "
      "rig file right?",
      1e6 * nearest_m, 1e6 * farthest_m, 100.0 * kFree, 1e6 * clearance_m);
}

/// The records without contact and the ways to and from it; refuses what is left too short.
std::vector<Record> CutToLevitated(const RigView& rig, std::vector<Record> records) {
  for (Record& record : records) {
    RefuseWrongUnits(rig, record);
    const double whole_s = Seconds(record, rig);
    const std::string found = NotLevitated(rig, record);
    LeaveOutContactAndWays(rig, record);
    if (Seconds(record, rig) >= kShortest) continue;
    throw BadInput(
        fmt::format("{}: {:.2f} s of free flight in {:.2f} s, a diagnosis needs {} s; {}",
                    record.name, Seconds(record, rig), whole_s, kShortest, found));
  }
  FollowTurns(rig, records);
  return records;
}

void Measure(const std::vector<Record>& fitted, const std::vector<Record>& holdout,
             const Judging& judging, DiagnosisResult& out) {
  const Search search(*out.view, out.terms);
  const Point nothing = PointAt(out.terms, std::vector<double>(out.terms.size(), 0.0));
  std::vector<double> noise_rms_m;
  for (const auto& channel : out.answer.residual.channels) {
    noise_rms_m.push_back(channel.noise_rms_m);
  }
  const auto run = [&](const std::vector<Record>& records) {
    const Gains gains = search.DesignGains(records, out.answer.speed);
    return ModelRuns{search.Run(records, gains, nothing),
                     search.Run(records, gains, out.answer.calibrated),
                     search.Run(records, gains, out.answer.extended)};
  };
  const ModelRuns runs = run(fitted);
  const Residual before = AnalyseResidual(*out.view, runs.nominal);
  out.shown_channel = before.worst_channel;
  out.ratio_before = before.channels[out.shown_channel].ratio;
  out.ratio_calibrated =
      AnalyseResidual(*out.view, runs.calibrated).channels[out.shown_channel].ratio;
  out.ratio_after = out.answer.residual.channels[out.shown_channel].ratio;
  out.line_spacing_hz = before.line_spacing_hz;
  out.fitted = MeasureGain(*out.view, runs, noise_rms_m, Part::kFitted);
  out.validation = holdout.empty()
                       ? MeasureGain(*out.view, runs, noise_rms_m, Part::kValidation)
                       : MeasureGain(*out.view, run(holdout), noise_rms_m, Part::kFitted);
  out.error_shares = ErrorShares(search, out.terms, out.answer, fitted, noise_rms_m);
  if (holdout.empty()) return;
  out.forecast = Foretell(search, out.terms, out.answer, runs.extended, holdout, judging);
}

}  // namespace

DiagnosisResult DiagnoseRecords(const configuration::RigFile& rig,
                                const std::vector<Record>& records,
                                const std::vector<Record>& holdout, const Settings& settings,
                                const std::vector<Record>& healthy) {
  DiagnosisResult out;
  out.view = std::make_shared<const RigView>(rig.numbers, rig.plant);
  const std::vector<Record> vouched_for = CutToLevitated(*out.view, healthy);
  const std::vector<Record> validation = CutToLevitated(*out.view, holdout);
  std::vector<Record> fitted = CutToLevitated(*out.view, records);
  out.terms = AllTerms(*out.view, rig.tolerances.value_or(configuration::Tolerances{}),
                       LargestOrbit(fitted, out.view->axes));
  if (!vouched_for.empty()) {
    for (const Term& term : out.terms) out.file_tolerance.push_back(term.tolerance);
    out.terms = LearnFromHealthy(*out.view, vouched_for, settings.judging, out.terms);
  }
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    fitted[i].number = static_cast<std::uint32_t>(i);
    fitted[i].keeps_validation = holdout.empty();
  }
  Describe(fitted, validation, out);
  out.lost_frames = CountFrames(*out.view, fitted);
  const auto mains = MainsTerms(*out.view, MainsLines(*out.view, fitted), fitted.size());
  out.terms.insert(out.terms.end(), mains.begin(), mains.end());
  out.answer = Diagnose(*out.view, fitted, validation, settings, out.terms);
  const std::vector<Record> used = settings.quick ? QuickSpans(fitted, out.view->period_s)
                                                  : Spans(fitted, kMostRows, out.view->period_s);
  for (const Record& record : used) out.seconds_used += Seconds(record, *out.view);
  Measure(used, validation, settings.judging, out);
  return out;
}

DiagnosisResult DiagnoseFiles(const DiagnosisRequest& inputs) {
  std::vector<Record> data = Load(inputs.data, inputs);
  std::vector<Record> holdout = Load(inputs.holdout, inputs);
  std::vector<Record> healthy = Load(inputs.healthy, inputs);
  RefuseSameRows(data, holdout, "--holdout", "what was fitted cannot judge the fit");
  RefuseSameRows(data, healthy, "--healthy", "it would vouch for itself");
  const RigView view(inputs.rig.numbers, inputs.rig.plant);
  std::vector<RecordErrors> found;
  if (!inputs.as_is) {
    for (std::vector<Record>* records : {&data, &holdout, &healthy}) Mend(view, *records, found);
  }
  KnownLaws laws = inputs.known_laws;
  AddSpeeds(inputs.data, data, laws);
  AddSpeeds(inputs.holdout, holdout, laws);
  try {
    DiagnosisResult out = DiagnoseRecords(inputs.rig, data, holdout, inputs.settings, healthy);
    out.record_errors = std::move(found);
    out.known_laws = std::move(laws);
    return out;
  } catch (const BadInput& refused) {
    if (found.empty()) throw;
    throw BadInput(
        fmt::format("{}\n{}", fmt::join(RecordErrorSentences(found), "\n"), refused.what()));
  }
}

}  // namespace levitas::diagnosis
