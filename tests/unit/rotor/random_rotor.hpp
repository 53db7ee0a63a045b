#pragma once
// Rotors drawn from a seed, and their mass and inertia by the formulas of solid bodies.

#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "plant_sim/rotor/rotor_config.hpp"

namespace levitas::rotor {

/// A stepped, partly hollow steel shaft of 2 to 5 pieces with 1 to 3 discs and 0 to 2 rings.
[[nodiscard]] inline RotorConfig RandomRotor(std::uint64_t seed) {
  Random random(seed);
  const auto between = [&random](double a, double b) { return a + (b - a) * random.Uniform(); };
  RotorConfig config;
  config.material = {between(7e10, 2.2e11), between(0.2, 0.4), between(2700.0, 8500.0)};
  double length_m = 0.0;
  for (std::uint64_t left = 2 + random.Bits() % 4; left > 0; --left) {
    const double outer_m = between(0.01, 0.05);
    const double inner_m = random.Uniform() < 0.5 ? 0.0 : outer_m * between(0.1, 0.7);
    config.sections.push_back({between(0.05, 0.2), outer_m, inner_m});
    length_m += config.sections.back().length_m;
  }
  for (std::uint64_t left = 1 + random.Bits() % 3; left > 0; --left) {
    config.discs.push_back(
        {length_m * random.Uniform(), between(0.1, 3.0), between(1e-5, 5e-3), between(1e-5, 8e-3)});
  }
  for (std::uint64_t left = random.Bits() % 3; left > 0; --left) {
    config.rings.push_back({length_m * random.Uniform(), between(0.005, 0.03), 0.05,
                            between(0.06, 0.12), between(2700.0, 8500.0)});
  }
  config.max_element_length_m = between(0.02, 0.06);
  config.modal_damping_ratio = between(0.0, 0.01);
  return config;
}

struct RigidBody {
  double mass_kg{};
  double first_moment_kg_m{};  ///< about z = 0
  double transverse_kg_m2{};   ///< about a diameter at z = 0
  double polar_kg_m2{};        ///< about the axis of rotation
  [[nodiscard]] double CentreM() const { return first_moment_kg_m / mass_kg; }
  [[nodiscard]] double TransverseAtCentreKgM2() const {
    return transverse_kg_m2 - first_moment_kg_m * first_moment_kg_m / mass_kg;
  }
};

inline void AddCylinder(RigidBody& body, double centre_m, double length_m, double outer_m,
                        double inner_m, double density_kg_per_m3) {
  const double squares = (outer_m * outer_m + inner_m * inner_m) / 4.0;
  const double mass = density_kg_per_m3 * std::numbers::pi / 4.0 *
                      (outer_m * outer_m - inner_m * inner_m) * length_m;
  body.mass_kg += mass;
  body.first_moment_kg_m += mass * centre_m;
  body.transverse_kg_m2 +=
      mass * (centre_m * centre_m + squares / 4.0 + length_m * length_m / 12.0);
  body.polar_kg_m2 += mass * squares / 2.0;
}

[[nodiscard]] inline RigidBody AsRigidBody(const RotorConfig& config) {
  RigidBody body;
  double start_m = 0.0;
  for (const auto& s : config.sections) {
    AddCylinder(body, start_m + s.length_m / 2.0, s.length_m, s.outer_diameter_m,
                s.inner_diameter_m, config.material.density_kg_per_m3);
    start_m += s.length_m;
  }
  for (const auto& r : config.rings) {
    AddCylinder(body, r.z_m, r.width_m, r.outer_diameter_m, r.bore_m, r.density_kg_per_m3);
  }
  for (const auto& d : config.discs) {
    body.mass_kg += d.mass_kg;
    body.first_moment_kg_m += d.mass_kg * d.z_m;
    body.transverse_kg_m2 += d.mass_kg * d.z_m * d.z_m + d.diametral_inertia_kg_m2;
    body.polar_kg_m2 += d.polar_inertia_kg_m2;
  }
  return body;
}

}  // namespace levitas::rotor
