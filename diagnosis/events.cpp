#include "diagnosis/events.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace levitas::diagnosis {
namespace {

bool SameOnAllAxes(const AxisArray& a, const AxisArray& b, std::size_t axes) {
  return std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(axes), b.begin());
}

/// More in a row are no loss but a pause: another flight, or rows that were left out.
constexpr std::uint64_t kMostLost = 20;

std::size_t LostFrames(const RigView& rig, const std::vector<Record>& records) {
  std::size_t lost = 0;
  for (const Record& record : records) {
    for (std::size_t n = 1; n < record.rows.size(); ++n) {
      const auto& before = record.rows[n - 1];
      const auto& now = record.rows[n];
      if (!before.levitated || !now.levitated) continue;
      if (now.cycle > before.cycle + 1 + kMostLost) continue;
      const bool missing = now.cycle != before.cycle + 1;
      const bool repeated =
          SameOnAllAxes(before.sample.position_m, now.sample.position_m, rig.axes) ||
          SameOnAllAxes(before.sample.command.control_current_a,
                        now.sample.command.control_current_a, rig.axes);
      if (missing || repeated) ++lost;
    }
  }
  return lost;
}

/// |sum of y e^{-jwt}|^2 with a Hann window.
double LinePower(const Record& record, std::size_t axis, double hz, double period_s) {
  const auto count = static_cast<double>(record.rows.size());
  const std::complex<double> turn = std::polar(1.0, -2.0 * std::numbers::pi * hz * period_s);
  const std::complex<double> window_turn = std::polar(1.0, 2.0 * std::numbers::pi / count);
  std::complex<double> phase = 1.0;
  std::complex<double> window = 1.0;
  std::complex<double> sum = 0.0;
  for (const auto& row : record.rows) {
    sum += row.sample.position_m[axis] * (0.5 - 0.5 * window.real()) * phase;
    phase *= turn;
    window *= window_turn;
  }
  return std::norm(sum);
}

}  // namespace

std::vector<Candidate> FindEvents(const RigView& rig, const std::vector<Record>& records,
                                  const Remainder& remainder) {
  std::vector<Candidate> found;
  constexpr double kPerFrame = 10.0;  // [nat] a repetition by chance, and a prior of one in ten
  if (const std::size_t lost = LostFrames(rig, records); lost > 0) {
    found.push_back({.effect = "dropped_samples",
                     .place = fmt::format("{} frames", lost),
                     .score = kPerFrame * static_cast<double>(lost) - kPerFrame});
  }
  double evidence = 0.0;
  std::string where;
  for (std::size_t a = 0; a < rig.axes && a < remainder.channels.size(); ++a) {
    const auto& sensor = rig.bearing(a).sensor;
    if (!(remainder.channels[a].noise_rms_m > 0.0)) continue;
    const double off =
        std::log(remainder.channels[a].noise_rms_m / analysis::ReadingNoise(sensor)) /
        kNoiseTolerance;
    const double gain = 0.5 * off * off - std::log(10.0);
    if (gain < kDecisive) continue;
    evidence += gain;
    where += (where.empty() ? "" : ", ") + rig.numbers.channels[a];
  }
  if (evidence > 0.0) {
    found.push_back({.effect = "sensor_noise", .place = where, .score = evidence});
  }
  return found;
}

std::vector<double> MainsLines(const RigView& rig, const std::vector<Record>& records) {
  std::vector<double> lines;
  for (const double hz : {50.0, 60.0, 100.0, 120.0, 150.0}) {
    bool stands_out = false;
    for (const Record& record : records) {
      const double spacing_hz = 1.0 / (static_cast<double>(record.rows.size()) * rig.period_s);
      for (std::size_t a = 0; a < rig.axes; ++a) {
        double around = 0.0;
        constexpr std::array kBeside{-7.0, -5.0, -3.0, 3.0, 5.0, 7.0};
        for (const double beside : kBeside) {
          around += LinePower(record, a, hz + beside * spacing_hz, rig.period_s) / kBeside.size();
        }
        // Noise alone exceeds its mean twelvefold once in e^12 lines.
        if (LinePower(record, a, hz, rig.period_s) > 12.0 * around) stands_out = true;
      }
    }
    if (stands_out) lines.push_back(hz);
  }
  return lines;
}

}  // namespace levitas::diagnosis
