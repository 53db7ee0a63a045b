// Frequency response of the linear model, with and without an effect.
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "report/signature/signature.hpp"

namespace levitas::signature {
namespace {

using Complex = std::complex<double>;

constexpr double kFirstHz = 10.0;
constexpr double kLastHz = 2000.0;
constexpr int kPoints = 160;
constexpr double kSpeedRadPerS = 2.0 * std::numbers::pi * 50.0;

struct Response {
  std::vector<double> frequency_hz;
  std::vector<Complex> direct, cross;  ///< [m/A]
};

Response Compute(const plant::PlantParameters& rig) {
  const plant::PlantModel model(rig);
  const plant::LinearModel linear = plant::Linearise(model, kSpeedRadPerS);
  const double delay_s = model.delay_samples() * static_cast<double>(rig.config.period_ns) * 1e-9;
  Response response;
  for (int i = 0; i < kPoints; ++i) {
    const double f = kFirstHz * std::pow(kLastHz / kFirstHz, i / (kPoints - 1.0));
    const Complex s(0.0, 2.0 * std::numbers::pi * f);
    Eigen::MatrixXcd pencil = -linear.a.cast<Complex>();
    pencil.diagonal().array() += s;
    const Eigen::VectorXcd state = pencil.partialPivLu().solve(linear.b.col(0).cast<Complex>());
    const Eigen::VectorXcd reading = linear.c * state * std::exp(-s * delay_s);
    response.frequency_hz.push_back(f);
    response.direct.push_back(reading[0]);
    response.cross.push_back(reading[1]);
  }
  return response;
}

svg::Series Line(const std::string& name, const Response& response, bool cross, bool phase,
                 bool effect) {
  svg::Series line;
  line.name = name;
  line.x = response.frequency_hz;
  double unwrapped = 0.0;
  for (const Complex value : cross ? response.cross : response.direct) {
    if (!phase) {
      line.y.push_back(std::abs(value) * 1e6);
      continue;
    }
    // Continuous from point to point: an angle beyond half a turn is not a jump.
    double degrees = std::arg(value) * 180.0 / std::numbers::pi;
    if (!line.y.empty()) degrees += 360.0 * std::round((unwrapped - degrees) / 360.0);
    unwrapped = degrees;
    line.y.push_back(degrees);
  }
  line.colour = svg::Colour(effect ? 1 : 0);
  if (cross) line.dashes = "4 3";
  return line;
}

}  // namespace

std::vector<svg::Panel> ResponsePanels(const Pair& rigs) {
  const Response without = Compute(rigs.without);
  const Response with = Compute(rigs.with);
  svg::Panel gain{"current to reading at 3000 rpm", "Hz", "um/A"};
  gain.x_scale = gain.y_scale = svg::Scale::kLogarithmic;
  svg::Panel phase{"phase", "Hz", "degrees"};
  phase.x_scale = svg::Scale::kLogarithmic;
  gain.series = {Line("nominal", without, false, false, false),
                 Line("effect", with, false, false, true),
                 Line("nominal, x to y", without, true, false, false),
                 Line("effect, x to y", with, true, false, true)};
  phase.series = {Line("nominal", without, false, true, false),
                  Line("effect", with, false, true, true)};
  return {gain, phase};
}

}  // namespace levitas::signature
