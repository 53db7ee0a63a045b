// Force of a magnet over the commanded current, the rotor held in the centre.
#include <cmath>
#include <numbers>

#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "report/signature/signature.hpp"

namespace levitas::signature {
namespace {

constexpr double kAmplitudeOfBias = 0.9;
constexpr double kFrequencyHz = 50.0;

/// One settled turn of a sine of current.
svg::Series Loop(const plant::PlantParameters& rig, const std::string& name, std::size_t colour) {
  plant::Plant plant(std::make_shared<const plant::PlantModel>(rig), 1);
  const double bias_a = rig.config.bearings.front().magnet.bias_current_a;
  const auto turn = static_cast<int>(std::lround(1e9 / kFrequencyHz) / rig.config.period_ns);
  svg::Series series;
  series.name = name;
  series.colour = svg::Colour(colour);
  for (int i = 0; i <= 2 * turn; ++i) {
    plant::PlantCommand command;
    command.bias_current_a = bias_a;
    const double current_a =
        kAmplitudeOfBias * bias_a * std::sin(2.0 * std::numbers::pi * i / turn);
    command.control_current_a[0] = current_a;
    plant.Advance(command);
    for (std::size_t s = 0; s < plant.layout().coil_current; ++s) plant.mutable_state()[s] = 0.0;
    if (i < turn || i % 2 == 1) continue;
    series.x.push_back(current_a);
    series.y.push_back(plant.MagnetForce()[0]);
  }
  return series;
}

}  // namespace

std::vector<svg::Panel> ForcePanels(const Pair& rigs) {
  svg::Panel panel{"force of one axis, 50 Hz", "commanded current, A", "force, N"};
  panel.series = {Loop(rigs.without, "nominal", 0), Loop(rigs.with, "effect", 1)};
  MakeNominal(panel.series[0]);
  svg::Panel difference{"effect minus nominal", "commanded current, A", "change of force, N"};
  svg::Series line = panel.series[1];
  line.name.clear();
  for (std::size_t i = 0; i < line.y.size(); ++i) line.y[i] -= panel.series[0].y[i];
  difference.series = {line};
  return {panel, difference};
}

}  // namespace levitas::signature
