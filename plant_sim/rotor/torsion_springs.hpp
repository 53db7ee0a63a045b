#pragma once
// The springs between the torsional inertias of a rig's shafts, one after the other along each.
//
// Order    shaft by shaft, as TrainModel::inertias lists the inertias; all records of gauges have
//          the order of the springs that gauges measure.
// Thread   any; allocates. Failure: none; a shaft whose torsion is no line of inertias has none.

#include <cstddef>
#include <string>
#include <vector>

#include "plant_sim/rotor/shaft_config.hpp"

namespace levitas::rotor {

struct TorsionSpring {
  std::size_t shaft{};
  std::size_t inertia{};  ///< its near end, counted over all shafts; the far end is the next one
  std::string name;       ///< "motor to pinion"
  double stiffness_n_m_per_rad{};
  TorsionGauges gauges;
};

[[nodiscard]] std::vector<TorsionSpring> TorsionSprings(const std::vector<Shaft>& shafts);
/// Those that gauges measure.
[[nodiscard]] std::vector<TorsionSpring> GaugedSprings(const std::vector<Shaft>& shafts);

}  // namespace levitas::rotor
