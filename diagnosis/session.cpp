#include "diagnosis/session.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "common/problem.hpp"
#include "diagnosis/calibrate.hpp"
#include "diagnosis/events.hpp"
#include "diagnosis/flight.hpp"
#include "diagnosis/mains_lines.hpp"
#include "diagnosis/turns.hpp"

namespace levitas::diagnosis {
namespace {

std::vector<Record> Load(const std::vector<std::string>& paths, const SessionInputs& inputs) {
  std::vector<Record> records;
  records.reserve(paths.size());
  for (const std::string& path : paths) {
    records.push_back(LoadRecord(path, inputs.rig, inputs.scratch_folder));
  }
  return records;
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

std::vector<Record> InFlight(const RigView& rig, std::vector<Record> records) {
  constexpr double kLeast = 0.5;  // [s] a model settles for 0.3
  for (Record& record : records) {
    LeaveOutContact(rig, record);
    if (Seconds(record, rig) >= kLeast) continue;
    throw BadInput(fmt::format(
        "{}: {:.2f} s of free flight (readings within {:.0f} % of the touchdown clearance, "
        "amplifiers on), a diagnosis needs at least {} s",
        record.name, Seconds(record, rig), 100.0 * kFree, kLeast));
  }
  FollowTurns(rig, records);
  return records;
}

void Measure(const std::vector<Record>& fitted, const std::vector<Record>& holdout,
             SessionAnswer& out) {
  const Search search(*out.view, out.terms);
  const std::vector<double> nothing(out.terms.size(), 0.0);
  std::vector<double> noise_rms_m;
  for (const auto& channel : out.answer.remainder.channels) {
    noise_rms_m.push_back(channel.noise_rms_m);
  }
  const auto run = [&](const std::vector<Record>& records) {
    const Gains gains = search.DesignGains(records, out.answer.speed);
    return ModelRuns{search.Run(records, gains, nothing),
                     search.Run(records, gains, out.answer.theta_calibrated),
                     search.Run(records, gains, out.answer.theta_extended)};
  };
  const ModelRuns runs = run(fitted);
  const Remainder before = Examine(*out.view, runs.nominal);
  out.shown_channel = before.worst_channel;
  out.ratio_before = before.channels[out.shown_channel].ratio;
  out.ratio_after = out.answer.remainder.channels[out.shown_channel].ratio;
  out.line_spacing_hz = before.line_spacing_hz;
  out.fitted = MeasureGain(*out.view, runs, noise_rms_m, Part::kFitted);
  out.held_out = holdout.empty() ? MeasureGain(*out.view, runs, noise_rms_m, Part::kKeptBack)
                                 : MeasureGain(*out.view, run(holdout), noise_rms_m, Part::kFitted);
}

}  // namespace

SessionAnswer DiagnoseRecords(const config::RigFile& rig, const std::vector<Record>& records,
                              const std::vector<Record>& holdout, const Settings& settings,
                              const std::vector<Record>& healthy) {
  SessionAnswer out;
  out.view = std::make_shared<const RigView>(rig.numbers, rig.plant);
  const std::vector<Record> flown = InFlight(*out.view, healthy);
  const std::vector<Record> aside = InFlight(*out.view, holdout);
  std::vector<Record> fitted = InFlight(*out.view, records);
  out.terms = AllTerms(*out.view, rig.tolerances.value_or(config::Tolerances{}),
                       LargestOrbit(fitted, out.view->axes));
  if (!flown.empty()) LearnFromHealthy(*out.view, flown, out.terms);
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    fitted[i].number = static_cast<std::uint32_t>(i);
    fitted[i].keep_back = holdout.empty();
    out.seconds_of_data += Seconds(fitted[i], *out.view);
  }
  const auto mains = MainsTerms(*out.view, MainsLines(*out.view, fitted), fitted.size());
  out.terms.insert(out.terms.end(), mains.begin(), mains.end());
  out.answer = Diagnose(*out.view, fitted, settings, out.terms);
  Measure(Spans(fitted, settings.quick ? kQuickRows : kMostRows), aside, out);
  return out;
}

SessionAnswer DiagnoseFiles(const SessionInputs& inputs) {
  return DiagnoseRecords(inputs.rig, Load(inputs.data, inputs), Load(inputs.holdout, inputs),
                         inputs.settings, Load(inputs.healthy, inputs));
}

}  // namespace levitas::diagnosis
