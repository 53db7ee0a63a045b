#include "plant_sim/plant/applied_effects/effect_forces.hpp"

#include <algorithm>
#include <cmath>

#include "plant_sim/effect/coil.hpp"
#include "plant_sim/effect/crack.hpp"
#include "plant_sim/effect/reading.hpp"

namespace levitas::plant {
namespace {

double AxisForce(const magnet::Magnet& m, const MagnetEffects& e, double bias_a, double control_a,
                 double x_m) noexcept {
  const double towards_a = std::clamp(bias_a + control_a, 0.0, m.max_coil_current_a);
  const double away_a = std::clamp(bias_a - control_a, 0.0, m.max_coil_current_a);
  const effect::CoilPair acting = effect::Scaled({towards_a, away_a}, e.gain);
  const double force_n = magnet::ForceOfCoils(
      m,
      e.towards * effect::Saturated(std::abs(acting.towards), e.per_knee_1_per_a, e.knee_exponent),
      e.away * effect::Saturated(std::abs(acting.away), e.per_knee_1_per_a, e.knee_exponent), x_m);
  return force_n + e.stiffness_n_per_m * x_m;
}

/// Deflection, velocity or curvature at a plane.
struct Pair {
  double x{};
  double y{};
};

Pair At(const std::vector<double>& shape, const double* modal) noexcept {
  Pair at;
  const std::size_t modes = shape.size();
  for (std::size_t i = 0; i < modes; ++i) {
    at.x += shape[i] * modal[i];
    at.y += shape[i] * modal[modes + i];
  }
  return at;
}

void Push(const std::vector<double>& shape, double fx_n, double fy_n,
          double* acceleration) noexcept {
  const std::size_t modes = shape.size();
  for (std::size_t i = 0; i < modes; ++i) acceleration[i] += shape[i] * fx_n;
  for (std::size_t i = 0; i < modes; ++i) acceleration[modes + i] += shape[i] * fy_n;
}

// -ratio w^2 conj(q) e^(2j angle): the stiff and the soft axis turn with the rotor.
void AddAnisotropy(const PlantModel& model, const Spin& spin, const double* position,
                   double* acceleration) noexcept {
  const std::size_t modes = model.layout().modes;
  const std::complex<double> turned =
      model.effects().anisotropy * effect::Turned(spin.cosine, spin.sine, 2);
  for (std::size_t i = 0; i < modes; ++i) {
    const double w = model.frequency()[i];
    const double x = position[i];
    const double y = position[modes + i];
    acceleration[i] -= w * w * (turned.real() * x + turned.imag() * y);
    acceleration[modes + i] -= w * w * (turned.imag() * x - turned.real() * y);
  }
}

void AddCrack(const PlantModel& model, const Crack& crack, const Spin& spin, const double* position,
              double* acceleration) noexcept {
  const double cosine = spin.cosine * crack.cosine - spin.sine * crack.sine;
  const double sine = spin.sine * crack.cosine + spin.cosine * crack.sine;
  const double open =
      effect::Opening(cosine, sine, model.gravity_direction_x(), model.gravity_direction_y());
  const Pair bend = At(crack.curvature, position);
  // Summed at every step: an effect that comes with time may move the frequencies.
  const double residual = effect::CurvatureCompliance(crack.curvature, model.frequency());
  const double softening = effect::CrackSoftening(crack.softening_n_m2, open, residual);
  const double across = softening * (cosine * bend.x + sine * bend.y);
  Push(crack.curvature, across * cosine, across * sine, acceleration);
}

}  // namespace

PlaneForce MagnetWithEffects(const BearingModel& bearing, const BearingEffects& effects,
                             const Currents& currents, std::size_t axis, double x_m,
                             double y_m) noexcept {
  // In the magnet's own axes, and back.
  const double c = effects.cosine;
  const double s = effects.sine;
  const auto across_n = [&](std::size_t from) {
    return effects.coupling * currents.control_a[from] *
           magnet::ForcePerCurrent(bearing.magnet, currents.bias_a[from]);
  };
  const double fx_n = AxisForce(bearing.magnet, effects.axis[0], currents.bias_a[axis],
                                currents.control_a[axis], c * x_m + s * y_m) +
                      across_n(axis + 1);
  const double fy_n = AxisForce(bearing.magnet, effects.axis[1], currents.bias_a[axis + 1],
                                currents.control_a[axis + 1], c * y_m - s * x_m) +
                      across_n(axis);
  return {c * fx_n - s * fy_n, s * fx_n + c * fy_n};
}

PlaneForce Rub(const BearingModel& bearing, const BearingEffects& effects, double x_m, double y_m,
               double vx_m_per_s, double vy_m_per_s, double speed_rad_per_s,
               ForceReport& report) noexcept {
  PlaneForce sum;
  for (const support::Touchdown& ring : effects.rubs) {
    if (!support::Touches(ring, x_m, y_m)) continue;
    const auto contact = support::Push(ring, x_m, y_m, vx_m_per_s, vy_m_per_s,
                                       bearing.speed_ratio * speed_rad_per_s);
    sum.x_n += contact.x_n;
    sum.y_n += contact.y_n;
    Report(ring, contact, bearing.speed_ratio, report);
  }
  return sum;
}

void AddEffectForces(const PlantModel& model, const Spin& spin, const double* position,
                     const double* velocity, double* acceleration) noexcept {
  const EffectModel& effects = model.effects();
  for (const OrderForce& force : effects.order_forces) {
    const auto now_n = force.force_n * effect::Turned(spin.cosine, spin.sine, force.order);
    Push(force.shape, now_n.real(), now_n.imag(), acceleration);
  }
  for (const PlaneSpring& spring : effects.springs) {
    const Pair at = At(spring.shape, position);
    Push(spring.shape, -(spring.xx * at.x + spring.xy * at.y),
         -(spring.yx * at.x + spring.yy * at.y), acceleration);
  }
  for (const RotatingDamper& damper : effects.dampers) {
    // -d (r' - j W r)
    const Pair rate = At(damper.shape, velocity);
    const Pair at = At(damper.shape, position);
    const double d = damper.damping_n_s_per_m;
    Push(damper.shape, -d * (rate.x + spin.speed_rad_per_s * at.y),
         -d * (rate.y - spin.speed_rad_per_s * at.x), acceleration);
  }
  const std::size_t modes = model.layout().modes;
  for (std::size_t i = 0; i < effects.bow.size() / 2; ++i) {
    const double real = effects.bow[i];
    const double imaginary = effects.bow[modes + i];
    acceleration[i] += spin.cosine * real - spin.sine * imaginary;
    acceleration[modes + i] += spin.cosine * imaginary + spin.sine * real;
  }
  if (effects.anisotropy != 0.0) AddAnisotropy(model, spin, position, acceleration);
  for (const Crack& crack : effects.cracks) AddCrack(model, crack, spin, position, acceleration);
}

}  // namespace levitas::plant
