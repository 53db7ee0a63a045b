// Full spectrum of the driving wheel's shaft, with and without an effect of the teeth.
#include <complex>
#include <stdexcept>
#include <vector>

#include "report/signature/orbit.hpp"
#include "report/signature/orders.hpp"
#include "report/signature/signature.hpp"

namespace levitas::signature {
namespace {

using Complex = std::complex<double>;

// Turns of the driving wheel that are whole ones of a wheel half as fast, too.
constexpr Motion kMotion{.speed_hz = 20.0, .turns = 16, .settle_s = 1.5};
constexpr int kNear = 3;         // orders about rotation
constexpr int kMeshOrders = 50;  // two harmonics of a mesh of 20 teeth and their neighbours

svg::Panel Panel(const std::vector<Complex>& with, const std::vector<Complex>& without, int most,
                 const char* title) {
  svg::Panel panel{title, "order of the driving wheel (negative: backward)", "um"};
  panel.y_scale = svg::Scale::kLogarithmic;
  const Orders orders{kMotion.turns, most};
  panel.series = {OrderSpectrum(with, orders, "effect", 1),
                  OrderSpectrum(without, orders, "nominal", 0)};
  return panel;
}

}  // namespace

std::vector<svg::Panel> GearPanels(const Pair& rigs) {
  if (rigs.without.config.gears.empty()) {
    throw std::invalid_argument("an effect of teeth needs a rig with gears");
  }
  // Geared shafts stand on springs of their own: no law.
  const auto without = Orbit(rigs.without, kMotion, {});
  const auto with = Orbit(rigs.with, kMotion, {});
  return {Panel(with, without, kMeshOrders, "full spectrum at 1200 rpm, meshing"),
          Panel(with, without, kNear, "the same about rotation")};
}

}  // namespace levitas::signature
