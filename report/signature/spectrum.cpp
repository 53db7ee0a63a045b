// Full spectrum and orbit of the levitated, turning rotor, with and without an effect.
#include <cmath>
#include <complex>
#include <numbers>

#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "report/signature/orders.hpp"
#include "report/signature/signature.hpp"

namespace levitas::signature {
namespace {

using Complex = std::complex<double>;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kSpeedHz = 40.0;  // so that 50 Hz of the mains is not a multiple of it
constexpr int kTurns = 16;
constexpr int kMostOrders = 4;
constexpr double kSettleS = 1.0;

/// Readings of the first bearing as x + jy [m], over whole turns.
std::vector<Complex> Orbit(const plant::PlantParameters& rig) {
  plant::Plant plant(std::make_shared<const plant::PlantModel>(rig), 1);
  plant.SetSpeed(kTurn * kSpeedHz, 0.0);
  const double period_s = static_cast<double>(rig.config.period_ns) * 1e-9;
  const auto settle = static_cast<int>(kSettleS / period_s);
  const auto count = static_cast<int>(std::lround(kTurns / kSpeedHz / period_s));
  plant::PlantCommand command;
  command.bias_current_a = rig.config.bearings.front().magnet.bias_current_a;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = kTurn * kSpeedHz;
  command.acceleration_limit_rad_per_s2 = 1.0;
  AxisArray last_m{};
  AxisArray carried_a{};
  std::vector<Complex> orbit;
  for (int i = 0; i < settle + count; ++i) {
    const SensorFrame frame = plant.Sample();
    // A stiff spring, a damper of 3 A s/m, and an integrator that carries the weight: holds the
    // shipped rotor in the centre at every speed.
    for (std::size_t axis = 0; axis < frame.axes; ++axis) {
      const double y_m = frame.position_m[axis];  // the shipped rig has no inverted probe or coil
      carried_a[axis] -= 2e4 * y_m * period_s;
      command.control_current_a[axis] =
          carried_a[axis] - 4000.0 * y_m - 3.0 * (y_m - last_m[axis]) / period_s;
      last_m[axis] = y_m;
    }
    if (i >= settle) orbit.emplace_back(frame.position_m[0], frame.position_m[1]);
    plant.Advance(command);
  }
  return orbit;
}

svg::Series Path(const std::vector<Complex>& orbit, std::size_t colour) {
  svg::Series series;
  series.colour = svg::Colour(colour);
  const std::size_t two_turns = 2 * orbit.size() / kTurns;
  for (std::size_t i = 0; i < two_turns; i += 2) {
    series.x.push_back(orbit[i].real() * 1e6);
    series.y.push_back(orbit[i].imag() * 1e6);
  }
  return series;
}

}  // namespace

std::vector<svg::Panel> SpectrumPanels(const Pair& rigs) {
  const auto without = Orbit(rigs.without);
  const auto with = Orbit(rigs.with);
  svg::Panel spectrum{"full spectrum at 2400 rpm", "order of rotation (negative: backward)", "um"};
  spectrum.y_scale = svg::Scale::kLogarithmic;
  const Orders orders{kTurns, kMostOrders};
  spectrum.series = {OrderSpectrum(with, orders, "effect", 1),
                     OrderSpectrum(without, orders, "nominal", 0)};
  svg::Panel path{"orbit, two turns", "x, um", "y, um"};
  path.series = {Path(with, 1), Path(without, 0)};
  return {spectrum, path};
}

}  // namespace levitas::signature
