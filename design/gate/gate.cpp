#include "design/gate/gate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/poles.hpp"
#include "analysis/sensitivity.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/law_schedule.hpp"
#include "controller/law/running_law.hpp"
#include "design/drawn_rigs/healthy_rig.hpp"
#include "design/uncertainty/mixed_mu.hpp"

namespace levitas::design {
namespace {

using Progress = std::function<void(double, const std::string&)>;

void Raise(Peak& peak, double value, double hz, double speed) {
  if (value > peak.value) peak = {value, hz, speed};
}

std::vector<double> DrawCorner(Random& draw, std::size_t parameters) {
  auto out = uncertainty::DrawPlace(draw, parameters);
  for (double& place : out) place = place < 0.0 ? -1.0 : 1.0;
  return out;
}

/// Poles and |S| of one loop; false when it is unstable.
enum class Of { kFile, kCorner, kDrawn };

bool JudgeLoop(const configuration::RigFile& rig, const law::LawConfig& law, double speed, Of of,
               GateResult& out) {
  const auto found = analysis::SensitivityPeaks(rig.plant, law, speed);
  ++out.loops;
  if (found.largest_pole_modulus > out.pole_modulus) {
    out.pole_modulus = found.largest_pole_modulus;
    out.pole_speed_rad_per_s = speed;
  }
  Peak& peak = of == Of::kFile     ? out.sensitivity
               : of == Of::kCorner ? out.corner_sensitivity
                                   : out.drawn_sensitivity;
  for (const auto& axis : found.axes) Raise(peak, axis.peak, axis.frequency_hz, speed);
  if (of == Of::kFile)
    Raise(out.singular, found.largest_singular_value, found.largest_singular_value_hz, speed);
  if (found.stable || !out.reason.empty()) return found.stable;
  out.reason =
      fmt::format("the loop is unstable at {:.0f} rpm ({}, |z| {:.6f})", RadPerSToRpm(speed),
                  of == Of::kFile     ? "the rig file"
                  : of == Of::kCorner ? "a corner"
                                      : "a drawn rig",
                  found.largest_pole_modulus);
  return false;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// [speed][bearing]: of every drawn rig that was not lost.
using Orbits = std::vector<std::vector<std::vector<double>>>;

/// One drawn rig at every speed; `worst_m` is the largest orbit of all of them so far.
void RunAtSpeeds(const configuration::RigFile& drawn, const law::LawConfig& law, std::uint64_t seed,
                 Orbits& orbits, double& worst_m, GateResult& out) {
  for (std::size_t s = 0; s < out.drawn.size(); ++s) {
    const auto run =
        RunOnce(drawn, law, {.speed_rad_per_s = out.drawn[s].speed_rad_per_s, .seed = seed});
    double largest_m = run.lost ? 1.0 : 0.0;
    if (run.lost) ++out.drawn[s].lost;
    for (std::size_t b = 0; b < orbits[s].size() && !run.lost; ++b) {
      orbits[s][b].push_back(run.orbit_m[b]);
      out.drawn[s].worst_orbit_m[b] = std::max(out.drawn[s].worst_orbit_m[b], run.orbit_m[b]);
      largest_m = std::max(largest_m, run.orbit_m[b]);
    }
    if (largest_m > worst_m) {
      worst_m = largest_m;
      out.worst = drawn;
    }
  }
}

void RunDrawn(const configuration::RigFile& rig, const law::LawConfig& law,
              const std::vector<uncertainty::Parameter>& parameters, const GateOptions& options,
              const Progress& progress, GateResult& out) {
  const std::size_t bearings = rig.numbers.bearings.size();
  Orbits orbits(options.run_speeds_rad_per_s.size(), std::vector<std::vector<double>>(bearings));
  for (const double speed : options.run_speeds_rad_per_s)
    out.drawn.push_back({speed, 0, std::vector<double>(bearings), std::vector<double>(bearings)});
  Random draw(options.seed);
  double worst_m = -1.0;
  for (std::size_t n = 0; n < options.draws; ++n) {
    // The first is the rig as its file has it.
    auto drawn =
        n == 0 ? rig
               : uncertainty::At(rig, parameters, uncertainty::DrawPlace(draw, parameters.size()));
    if (options.tolerances && n > 0) drawn = uncertainty::DrawWithin(drawn, draw);
    if (options.tolerances)
      for (const double speed : {0.0, rig.numbers.max_speed_rad_per_s})
        JudgeLoop(drawn, law, speed, Of::kDrawn, out);
    RunAtSpeeds(WithThirdHarmonic(drawn, options.third_n), law, options.seed + n, orbits, worst_m,
                out);
    ++out.rigs;
    progress(0.4 + 0.6 * static_cast<double>(n + 1) / static_cast<double>(options.draws),
             fmt::format("{} of {} drawn rigs", n + 1, options.draws));
  }
  for (std::size_t s = 0; s < out.drawn.size(); ++s) {
    for (std::size_t b = 0; b < bearings; ++b)
      out.drawn[s].median_orbit_m[b] = Median(orbits[s][b]);
    if (out.drawn[s].lost > 0 && out.reason.empty())
      out.reason = fmt::format("{} of {} drawn rigs are lost at {:.0f} rpm", out.drawn[s].lost,
                               out.rigs, RadPerSToRpm(out.drawn[s].speed_rad_per_s));
  }
}

}  // namespace

namespace {

/// Poles of the loop with every law that a schedule may run, at the speed of that law.
void JudgeRungs(const configuration::RigFile& rig, const law::LawConfig& law, double most_rad_per_s,
                GateResult& out) {
  const double last = law.schedule.back().speed_rad_per_s;
  for (std::size_t i = 0; i < law::kRungs; ++i) {
    const double speed = last * static_cast<double>(i) / static_cast<double>(law::kRungs - 1);
    if (speed > most_rad_per_s) return;  // where the rig never gets
    const auto loop = analysis::ClosedLoopPoles(rig.plant, law, speed);
    ++out.rungs;
    if (loop.largest_pole_modulus > out.pole_modulus) {
      out.pole_modulus = loop.largest_pole_modulus;
      out.pole_speed_rad_per_s = speed;
    }
    if (loop.stable || !out.reason.empty()) continue;
    out.reason =
        fmt::format("the loop with the schedule's law of {:.0f} rpm {}", RadPerSToRpm(speed),
                    loop.point.failure.empty()
                        ? fmt::format("is unstable (|z| {:.6f})", loop.largest_pole_modulus)
                        : "does not hold the rotor: " + loop.point.failure);
  }
}

/// Where laws change places, the lower one goes on for a while above the exchange, while the other
/// listens, and the upper one below it on the way down.
void JudgeExchanges(const configuration::RigFile& rig, const law::LawConfig& law,
                    double most_rad_per_s, GateResult& out) {
  const double listened = rig.plant.drive.max_acceleration_rad_per_s2 * law::kListenS;
  for (const law::Exchange& exchange : law::Exchanges(law)) {
    if (exchange.at_rad_per_s > most_rad_per_s) return;  // where the rig never gets
    ++out.exchanges;
    JudgeLoop(rig, exchange.lower, exchange.at_rad_per_s + listened, Of::kFile, out);
    JudgeLoop(rig, exchange.upper, std::max(0.0, exchange.upper_from_rad_per_s - listened),
              Of::kFile, out);
  }
}

/// Through every speed with the law that changes on the way, and back.
void RunUp(const configuration::RigFile& rig, const law::LawConfig& law, const GateOptions& options,
           GateResult& out) {
  const double top = rig.numbers.max_speed_rad_per_s;
  if (!(top > 0.0) || !(rig.plant.drive.max_acceleration_rad_per_s2 > 0.0)) return;
  out.run_up = RunOnce(WithThirdHarmonic(rig, options.third_n), law,
                       {.speed_rad_per_s = top, .seed = options.seed, .run_up = true});
  if (out.run_up->lost && out.reason.empty())
    out.reason =
        fmt::format("the rotor is lost on the way to {:.0f} rpm and back", RadPerSToRpm(top));
}

std::vector<double> SpeedsOfGate(const law::LawConfig& law, const GateOptions& options,
                                 double top) {
  std::vector<double> speeds;
  constexpr double kDenser = 5.0;  // where the law changes with the speed
  const double step =
      law.schedule.empty() ? options.step_rad_per_s : options.step_rad_per_s / kDenser;
  for (double w = 0.0; w < options.over_speed * top + 1e-6; w += step) speeds.push_back(w);
  if (speeds.empty()) speeds.push_back(0.0);
  return speeds;
}

void JudgeCorners(const configuration::RigFile& rig, const law::LawConfig& law,
                  const std::vector<uncertainty::Parameter>& parameters, const GateOptions& options,
                  const Progress& progress, GateResult& out) {
  Random draw(options.seed + 1000);
  for (std::size_t c = 0; c < options.corners; ++c) {
    const auto corner = uncertainty::At(rig, parameters, DrawCorner(draw, parameters.size()));
    for (const double speed : {0.0, rig.numbers.max_speed_rad_per_s})
      JudgeLoop(corner, law, speed, Of::kCorner, out);
    progress(0.2 + 0.1 * static_cast<double>(c + 1) / static_cast<double>(options.corners),
             "corners of the uncertainty");
  }
}

/// |S| of the file's rig and of the corners against what is allowed.
void JudgeSensitivity(const GateOptions& options, GateResult& out) {
  if (out.reason.empty() && out.sensitivity.value > options.sensitivity)
    out.reason = fmt::format("|S| reaches {:.2f} at {:.1f} Hz, {:.0f} rpm; allowed {:.2f}",
                             out.sensitivity.value, out.sensitivity.hz,
                             RadPerSToRpm(out.sensitivity.speed_rad_per_s), options.sensitivity);
  if (out.reason.empty() && options.corner_sensitivity &&
      out.corner_sensitivity.value > *options.corner_sensitivity)
    out.reason = fmt::format(
        "|S| reaches {:.2f} at {:.1f} Hz, {:.0f} rpm, in a corner; allowed {:.2f}",
        out.corner_sensitivity.value, out.corner_sensitivity.hz,
        RadPerSToRpm(out.corner_sensitivity.speed_rad_per_s), *options.corner_sensitivity);
}

/// Frequency and mu at it.
using MuSamples = std::vector<std::pair<double, double>>;

/// In the middle beside every peak of the sorted samples that is not bracketed closely yet.
std::vector<double> FrequenciesBesidePeaks(const MuSamples& at) {
  constexpr double kBracketed = 1.01;
  std::vector<double> between;
  const double largest = std::max_element(at.begin(), at.end(), [](auto& a, auto& b) {
                           return a.second < b.second;
                         })->second;
  for (std::size_t i = 1; i + 1 < at.size(); ++i) {
    const bool top = at[i].second >= at[i - 1].second && at[i].second >= at[i + 1].second;
    if (!top || at[i].second < 0.7 * largest) continue;
    for (const std::size_t k : {i - 1, i}) {
      const double ratio = at[k].second / at[k + 1].second;
      if (std::max(ratio, 1.0 / ratio) > kBracketed)
        between.push_back(std::sqrt(at[k].first * at[k + 1].first));
    }
  }
  return between;
}

}  // namespace

MuPeaks MuPeakAt(const configuration::RigFile& rig, const law::LawConfig& law,
                 const std::vector<uncertainty::Parameter>& parameters,
                 const uncertainty::AnalysisWeights& weights, double speed) {
  constexpr int kPoints = 300;
  constexpr double kLightlyDamped = 0.12;
  const uncertainty::UncertainPlant plant(rig, parameters, speed);
  const uncertainty::LawResponse response(law::LawAt(law, speed));
  MuSamples at;
  const auto mu_of = [&](double hz) {
    const auto point = plant.At(hz);
    return uncertainty::ComplexMu(uncertainty::LoopMatrix(point, response.At(hz), weights),
                                  plant.perturbations());
  };
  const auto add = [&](double hz) { at.emplace_back(hz, mu_of(hz)); };
  for (int i = 0; i < kPoints; ++i)
    add(weights.first_hz * std::pow(weights.last_hz / weights.first_hz, i / (kPoints - 1.0)));
  for (const auto& pole : analysis::ClosedLoopPoles(rig.plant, law, speed).poles) {
    const double hz = std::abs(pole.frequency_hz);
    if (pole.damping_ratio < kLightlyDamped && hz > weights.first_hz && hz < weights.last_hz)
      for (const double beside : {1.0 - pole.damping_ratio, 1.0, 1.0 + pole.damping_ratio})
        add(beside * hz);
  }
  for (int turn = 0; turn < 6; ++turn) {
    std::sort(at.begin(), at.end());
    const std::vector<double> between = FrequenciesBesidePeaks(at);
    if (between.empty()) break;
    for (const double hz : between) add(hz);
  }
  MuPeaks out;
  for (const auto& [hz, mu] : at) Raise(out.of_complex, mu, hz, speed);
  // Real perturbations have at most the bound of complex ones: where that is below what was found,
  // nothing is left to look for.
  std::ranges::sort(at, std::ranges::greater{}, &std::pair<double, double>::second);
  for (const auto& [hz, mu] : at) {
    if (mu <= out.of_real.value) break;
    const auto point = plant.At(hz);
    Raise(out.of_real,
          uncertainty::MixedMu(uncertainty::LoopMatrix(point, response.At(hz), weights),
                               plant.perturbations(), out.of_real.value),
          hz, speed);
  }
  return out;
}

std::vector<double> RunSpeeds(double rated_rad_per_s) {
  std::vector<double> out{0.0};
  for (int i = 2; i <= 20 && rated_rad_per_s > 0.0; ++i) out.push_back(rated_rad_per_s * i / 20.0);
  return out;
}

GateResult RunDrawnRigs(const configuration::RigFile& rig, const law::LawConfig& law,
                        const std::vector<uncertainty::Parameter>& parameters,
                        const GateOptions& options) {
  GateResult out;
  RunDrawn(
      rig, law, parameters, options, [](double, const std::string&) {}, out);
  out.accepted = out.reason.empty();
  return out;
}

GateResult Judge(const configuration::RigFile& rig, const law::LawConfig& law,
                 const std::vector<uncertainty::Parameter>& parameters, const GateOptions& options,
                 const Progress& progress) {
  GateResult out;
  const double top = rig.numbers.max_speed_rad_per_s;
  const std::vector<double> speeds = SpeedsOfGate(law, options, top);
  for (const double speed : speeds) {
    JudgeLoop(rig, law, speed, Of::kFile, out);
    progress(0.2 * speed / std::max(speeds.back(), 1e-9),
             fmt::format("poles and |S| at {:.0f} rpm", RadPerSToRpm(speed)));
  }
  if (!law.schedule.empty()) {
    JudgeRungs(rig, law, options.over_speed * top, out);
    JudgeExchanges(rig, law, options.over_speed * top, out);
    RunUp(rig, law, options, out);
  }
  JudgeCorners(rig, law, parameters, options, progress, out);
  JudgeSensitivity(options, out);
  for (const double speed : {0.0, 0.5 * top, top}) {
    const MuPeaks peak = MuPeakAt(rig, law, parameters, options.weights, speed);
    Raise(out.mu, peak.of_real.value, peak.of_real.hz, speed);
    Raise(out.mu_complex, peak.of_complex.value, peak.of_complex.hz, speed);
  }
  progress(0.4, "mu");
  if (out.reason.empty() && options.mu && out.mu.value > *options.mu)
    out.reason =
        fmt::format("mu reaches {:.2f} at {:.1f} Hz, {:.0f} rpm; allowed {:.2f}", out.mu.value,
                    out.mu.hz, RadPerSToRpm(out.mu.speed_rad_per_s), *options.mu);
  RunDrawn(rig, law, parameters, options, progress, out);
  out.accepted = out.reason.empty();
  return out;
}

}  // namespace levitas::design
