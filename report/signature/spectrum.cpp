// Full spectrum and orbit of the levitated, turning rotor, with and without an effect.
#include <complex>
#include <vector>

#include "plant_sim/plant/plant.hpp"
#include "report/signature/orbit.hpp"
#include "report/signature/orders.hpp"
#include "report/signature/signature.hpp"

namespace levitas::signature {
namespace {

using Complex = std::complex<double>;

// At a speed of which 50 Hz of the mains is no multiple.
constexpr Motion kMotion{.speed_hz = 40.0, .turns = 16, .settle_s = 1.0};
constexpr int kMostOrders = 4;

/// A stiff spring, a damper of 3 A s/m, and an integrator that carries the weight: holds the
/// shipped rotor in the centre at every speed.
class Holding {
 public:
  explicit Holding(double period_s) : period_s_(period_s) {}

  void operator()(const SensorFrame& frame, plant::PlantCommand& command) {
    for (std::size_t axis = 0; axis < frame.axes; ++axis) {
      const double y_m = frame.position_m[axis];  // the shipped rig has no inverted probe or coil
      carried_a_[axis] -= 2e4 * y_m * period_s_;
      command.control_current_a[axis] =
          carried_a_[axis] - 4000.0 * y_m - 3.0 * (y_m - last_m_[axis]) / period_s_;
      last_m_[axis] = y_m;
    }
  }

 private:
  double period_s_;
  AxisArray last_m_{};
  AxisArray carried_a_{};
};

Turning Held(const plant::PlantParameters& rig) {
  return Turn(rig, kMotion, Holding(static_cast<double>(rig.config.period_ns) * 1e-9));
}

svg::Series Path(const std::vector<Complex>& orbit, std::size_t colour) {
  svg::Series series;
  series.colour = svg::Colour(colour);
  const std::size_t two_turns = 2 * orbit.size() / static_cast<std::size_t>(kMotion.turns);
  for (std::size_t i = 0; i < two_turns; i += 2) {
    series.x.push_back(orbit[i].real() * 1e6);
    series.y.push_back(orbit[i].imag() * 1e6);
  }
  return series;
}

/// The same noise with and without, so that what differs is the effect's alone.
svg::Panel Added(const Turning& with, const Turning& without) {
  svg::Panel panel{"what the effect adds", "order of rotation", "amplitude, µm or mA"};
  panel.y_scale = svg::Scale::kLogarithmic;
  const Orders micrometres{kMotion.turns, kMostOrders, 1e6};
  const Orders milliamperes{kMotion.turns, kMostOrders, 1e3};
  panel.series = {
      OrderSpectrum(Difference(with.reading_m, without.reading_m), micrometres, "reading, µm", 1),
      OrderSpectrum(Difference(with.current_a, without.current_a), milliamperes,
                    "control current, mA", 2)};
  panel.series[1].dashes = "4 3";
  return panel;
}

}  // namespace

std::vector<svg::Panel> SpectrumPanels(const Pair& rigs) {
  const Turning without = Held(rigs.without);
  const Turning with = Held(rigs.with);
  svg::Panel spectrum{"full spectrum at 2400 rpm", "order of rotation (negative: backward)",
                      "amplitude, µm"};
  spectrum.y_scale = svg::Scale::kLogarithmic;
  const Orders orders{kMotion.turns, kMostOrders};
  spectrum.series = {OrderSpectrum(without.reading_m, orders, "nominal", 0),
                     OrderSpectrum(with.reading_m, orders, "effect", 1)};
  MakeNominal(spectrum.series[0]);
  svg::Panel path{"orbit, two turns", "x, µm", "y, µm"};
  path.same_scale = true;
  path.series = {Path(without.reading_m, 0), Path(with.reading_m, 1)};
  MakeNominal(path.series[0]);
  return {spectrum, Added(with, without), path};
}

}  // namespace levitas::signature
