// Full spectrum of the driving wheel's shaft, with and without an effect of the teeth.
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "report/signature/orbit.hpp"
#include "report/signature/orders.hpp"
#include "report/signature/signature.hpp"

namespace levitas::signature {
namespace {

// Turns of the driving wheel that are whole ones of a wheel half as fast, too.
constexpr Motion kGearMotion{.speed_hz = 20.0, .turns = 16, .settle_s = 1.5};
constexpr int kNear = 3;           // orders about rotation
constexpr double kLeastUm = 1e-4;  // less is rounding
constexpr int kMeshOrders = 50;    // two harmonics of a mesh of 20 teeth and their neighbours

svg::Panel Empty(const char* title) {
  svg::Panel panel{title, "order of the driving wheel (negative: backward)", "amplitude, µm"};
  panel.y_scale = svg::Scale::kLogarithmic;
  return panel;
}

svg::Panel Both(const Turning& with, const Turning& without, int most, const char* title) {
  svg::Panel panel = Empty(title);
  const Orders orders{kGearMotion.turns, most};
  panel.series = {OrderSpectrum(without.reading_m, orders, "nominal", 0),
                  OrderSpectrum(with.reading_m, orders, "effect", 1)};
  MakeNominal(panel.series[0]);
  return panel;
}

/// The same noise with and without, so that what differs is the effect's alone.
svg::Panel AddedByTeeth(const Turning& with, const Turning& without) {
  svg::Panel panel = Empty("what the effect adds");
  panel.series = {OrderSpectrum(Difference(with.reading_m, without.reading_m),
                                {kGearMotion.turns, kMeshOrders}, "reading", 1)};
  const svg::Range range = svg::Enclose({panel.series[0].y}, svg::Scale::kLogarithmic);
  panel.y_range = svg::Range{kLeastUm, std::max(range.high, 10.0 * kLeastUm)};
  return panel;
}

}  // namespace

std::vector<svg::Panel> GearPanels(const Pair& rigs) {
  if (rigs.without.config.gears.empty()) {
    throw std::invalid_argument("an effect of teeth needs a rig with gears");
  }
  // Geared shafts stand on springs of their own: no law.
  const Turning without = Turn(rigs.without, kGearMotion, {});
  const Turning with = Turn(rigs.with, kGearMotion, {});
  return {Both(with, without, kMeshOrders, "full spectrum at 1200 rpm, meshing"),
          Both(with, without, kNear, "the same about rotation"), AddedByTeeth(with, without)};
}

}  // namespace levitas::signature
