#include "diagnosis/session.hpp"

#include <algorithm>

#include "diagnosis/events.hpp"
#include "diagnosis/search.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kKeptBack = 0.15;

std::vector<Record> Load(const std::vector<std::string>& paths, const SessionInputs& inputs) {
  std::vector<Record> records;
  records.reserve(paths.size());
  for (const std::string& path : paths) {
    records.push_back(LoadRecord(path, inputs.rig, inputs.scratch_folder));
  }
  return records;
}

void Measure(const std::vector<Record>& fitted, const std::vector<Record>& kept_back,
             const Settings& settings, SessionAnswer& out) {
  const Search search(*out.view, out.terms, settings);
  const std::vector<double> nothing(out.terms.size(), 0.0);
  std::vector<double> noise_rms_m;
  for (const auto& channel : out.answer.remainder.channels) {
    noise_rms_m.push_back(channel.noise_rms_m);
  }
  const auto measure = [&](const std::vector<Record>& records, bool show) {
    const Gains gains = search.DesignGains(records, kSlow);
    const auto nominal = search.Run(records, gains, nothing);
    const auto calibrated = search.Run(records, gains, out.answer.theta_calibrated);
    const auto extended = search.Run(records, gains, out.answer.theta_extended);
    if (show) {
      const Remainder before = Examine(*out.view, nominal);
      out.shown_channel = before.worst_channel;
      out.ratio_before = before.channels[out.shown_channel].ratio;
      out.ratio_after = out.answer.remainder.channels[out.shown_channel].ratio;
      out.line_spacing_hz = before.line_spacing_hz;
    }
    return MeasureGain(*out.view, nominal, calibrated, extended, noise_rms_m);
  };
  out.fitted = measure(settings.quick ? Tails(fitted, 16'000) : fitted, true);
  out.held_out = measure(kept_back, false);
}

}  // namespace

SessionAnswer DiagnoseRecords(const config::RigFile& rig, const std::vector<Record>& records,
                              const std::vector<Record>& holdout, const Settings& settings) {
  SessionAnswer out;
  out.view = std::make_shared<const RigView>(rig.numbers, rig.plant);
  out.terms = AllTerms(*out.view, settings.tolerances, LargestOrbit(records, out.view->axes));
  Split split{records, holdout};
  if (holdout.empty()) split = KeepBack(records, kKeptBack);
  for (const Record& record : records) {
    out.seconds_of_data += static_cast<double>(record.rows.size()) * out.view->period_s;
  }
  for (std::size_t i = 0; i < split.fitted.size(); ++i) {
    split.fitted[i].number = static_cast<std::uint32_t>(i);
    if (holdout.empty()) split.kept_back[i].number = static_cast<std::uint32_t>(i);
  }
  const auto mains =
      MainsTerms(*out.view, MainsLines(*out.view, split.fitted), split.fitted.size());
  out.terms.insert(out.terms.end(), mains.begin(), mains.end());
  out.answer = Diagnose(*out.view, split.fitted, out.terms, settings);
  Measure(split.fitted, split.kept_back, settings, out);
  return out;
}

SessionAnswer DiagnoseFiles(const SessionInputs& inputs) {
  return DiagnoseRecords(inputs.rig, Load(inputs.data, inputs), Load(inputs.holdout, inputs),
                         inputs.settings);
}

}  // namespace levitas::diagnosis
