#include "diagnosis/levitator/report_fits.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "diagnosis/inference/gain.hpp"
#include "diagnosis/levitator/run_fit.hpp"
#include "numerics/fourier_transform.hpp"
#include "numerics/hann_window.hpp"

namespace levitas::levitator {
namespace {

constexpr double kLeftOver = 1.6;   // power over white noise that a right model may leave
constexpr double kExplained = 0.7;  // as in diagnosis/inference/judging.hpp, explained_share

double Power(const std::vector<double>& error) {
  double sum = 0.0;
  for (const double value : error) sum += value * value;
  return error.empty() ? 0.0 : sum / static_cast<double>(error.size());
}

/// Mean power over white noise's, line by line; Hann windows of a second.
std::vector<double> Spectrum(const std::vector<double>& error, double noise, std::size_t length) {
  std::vector<double> power(length / 2, 0.0);
  std::vector<double> windowed(length);
  double windows = 0.0;
  for (std::size_t at = 0; at + length <= error.size(); at += length) {
    windows += 1.0;
    for (std::size_t n = 0; n < length; ++n) {
      windowed[n] = numerics::HannWeight(n, length) * error[at + n];
    }
    const std::vector<std::complex<double>> lines = numerics::HalfSpectrum(windowed);
    for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(lines[k]);
  }
  const double white = 0.375 * static_cast<double>(length) * noise * noise * std::max(1.0, windows);
  for (double& value : power) value /= white > 0.0 ? white : 1.0;
  return power;
}

/// Residual of the current where it was measured, otherwise of the motion.
struct Left {
  std::vector<double> nominal, calibrated, extended;
};

Left LeftOf(const NominalRig& rig, const std::vector<Series>& data, const Found& found) {
  Left left;
  for (const Series& series : data) {
    const auto append = [&](const Theta& theta, std::vector<double>& to) {
      const Errors errors = ErrorsOf(rig, series, SharedPart(theta, 1), 0);
      const auto& values = series.has_currents() ? errors.current_a[0] : errors.motion_m;
      to.insert(to.end(), values.begin(), values.end());
    };
    append(Zeros(1), left.nominal);
    append(found.calibrated.theta, left.calibrated);
    append(found.extended.theta, left.extended);
  }
  return left;
}

diagnosis::ReportRunFit RunFitOf(const Fit& nominal, const Fit& calibrated, const Fit& extended,
                                 double ceiling) {
  const auto percent = [](const Fit& fit) {
    return diagnosis::ReportRunFit::Percent{fit.percent, fit.low, fit.high};
  };
  return {percent(nominal), percent(calibrated), percent(extended), ceiling};
}

}  // namespace

void AddResidual(const NominalRig& rig, const std::vector<Series>& data, const Found& found,
                 diagnosis::DiagnosisReport& report) {
  const Left left = LeftOf(rig, data, found);
  const auto length = static_cast<std::size_t>(std::max(16.0, 1.0 / rig.period_s));
  const double noise = WhiteNoise(left.extended);
  diagnosis::ReportSpectra& spectra = report.spectra;
  spectra.channel = report.rig_channels.front();
  spectra.nominal = Spectrum(left.nominal, noise, length);
  spectra.calibrated = Spectrum(left.calibrated, noise, length);
  spectra.extended = Spectrum(left.extended, noise, length);
  spectra.line_spacing_hz = 1.0 / (static_cast<double>(length) * rig.period_s);
  const auto& ratio = spectra.extended;
  const auto peak = std::max_element(ratio.begin() + 1, ratio.end());
  diagnosis::ReportResidual& out = report.residual;
  out.channel = report.rig_channels.front();
  out.frequency_hz = spectra.line_spacing_hz * static_cast<double>(peak - ratio.begin());
  // A second's lines scatter by their own size over the root of the number of seconds.
  const double windows =
      std::max(1.0, static_cast<double>(left.extended.size()) / static_cast<double>(length));
  out.sigma = (*peak - 1.0) * std::sqrt(windows);
  const double floor = noise * noise;
  const double before = Power(left.calibrated) - floor;
  const double after = Power(left.extended) - floor;
  out.explained = before > 0.0 ? std::clamp(1.0 - after / before, 0.0, 1.0) : 0.0;
  const bool much = Power(left.extended) > kLeftOver * floor;
  report.verdict = much && out.explained < kExplained ? diagnosis::Verdict::kUnknown
                   : report.causes.empty()            ? diagnosis::Verdict::kNone
                                                      : diagnosis::Verdict::kEffect;
  if (report.verdict != diagnosis::Verdict::kEffect || found.doubt == diagnosis::Doubt::kNothing)
    return;
  report.verdict = diagnosis::Verdict::kSuspected;
  report.doubt = found.doubt;
  report.probability = found.probability;
}

diagnosis::ReportFit MeanFit(const std::vector<ValidationRun>& runs, bool probes,
                             const std::string& channel) {
  diagnosis::ReportFit mean;
  const double share = runs.empty() ? 0.0 : 1.0 / static_cast<double>(runs.size());
  const auto fit = [probes](const RunFit& f) { return (probes ? f.current : f.motion).percent; };
  for (const ValidationRun& run : runs) {
    mean.nominal_percent += share * fit(run.nominal);
    mean.calibrated_percent += share * fit(run.calibrated);
    mean.extended_percent += share * fit(run.extended);
    mean.ceiling_percent += share * (probes ? run.current_ceiling : run.motion_ceiling);
    mean.achieved.fraction += 0.01 * share * run.achieved.percent;
    mean.achieved.low += 0.01 * share * run.achieved.low;
    mean.achieved.high += 0.01 * share * run.achieved.high;
    mean.beyond_calibration += 0.01 * share * run.beyond_calibration.percent;
  }
  const auto over_noise = [&mean](double percent) {
    const double left = (100.0 - percent) / std::max(1e-6, 100.0 - mean.ceiling_percent);
    return left * left;
  };
  const double to_gain = over_noise(mean.nominal_percent) - 1.0;
  mean.nominal_over_noise = 1.0 + to_gain;
  mean.calibrated_over_noise = over_noise(mean.calibrated_percent);
  mean.extended_over_noise = over_noise(mean.extended_percent);
  mean.meaningful = to_gain > diagnosis::kLeastToGain;
  mean.calibration_is_complete = mean.calibrated_over_noise < 1.0 + diagnosis::kLeastToGain;
  mean.channels = {{channel, mean.nominal_percent, mean.extended_percent, mean.achieved}};
  return mean;
}

std::vector<diagnosis::ReportRun> ReportRuns(const std::vector<ValidationRun>& runs) {
  std::vector<diagnosis::ReportRun> out;
  out.reserve(runs.size());
  for (const ValidationRun& run : runs) {
    diagnosis::ReportRun& entry = out.emplace_back();
    entry.name = run.name;
    if (run.current_ceiling > 0.0) {
      entry.current = RunFitOf(run.nominal.current, run.calibrated.current, run.extended.current,
                               run.current_ceiling);
      entry.lower_current = RunFitOf(run.nominal.away, run.calibrated.away, run.extended.away, 0.0);
    }
    entry.motion = RunFitOf(run.nominal.motion, run.calibrated.motion, run.extended.motion,
                            run.motion_ceiling);
  }
  return out;
}

}  // namespace levitas::levitator
