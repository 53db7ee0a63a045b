// Full spectrum of the driving wheel's shaft, with and without an effect of the teeth.
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "report/signature/orders.hpp"
#include "report/signature/signature.hpp"

namespace levitas::signature {
namespace {

using Complex = std::complex<double>;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kSpeedHz = 20.0;
constexpr int kTurns = 16;       // of the driving wheel, whole ones of a wheel half as fast
constexpr int kNear = 3;         // orders about rotation
constexpr int kMeshOrders = 50;  // two harmonics of a mesh of 20 teeth and their neighbours
constexpr double kSettleS = 1.5;

/// Readings of the first bearing as x + jy [m]. Geared shafts stand on springs of their own: no law.
std::vector<Complex> Orbit(const plant::PlantParameters& rig) {
  plant::Plant plant(std::make_shared<const plant::PlantModel>(rig), 1);
  plant.SetSpeed(kTurn * kSpeedHz, 0.0);
  const double period_s = static_cast<double>(rig.config.period_ns) * 1e-9;
  const auto settle = static_cast<int>(std::lround(kSettleS / period_s));
  const auto count = static_cast<int>(std::lround(kTurns / kSpeedHz / period_s));
  plant::PlantCommand command;
  command.bias_current_a = rig.config.bearings.front().magnet.bias_current_a;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = kTurn * kSpeedHz;
  command.acceleration_limit_rad_per_s2 = 1.0;
  std::vector<Complex> orbit;
  orbit.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < settle + count; ++i) {
    const SensorFrame frame = plant.Sample();
    if (i >= settle) orbit.emplace_back(frame.position_m[0], frame.position_m[1]);
    plant.Advance(command);
  }
  return orbit;
}

svg::Panel Panel(const std::vector<Complex>& with, const std::vector<Complex>& without, int most,
                 const char* title) {
  svg::Panel panel{title, "order of the driving wheel (negative: backward)", "um"};
  panel.y_scale = svg::Scale::kLogarithmic;
  const Orders orders{kTurns, most};
  panel.series = {OrderSpectrum(with, orders, "effect", 1),
                  OrderSpectrum(without, orders, "nominal", 0)};
  return panel;
}

}  // namespace

std::vector<svg::Panel> GearPanels(const Pair& rigs) {
  if (rigs.without.config.gears.empty()) {
    throw std::invalid_argument("an effect of teeth needs a rig with gears");
  }
  const auto without = Orbit(rigs.without);
  const auto with = Orbit(rigs.with);
  return {Panel(with, without, kMeshOrders, "full spectrum at 1200 rpm, meshing"),
          Panel(with, without, kNear, "the same about rotation")};
}

}  // namespace levitas::signature
