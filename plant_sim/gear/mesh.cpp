#include "plant_sim/gear/mesh.hpp"

#include <cmath>
#include <numbers>

namespace levitas::gear {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Share of half an engagement over which the sliding direction turns at the pitch point.
constexpr double kPitchPointWidth = 0.02;

// Hann window over one pitch to either side of the tooth: neighbours share the load there.
double CrackWindow(double wheel_rad, int tooth, int teeth) noexcept {
  const double pitches = wheel_rad / kTurn * teeth - tooth;
  const double away = pitches - teeth * std::round(pitches / teeth);
  if (std::abs(away) >= 1.0) return 0.0;
  return 0.5 * (1.0 + std::cos(std::numbers::pi * away));
}

// Of the sliding velocity on the flank: -1 before the pitch point, +1 behind it, (G6).
double SlidingSign(const Vector& mesh) noexcept {
  const double place = std::atan2(mesh.y, mesh.x) / std::numbers::pi;  // -1 .. 1, pitch point 0
  return place / std::sqrt(place * place + kPitchPointWidth * kPitchPointWidth);
}

}  // namespace

double StiffnessFactor(const MeshLaw& law, const Engagement& at) noexcept {
  double factor = 1.0;
  if (!law.variation.empty()) {
    const double mesh_rad = std::atan2(at.mesh.y, at.mesh.x);
    for (const StiffnessHarmonic& h : law.variation) {
      factor += h.relative_amplitude * std::cos(h.order * mesh_rad + h.phase_rad);
    }
  }
  for (const ToothCrack& crack : law.cracks) {
    const double wheel_rad = crack.on_driven ? at.driven_rad : at.driving_rad;
    const int teeth = crack.on_driven ? law.driven_teeth : law.driving_teeth;
    factor *= 1.0 - crack.depth * CrackWindow(wheel_rad, crack.tooth, teeth);
  }
  return factor;
}

Vector LineOfAction(double pressure_angle_rad) noexcept {
  return {std::sin(pressure_angle_rad), std::cos(pressure_angle_rad)};
}

Vector MeshForce(const MeshLaw& law, const Engagement& at, const Vector& delta_m,
                 const Vector& rate_m_per_s) noexcept {
  const Vector& n = law.normal;
  Vector seen_m = delta_m;
  Vector rate = rate_m_per_s;
  if (law.direction == Direction::kLineOfAction) {
    seen_m = Dot(delta_m, n) * n;
    rate = Dot(rate_m_per_s, n) * n;
  }
  const double k = law.stiffness_n_per_m * StiffnessFactor(law, at);
  const bool loaded = law.preload_n > 0.0;
  const double h = law.half_backlash_m;
  if (loaded) seen_m = seen_m + (law.preload_n / law.stiffness_n_per_m + h) * n;
  if (h > 0.0) {
    const double reach_m = std::sqrt(Dot(seen_m, seen_m));
    if (reach_m <= h) return -law.preload_n * n;  // the teeth do not touch, (G4)
    seen_m = (1.0 - h / reach_m) * seen_m;
  }
  Vector force = k * seen_m + law.damping_n_s_per_m * rate;
  // Teeth with room to part only push: oil and impact losses slow them, they hold nothing back.
  if (h > 0.0 && Dot(force, seen_m) <= 0.0) return -law.preload_n * n;  // (G4)
  if (law.friction > 0.0) {
    const double normal_n = std::abs(Dot(force, n));
    force = force + (law.friction * normal_n * SlidingSign(at.mesh)) * Vector{-n.y, n.x};
  }
  return force - law.preload_n * n;
}

LinearMesh Linearise(const MeshLaw& law) noexcept {
  const double h = law.half_backlash_m;
  const double rest_m = law.preload_n > 0.0 ? law.preload_n / law.stiffness_n_per_m + h : 0.0;
  if (h > 0.0 && rest_m <= h) return {};  // the gears stand within the gap
  LinearMesh linear{law.stiffness_n_per_m, 0.0, law.damping_n_s_per_m, 0.0};
  if (law.direction == Direction::kIsotropic) {
    linear.tangential_n_per_m = law.stiffness_n_per_m * (h > 0.0 ? 1.0 - h / rest_m : 1.0);
    linear.tangential_n_s_per_m = law.damping_n_s_per_m;
  }
  return linear;
}

}  // namespace levitas::gear
