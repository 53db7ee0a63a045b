// Frequency response of the linear model, with and without an effect.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"
#include "numerics/dense/spectrum.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "report/signature/signature.hpp"

namespace levitas::signature {
namespace {

using Complex = std::complex<double>;

constexpr double kFirstHz = 10.0;
constexpr double kLastHz = 2000.0;
constexpr int kPoints = 200;
constexpr double kLightDamping = 0.1;  // of modes that need points of their own
constexpr double kSpeedRadPerS = 2.0 * std::numbers::pi * 50.0;

struct Response {
  std::vector<double> frequency_hz;
  std::vector<Complex> direct, cross;  ///< [m/A]
};

struct System {
  explicit System(const plant::PlantParameters& rig) {
    const plant::PlantModel model(rig);
    linear = plant::Linearise(model, kSpeedRadPerS);
    delay_s = model.delay_samples() * static_cast<double>(rig.config.period_ns) * 1e-9;
  }
  plant::LinearModel linear;
  double delay_s{};
};

/// Points about the lightly damped modes, which are narrower than the steps of the grid.
void AddModes(const Eigen::MatrixXd& a, std::vector<double>& grid_hz) {
  constexpr std::array kHalfWidths{-8.0, -4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0, 8.0};
  const Eigen::VectorXcd poles = numerics::EigenvaluesOf(a);
  for (const Complex pole : poles) {
    const double damping = std::abs(pole.real()) / std::abs(pole);
    if (pole.imag() <= 0.0 || damping > kLightDamping) continue;
    for (const double widths : kHalfWidths) {
      const double f = std::abs(pole) / (2.0 * std::numbers::pi) * (1.0 + widths * damping);
      if (f > kFirstHz && f < kLastHz) grid_hz.push_back(f);
    }
  }
}

/// The same for both systems, since their ratio is drawn.
std::vector<double> Grid(const System& one, const System& other) {
  std::vector<double> grid_hz;
  grid_hz.reserve(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    grid_hz.push_back(kFirstHz * std::pow(kLastHz / kFirstHz, i / (kPoints - 1.0)));
  }
  AddModes(one.linear.a, grid_hz);
  AddModes(other.linear.a, grid_hz);
  std::sort(grid_hz.begin(), grid_hz.end());
  return grid_hz;
}

Response Compute(const System& system, const std::vector<double>& grid_hz) {
  Response response;
  for (const double f : grid_hz) {
    const Complex s(0.0, 2.0 * std::numbers::pi * f);
    Eigen::MatrixXcd pencil = -system.linear.a.cast<Complex>();
    pencil.diagonal().array() += s;
    const Eigen::VectorXcd state =
        pencil.partialPivLu().solve(system.linear.b.col(0).cast<Complex>());
    const Eigen::VectorXcd reading = system.linear.c * state * std::exp(-s * system.delay_s);
    response.frequency_hz.push_back(f);
    response.direct.push_back(reading[0]);
    response.cross.push_back(reading[1]);
  }
  return response;
}

using Curve = std::vector<Complex>;

svg::Series Line(const std::string& name, const Response& response, const Curve& values,
                 double (*figure)(Complex), std::size_t colour, bool cross) {
  svg::Series line;
  line.name = name;
  line.x = response.frequency_hz;
  for (const Complex value : values) line.y.push_back(figure(value));
  line.colour = svg::Colour(colour);
  if (cross) line.dashes = "4 3";
  return line;
}

Curve Ratio(const Curve& with, const Curve& without) {
  Curve ratio(with);
  for (std::size_t i = 0; i < ratio.size(); ++i) ratio[i] /= without[i];
  return ratio;
}

double Micrometres(Complex metres) { return std::abs(metres) * 1e6; }
double Decibels(Complex ratio) { return 20.0 * std::log10(std::abs(ratio)); }
double Degrees(Complex ratio) { return std::arg(ratio) * 180.0 / std::numbers::pi; }

/// Effect over nominal of both paths. Never finer than `least`, so that what does not change is a
/// straight line and not its rounding errors.
svg::Panel Change(const char* title, const char* unit, const Response& with,
                  const Response& without, double (*figure)(Complex), double least) {
  svg::Panel panel{title, "frequency, Hz", unit};
  panel.x_scale = svg::Scale::kLogarithmic;
  panel.series = {Line("x to x", with, Ratio(with.direct, without.direct), figure, 1, false),
                  Line("x to y", with, Ratio(with.cross, without.cross), figure, 2, true)};
  const svg::Range range =
      svg::Enclose({panel.series[0].y, panel.series[1].y}, svg::Scale::kLinear);
  const double low = std::min(range.low, -least);
  const double high = std::max(range.high, least);
  const double room = 0.06 * (high - low);  // a change that is the same everywhere is no edge
  panel.y_range = svg::Range{low - room, high + room};
  return panel;
}

}  // namespace

std::vector<svg::Panel> ResponsePanels(const Pair& rigs) {
  const System nominal(rigs.without);
  const System changed(rigs.with);
  const std::vector<double> grid_hz = Grid(nominal, changed);
  const Response without = Compute(nominal, grid_hz);
  const Response with = Compute(changed, grid_hz);
  svg::Panel gain{"current to reading at 3000 rpm", "frequency, Hz", "gain, µm/A"};
  gain.x_scale = gain.y_scale = svg::Scale::kLogarithmic;
  gain.series = {Line("nominal", without, without.direct, Micrometres, 0, false),
                 Line("nominal, x to y", without, without.cross, Micrometres, 0, true),
                 Line("effect", with, with.direct, Micrometres, 1, false),
                 Line("effect, x to y", with, with.cross, Micrometres, 1, true)};
  MakeNominal(gain.series[0]);
  MakeNominal(gain.series[1]);
  return {gain,
          Change("gain, effect over nominal", "change of gain, dB", with, without, Decibels, 0.5),
          Change("phase, effect minus nominal", "change of phase, degrees", with, without, Degrees,
                 5.0)};
}

}  // namespace levitas::signature
