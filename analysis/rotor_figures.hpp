#pragma once
// What a rig's one rotor weighs and where: centre of mass, moments of inertia, static load of every
// bearing, and the shapes of its first free bending modes at rest.
//
// Equation   of the rigid shift t and the unit slope s about z = 0, mass matrix M, gyroscopic G:
//              m = t'Mt,  m zc = t'Ms,  It = s'Ms - m zc^2,  Ip = s'Gs
//            load of two bearings at z1, z2 under the weight W = m g:
//              F1 = W (z2 - zc)/(z2 - z1),  F2 = W - F1.  One bearing carries W.
// Shapes     largest deflection 1, positive; nodes of the mesh, places of given shapes included.
// Units      SI; z from the drive end.
// Not done   effects of the rig file; three bearings or more, whose loads depend on the control:
//            these have no load.
// Thread     any; allocates. Failure: std::invalid_argument for a rig of several shafts.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

struct StaticLoad {
  std::string bearing;
  double z_m{};
  std::optional<double> load_n;  ///< along gravity; negative: the bearing holds the rotor down
};

struct ModeShape {
  double frequency_hz{};  ///< at rest
  std::vector<double> z_m;
  std::vector<double> deflection;
};

struct RotorFigures {
  double mass_kg{};
  double centre_z_m{};
  double transverse_inertia_kg_m2{};  ///< about the centre of mass
  double polar_inertia_kg_m2{};
  std::vector<StaticLoad> loads;
  std::vector<ModeShape> shapes;
};

/// With the shapes of the first `modes` bending modes, or as many as the rotor has.
[[nodiscard]] RotorFigures FiguresOf(const plant::PlantConfig& plant, std::size_t modes);

}  // namespace levitas::analysis
