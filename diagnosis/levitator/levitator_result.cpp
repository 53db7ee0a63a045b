#include "diagnosis/levitator/levitator_result.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/levitator/build_report.hpp"
#include "diagnosis/records/load.hpp"
#include "diagnosis/records/same_rows.hpp"
#include "diagnosis/report/levitation.hpp"

namespace levitas::levitator {
namespace {

constexpr double kStretchS = 4.0;
constexpr int kBisections = 5;

std::vector<diagnosis::Record> Load(const std::vector<std::string>& paths,
                                    const diagnosis::DiagnosisRequest& inputs) {
  std::vector<diagnosis::Record> out;
  out.reserve(paths.size());
  for (const std::string& path : paths) {
    out.push_back(diagnosis::LoadRecord(path, inputs.rig));
  }
  return out;
}

std::vector<Series> SeriesOf(const std::vector<diagnosis::Record>& records,
                             const configuration::RigFile& rig) {
  std::vector<Series> out;
  out.reserve(records.size());
  for (const auto& record : records) out.push_back(MakeSeries(record.name, rig, record.rows));
  return out;
}

/// Stretches of all records, each from another part of its own.
std::vector<Series> Stretches(const std::vector<Series>& data) {
  constexpr double kLongestS = 16.0;
  const double seconds =
      std::clamp(kLongestS / static_cast<double>(data.size()), 2.0, 2.0 * kStretchS);
  std::vector<Series> out;
  out.reserve(data.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    const double phase =
        data.size() < 2 ? 0.0 : static_cast<double>(i) / static_cast<double>(data.size() - 1);
    out.push_back(Stretch(data[i], seconds, phase));
  }
  return out;
}

struct Models {
  Theta calibrated, extended;
};

ValidationRun Judge(const NominalRig& rig, const Series& series, const Models& models) {
  const auto errors = [&](const Theta& theta) {
    return ErrorsOf(rig, series, SharedPart(theta, 1), 0);
  };
  const Errors nominal = errors(Zeros(1));
  const Errors calibrated = errors(models.calibrated);
  const Errors extended = errors(models.extended);
  ValidationRun run;
  run.name = series.name;
  run.nominal = FitOf(nominal, rig.period_s);
  run.calibrated = FitOf(calibrated, rig.period_s);
  run.extended = FitOf(extended, rig.period_s);
  const bool probes = series.has_currents();
  const auto& channel = [probes](const Errors& e) -> const std::vector<double>& {
    return probes ? e.current_a[0] : e.motion_m;
  };
  const double noise = WhiteNoise(channel(extended));
  run.current_ceiling = probes ? Ceiling(extended.measured_a[0], noise) : 0.0;
  run.motion_ceiling = Ceiling(extended.position_m, WhiteNoise(extended.motion_m));
  run.achieved = SharePercent(channel(nominal), channel(extended), noise, rig.period_s);
  run.beyond_calibration =
      SharePercent(channel(calibrated), channel(extended), noise, rig.period_s);
  return run;
}

/// Each record by what the others say of the same causes.
std::vector<ValidationRun> InTurn(const NominalRig& rig, const std::vector<Series>& data,
                                  const std::vector<Series>& stretches, const Found& found) {
  std::vector<ValidationRun> runs;
  for (std::size_t out = 0; out < data.size(); ++out) {
    std::vector<Series> others;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      if (i != out) others.push_back(stretches[i]);
    }
    const Misfit misfit(rig, others);
    const Fitter fitter(misfit);
    const Theta start = SharedPart(found.extended.theta, others.size());
    const Theta plain = SharedPart(found.calibrated.theta, others.size());
    runs.push_back(Judge(rig, data[out],
                         {fitter.Fit({}, plain, found.filters, kBisections).theta,
                          fitter.Fit(found.causes, start, found.filters, kBisections).theta}));
  }
  return runs;
}

std::vector<ValidationRun> JudgeAll(const NominalRig& rig, const std::vector<Series>& data,
                                    const Found& found) {
  std::vector<ValidationRun> runs;
  runs.reserve(data.size());
  for (const Series& series : data) {
    runs.push_back(Judge(rig, series, {found.calibrated.theta, found.extended.theta}));
  }
  return runs;
}

/// Whatever the file gets wrong of these records is how the rig is: searches begin there, and what
/// is left free is what the records leave open and what changes from day to day. Their numbers are
/// free together: of supply and resistance they know the ratio far better than either.
void LearnFromHealthy(const std::vector<Series>& healthy, SearchSettings settings,
                      NominalRig& rig) {
  const std::vector<Series> stretches = Stretches(healthy);
  settings.form_share = 0.0;  // what is left unexplained here is accused in all that follow
  const Found found = Search(Misfit(rig, stretches), nullptr, settings);
  const Theta shared = SharedPart(found.extended.theta, 1);
  rig.origin = ComposedWith(rig.origin, shared);
  rig.origin[kResistance] =
      ComposedWith(kResistance, rig.origin[kResistance], shared[Own(0, kOwnResistance)]);
  rig.origin[kSensorOffset] += shared[Own(0, kOwnOffset)];
  rig.origin.resize(kParameters);
  rig.known = found.extended.covariance;
  for (std::size_t i = 0; i < kParameters; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    rig.known(at, at) += std::pow(diagnosis::kDaily * ToleranceOf(i), 2);
  }
}

}  // namespace

LevitatorResult Diagnose(const configuration::RigFile& rig, const std::vector<Series>& given,
                         const std::vector<Series>& given_validation,
                         const diagnosis::Settings& settings, const std::vector<Series>& healthy) {
  NominalRig nominal = NominalOf(rig);
  SearchSettings search;
  search.progress = settings.progress;
  if (!healthy.empty()) LearnFromHealthy(healthy, search, nominal);
  std::vector<Series> data = given;
  std::vector<Series> validation = given_validation;
  if (data.size() == 1 && validation.empty()) {
    const Series whole = data.front();
    const double seconds = whole.time_s.back() - whole.time_s.front();
    data.front() = Stretch(whole, 0.6 * seconds, 0.0);
    validation.push_back(Stretch(whole, 0.3 * seconds, 1.0));
    search.own_validation = true;
  }
  const std::vector<Series> stretches = Stretches(data);
  const Misfit misfit(nominal, stretches);
  LevitatorResult answer;
  if (validation.empty()) {
    answer.found = Search(misfit, nullptr, search);
    answer.validation = InTurn(nominal, data, stretches, answer.found);
  } else {
    const Misfit on_validation(nominal, validation);
    answer.found = Search(misfit, &on_validation, search);
    answer.validation = JudgeAll(nominal, validation, answer.found);
  }
  answer.fitted = JudgeAll(nominal, data, answer.found);
  answer.report = BuildReport(rig, nominal, data, answer);
  return answer;
}

LevitatorResult Diagnose(const diagnosis::DiagnosisRequest& inputs) {
  const auto data = Load(inputs.data, inputs);
  const auto holdout = Load(inputs.holdout, inputs);
  diagnosis::RefuseSameRows(data, holdout, "--holdout", "what was fitted cannot judge the fit");
  const auto healthy = Load(inputs.healthy, inputs);
  diagnosis::RefuseSameRows(data, healthy, "--healthy", "it would vouch for itself");
  LevitatorResult answer =
      Diagnose(inputs.rig, SeriesOf(data, inputs.rig), SeriesOf(holdout, inputs.rig),
               inputs.settings, SeriesOf(healthy, inputs.rig));
  diagnosis::JudgeLevitation(inputs.rig, inputs.known_laws, answer.report);
  return answer;
}

}  // namespace levitas::levitator
