#include "identification/frf/spectra.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "identification/frf/sine_steps.hpp"
#include "identification/frf/synchronous.hpp"
#include "numerics/fourier_transform.hpp"

namespace levitas::identification {
namespace {

constexpr std::ptrdiff_t kPeriodicNeighbours = 10;
/// Lines of a stepped sine are farther apart; blocks make up for fewer of them.
constexpr std::ptrdiff_t kSteppedNeighbours = 2;
/// Lines this close to an order of rotation, in resolutions 1/T, are left out.
constexpr double kPeriodicOrderWidth = 0.75;
constexpr double kSteppedOrderWidth = 1.5;

bool NearOrder(double f_hz, double rotation_hz, int orders, double width_hz) {
  for (int k = 1; k <= orders && rotation_hz > 0.0; ++k) {
    if (std::abs(f_hz - k * rotation_hz) < width_hz) return true;
  }
  return false;
}

double RotationHz(const Experiment& e) {
  return std::abs(e.speed_rad_per_s) / (2.0 * std::numbers::pi);
}

/// Lines of one period, without the mean and without half the sampling rate.
Spectrum PeriodSpectrum(std::span<const double> samples) {
  Spectrum spectrum = numerics::HalfSpectrum(samples);
  spectrum.resize(samples.size() / 2);
  spectrum.erase(spectrum.begin());
  return spectrum;
}

std::vector<Spectrum> PeriodSpectra(const session::Column& column, const session::Recording& record,
                                    const Experiment& e, int orders) {
  const auto piece = std::span(column).subspan(e.begin, e.end() - e.begin);
  const auto angle = std::span(record.angle_rad).subspan(e.begin, piece.size());
  const std::vector<double> rest = WithoutSynchronous(piece, angle, orders);
  std::vector<Spectrum> spectra;
  for (std::size_t m = 0; m < e.periods; ++m) {
    spectra.push_back(
        PeriodSpectrum(std::span(rest).subspan(m * e.period_samples, e.period_samples)));
  }
  return spectra;
}

Spectra Periodic(const session::Recording& record, const Experiment& e, int orders) {
  Spectra s;
  s.axis = e.axis;
  s.point = e.point;
  s.periods = e.periods;
  s.neighbours = kPeriodicNeighbours;
  for (std::size_t axis = 0; axis < record.axes(); ++axis) {
    s.position.push_back(PeriodSpectra(record.position_m[axis], record, e, orders));
    s.current.push_back(PeriodSpectra(record.current_a[axis], record, e, orders));
  }
  s.excitation = PeriodSpectrum(
      std::span(SignalColumn(record, e.axis, e.point)).subspan(e.begin, e.period_samples));
  const double spacing_hz = 1.0 / (static_cast<double>(e.period_samples) * record.period_s());
  for (std::size_t k = 1; k <= s.excitation.size(); ++k) {
    s.frequency_hz.push_back(static_cast<double>(k) * spacing_hz);
    s.near_order.push_back(
        NearOrder(s.frequency_hz.back(), RotationHz(e), orders, kPeriodicOrderWidth * spacing_hz));
  }
  return s;
}

/// Amplitudes of one held sine in `column`, block by block.
void AddBlocks(const session::Column& column, const session::Recording& record,
               const HeldSine& line, std::size_t blocks, int orders, std::vector<Spectrum>& to) {
  const auto piece = std::span(column).subspan(line.begin, line.end - line.begin);
  const auto angle = std::span(record.angle_rad).subspan(line.begin, piece.size());
  const auto rest = WithoutSynchronous(piece, angle, orders, line.cycles_per_sample);
  const std::span<const double> all(rest);
  for (std::size_t m = 0; m < blocks; ++m) {
    const std::size_t begin = m * piece.size() / blocks;
    const std::size_t end = (m + 1) * piece.size() / blocks;
    to[m].push_back(SineAmplitude(all.subspan(begin, end - begin), line.cycles_per_sample, begin));
  }
}

Spectra Stepped(const session::Recording& record, const Experiment& e, int orders) {
  Spectra s;
  s.axis = e.axis;
  s.point = e.point;
  s.periods = e.periods;
  s.neighbours = kSteppedNeighbours;
  s.position.assign(record.axes(), std::vector<Spectrum>(e.periods));
  s.current = s.position;
  for (const HeldSine& line : e.sines) {
    for (std::size_t axis = 0; axis < record.axes(); ++axis) {
      AddBlocks(record.position_m[axis], record, line, e.periods, orders, s.position[axis]);
      AddBlocks(record.current_a[axis], record, line, e.periods, orders, s.current[axis]);
    }
    const std::span<const double> excitation(SignalColumn(record, e.axis, e.point));
    s.excitation.push_back(SineAmplitude(excitation.subspan(line.begin, line.end - line.begin),
                                         line.cycles_per_sample, 0));
    const double length_s = static_cast<double>(line.end - line.begin) * record.period_s();
    s.frequency_hz.push_back(line.cycles_per_sample / record.period_s());
    s.near_order.push_back(
        NearOrder(s.frequency_hz.back(), RotationHz(e), orders, kSteppedOrderWidth / length_s));
  }
  return s;
}

}  // namespace

Spectra SpectraOf(const session::Recording& record, const Experiment& experiment, int orders) {
  return experiment.sines.empty() ? Periodic(record, experiment, orders)
                                  : Stepped(record, experiment, orders);
}

}  // namespace levitas::identification
