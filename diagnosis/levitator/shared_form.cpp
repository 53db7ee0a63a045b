#include "diagnosis/levitator/shared_form.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "diagnosis/levitator/own_words.hpp"
#include "diagnosis/levitator/plan.hpp"
#include "numerics/fourier_transform.hpp"

namespace levitas::levitator {
namespace {

constexpr double kLeftOver = 1.6;   // power over white noise that a right model may leave
constexpr double kExplained = 0.7;  // as in diagnosis.hpp

std::vector<diagnosis::Term> TermsOf() {
  std::vector<diagnosis::Term> terms;
  for (const Row& row : Table()) {
    terms.push_back(diagnosis::MakeTerm(
        {std::string(row.effect), "ball_x", std::string(row.name), std::string(row.unit)},
        row.tolerance, row.wide, nullptr));
  }
  return terms;
}

void FillParameters(const Found& found, diagnosis::SearchResult& out) {
  const auto estimate = [](std::size_t i, const Fitted& fit) {
    const Row& row = Table()[i];
    return diagnosis::Estimate{std::string(row.effect), "ball_x",     std::string(row.name),
                               std::string(row.unit),   fit.theta[i], fit.deviation[i]};
  };
  for (const std::size_t c : found.causes) {
    for (const std::size_t i : Causes()[c].moves) {
      out.parameters.push_back(estimate(i, found.extended));
    }
  }
  for (std::size_t i = 0; i < kParameters; ++i) {
    if (Table()[i].tolerance > 0.0) out.calibration.push_back(estimate(i, found.extended));
  }
}

/// A candidate whose parameters include all of a named cause's is that cause with one more free
/// parameter, not a tie.
bool Contains(const Cause& cause, const Cause& named) {
  return std::all_of(named.moves.begin(), named.moves.end(), [&](std::size_t i) {
    return std::find(cause.moves.begin(), cause.moves.end(), i) != cause.moves.end();
  });
}

void FillCauses(const Found& found, LevitatorResult& answer) {
  diagnosis::SearchResult& out = answer.common.answer;
  for (const std::size_t c : found.causes) {
    diagnosis::Hypothesis cause;
    cause.effect = Causes()[c].effect;
    cause.place = Causes()[c].where;
    cause.terms = Causes()[c].moves;
    out.causes.push_back(cause);
    answer.ties.push_back({cause.effect, {}});
  }
  for (const Score& score : found.scores) {
    const Cause& cause = Causes()[score.cause];
    out.candidates.push_back({cause.effect, cause.where, score.nat, score.cause, score.refitted});
    if (score.named || score.instead_of >= Causes().size()) continue;
    for (std::size_t k = 0; k < found.causes.size(); ++k) {
      const double least = std::max(diagnosis::kDecisive, kFormOfTie * found.scores[k].nat);
      const bool close = found.causes[k] == score.instead_of && score.behind_nat < least;
      if (Contains(cause, Causes()[found.causes[k]])) continue;
      if (close && score.refitted) answer.ties[k].others.push_back(cause.effect);
    }
  }
  if (!answer.ties.empty()) out.also_possible = answer.ties.front().others;
  out.evidence = found.evidence;
}

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
      const double hann = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(n) /
                                               static_cast<double>(length));
      windowed[n] = hann * error[at + n];
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

void FillRemainder(const NominalRig& rig, const Left& left, diagnosis::DiagnosisResult& common) {
  const auto length = static_cast<std::size_t>(std::max(16.0, 1.0 / rig.period_s));
  const double noise = WhiteNoise(left.extended);
  common.ratio_before = Spectrum(left.nominal, noise, length);
  common.ratio_calibrated = Spectrum(left.calibrated, noise, length);
  common.ratio_after = Spectrum(left.extended, noise, length);
  common.line_spacing_hz = 1.0 / (static_cast<double>(length) * rig.period_s);
  diagnosis::Residual& out = common.answer.remainder;
  diagnosis::ChannelRemainder channel;
  channel.noise_rms_m = noise;
  channel.ratio = common.ratio_after;
  const auto peak = std::max_element(channel.ratio.begin() + 1, channel.ratio.end());
  channel.band_ratio = *peak;
  channel.peak_hz = common.line_spacing_hz * static_cast<double>(peak - channel.ratio.begin());
  out.channels = {channel};
  out.line_spacing_hz = common.line_spacing_hz;
  out.frequency_hz = channel.peak_hz;
  // A second's lines scatter by their own size over the root of the number of seconds.
  const double windows =
      std::max(1.0, static_cast<double>(left.extended.size()) / static_cast<double>(length));
  channel.sigma = (channel.band_ratio - 1.0) * std::sqrt(windows);
  out.sigma = channel.sigma;
  const double floor = noise * noise;
  const double before = Power(left.calibrated) - floor;
  const double after = Power(left.extended) - floor;
  common.answer.explained = before > 0.0 ? std::clamp(1.0 - after / before, 0.0, 1.0) : 0.0;
  const bool much = Power(left.extended) > kLeftOver * floor;
  diagnosis::SearchResult& answer = common.answer;
  answer.verdict = much && answer.explained < kExplained ? diagnosis::Verdict::kUnknown
                   : answer.causes.empty()               ? diagnosis::Verdict::kNone
                                                         : diagnosis::Verdict::kEffect;
}

diagnosis::Gain MeanOf(const std::vector<ValidationRun>& runs, bool probes) {
  diagnosis::Gain gain;
  const double share = runs.empty() ? 0.0 : 1.0 / static_cast<double>(runs.size());
  const auto fit = [probes](const RunFit& f) { return (probes ? f.current : f.motion).percent; };
  for (const ValidationRun& run : runs) {
    gain.nominal_percent += share * fit(run.nominal);
    gain.calibrated_percent += share * fit(run.calibrated);
    gain.extended_percent += share * fit(run.extended);
    gain.ceiling_percent += share * (probes ? run.current_ceiling : run.motion_ceiling);
    gain.achieved.value += 0.01 * share * run.achieved.percent;
    gain.achieved.low += 0.01 * share * run.achieved.low;
    gain.achieved.high += 0.01 * share * run.achieved.high;
    gain.beyond_calibration.value += 0.01 * share * run.beyond_calibration.percent;
  }
  const auto over_noise = [&gain](double percent) {
    const double left = (100.0 - percent) / std::max(1e-6, 100.0 - gain.ceiling_percent);
    return left * left;
  };
  const double to_gain = over_noise(gain.nominal_percent) - 1.0;
  gain.to_gain = {to_gain, to_gain, to_gain};
  gain.calibrated_over_noise = over_noise(gain.calibrated_percent);
  gain.extended_over_noise = over_noise(gain.extended_percent);
  gain.channel_nominal_percent = {gain.nominal_percent};
  gain.channel_extended_percent = {gain.extended_percent};
  gain.channel = {gain.achieved};
  return gain;
}

}  // namespace

void FillSharedForm(const config::RigFile& rig, const NominalRig& nominal,
                    const std::vector<Series>& data, LevitatorResult& answer) {
  diagnosis::DiagnosisResult& common = answer.common;
  common.view = std::make_shared<const diagnosis::RigView>(rig.numbers, rig.plant);
  common.terms = TermsOf();
  common.own_words = OwnWordsOf(rig, nominal.origin, answer.found);
  FillCauses(answer.found, answer);
  FillParameters(answer.found, common.answer);
  common.answer.theta_calibrated = SharedPart(answer.found.calibrated.theta, 0);
  common.answer.theta_extended = SharedPart(answer.found.extended.theta, 0);
  for (const Series& series : data) {
    common.seconds_of_data += static_cast<double>(series.size()) * nominal.period_s;
  }
  common.seconds_used = common.seconds_of_data;
  FillRemainder(nominal, LeftOf(nominal, data, answer.found), common);
  common.own_words->next = fmt::format("{}", fmt::join(Separations(answer), "; "));
  const bool probes = data.front().has_currents();
  common.fitted = MeanOf(answer.fitted, probes);
  common.validation = MeanOf(answer.validation, probes);
}

}  // namespace levitas::levitator
