#include "diagnosis/inference/mains_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "diagnosis/inference/search.hpp"

namespace levitas::diagnosis {
namespace {

using Samples = std::vector<double>;

constexpr double kTimes = 12.0;  ///< noise alone exceeds its mean so far once in e^12 lines

/// |sum of y e^{-jwt}|^2 with a Hann window.
double LinePower(const Samples& signal, double hz, double period_s) {
  const auto count = static_cast<double>(signal.size());
  const std::complex<double> turn = std::polar(1.0, -2.0 * std::numbers::pi * hz * period_s);
  const std::complex<double> window_turn = std::polar(1.0, 2.0 * std::numbers::pi / count);
  std::complex<double> phase = 1.0;
  std::complex<double> window = 1.0;
  std::complex<double> sum = 0.0;
  for (const double y : signal) {
    sum += y * (0.5 - 0.5 * window.real()) * phase;
    phase *= turn;
    window *= window_turn;
  }
  return std::norm(sum);
}

bool StandsOut(const Samples& signal, double hz, double period_s) {
  const double spacing_hz = 1.0 / (static_cast<double>(signal.size()) * period_s);
  double around = 0.0;
  constexpr std::array kBeside{-7.0, -5.0, -3.0, 3.0, 5.0, 7.0};
  for (const double beside : kBeside) {
    around += LinePower(signal, hz + beside * spacing_hz, period_s) / kBeside.size();
  }
  return LinePower(signal, hz, period_s) > kTimes * around;
}

void AddReadings(const RigView& rig, const Record& record, std::vector<Samples>& signals) {
  for (std::size_t a = 0; a < rig.axes; ++a) {
    Samples& readings = signals.emplace_back();
    for (const auto& row : record.rows) readings.push_back(row.sample.position_m[a]);
  }
}

void AddInnovations(const RigView& rig, const Trajectory& run, std::vector<Samples>& signals) {
  for (std::size_t a = 0; a < rig.axes; ++a) {
    Samples& innovations = signals.emplace_back();
    for (const SamplePoint& m : run.moments) {
      if (m.settled) innovations.push_back(static_cast<double>(m.innovation_m[a]));
    }
  }
}

}  // namespace

std::vector<double> MainsLines(const RigView& rig, const std::vector<Record>& records) {
  const std::vector<Term> healthy;
  const Search search(rig, healthy);
  std::vector<Samples> signals;
  for (const Record& record : records) AddReadings(rig, record, signals);
  for (const Trajectory& run : search.Run(records, search.DesignGains(records, kFast), {})) {
    AddInnovations(rig, run, signals);
  }
  std::vector<double> lines;
  for (const effect::EffectConfig& entry : rig.by_chance) {
    if (entry.id == effect::Id::kMainsPickup) lines.push_back(entry.values[0]);
  }
  for (const double hz : {50.0, 60.0, 100.0, 120.0, 150.0}) {
    const bool out = std::any_of(signals.begin(), signals.end(), [&](const Samples& signal) {
      return !signal.empty() && StandsOut(signal, hz, rig.period_s);
    });
    if (out && std::find(lines.begin(), lines.end(), hz) == lines.end()) lines.push_back(hz);
  }
  return lines;
}

}  // namespace levitas::diagnosis
