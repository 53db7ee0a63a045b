#pragma once
// Description of a rotor for the finite-element model. z runs along the shaft from the drive end.

#include <cstddef>
#include <vector>

namespace levitas::rotor {

struct Material {
  double young_pa{};
  double poisson{};
  double density_kg_per_m3{};
};

/// A cylindrical piece of shaft; pieces follow one another from z = 0.
struct Section {
  double length_m{};
  double outer_diameter_m{};
  double inner_diameter_m{};
};

/// Rigid disc lumped at z.
struct Disc {
  double z_m{};
  double mass_kg{};
  double diametral_inertia_kg_m2{};
  double polar_inertia_kg_m2{};
};

/// Solid ring bored to the shaft, lumped at z; mass and inertias follow from its geometry.
struct Ring {
  double z_m{};
  double width_m{};
  double bore_m{};
  double outer_diameter_m{};
  double density_kg_per_m3{};
};

struct RotorConfig {
  Material material;
  std::vector<Section> sections;
  std::vector<Disc> discs;
  std::vector<Ring> rings;
  double max_element_length_m{};  ///< sections are divided into equal elements not longer
  std::size_t modes_per_plane{};  ///< rigid ones included; 0 keeps all
  double modal_damping_ratio{};   ///< of every flexible mode; rigid modes are undamped
};

}  // namespace levitas::rotor
