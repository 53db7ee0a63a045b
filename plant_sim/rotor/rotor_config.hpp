#pragma once
// Description of a rotor, for the finite-element model or as a rigid body with given modes. z runs
// along the shaft from the drive end.

#include <cstddef>
#include <optional>
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

/// Deflection of a mode at a place of the shaft.
struct ShapePoint {
  double z_m{};
  double deflection{};  ///< [1] in the scale that the modal mass belongs to
};

/// A bending mode as a measurement or a publication gives it.
struct GivenMode {
  double frequency_hz{};  ///< of the free rotor at rest
  double damping_ratio{};
  double modal_mass_kg{};
  std::vector<ShapePoint> shape;  ///< straight between its points, ascending in z
};

/// An entry of the symmetric gyroscopic matrix of the mass-normalised modes: 0 is the tilt of the
/// rigid body, i the i-th bending mode.
struct GyroscopicEntry {
  std::size_t row{};
  std::size_t column{};  ///< not greater than row
  double ratio{};        ///< [1]: of the whirl's angular frequency per angular speed, as Ip/It
};

/// A rotor known by its rigid body and its modes instead of its drawing.
struct GivenRotor {
  double mass_kg{};
  double transverse_inertia_kg_m2{};  ///< about the centre of mass; 0: it cannot tilt
  double polar_inertia_kg_m2{};       ///< of the tilting rigid body
  double centre_z_m{};                ///< centre of mass
  std::vector<GivenMode> modes;
  std::vector<GyroscopicEntry> gyroscopic;  ///< what is left out is 0; the tilt has Ip/It
};

struct RotorConfig {
  Material material;
  std::vector<Section> sections;
  std::vector<Disc> discs;
  std::vector<Ring> rings;
  double max_element_length_m{};    ///< sections are divided into equal elements not longer
  std::size_t modes_per_plane{};    ///< rigid ones included; 0 keeps all
  double modal_damping_ratio{};     ///< of every flexible mode; rigid modes are undamped
  std::optional<GivenRotor> given;  ///< when there, it is the rotor and nothing above counts
};

}  // namespace levitas::rotor
