#include "plant_sim/rotor/torsion_springs.hpp"

namespace levitas::rotor {

std::vector<TorsionSpring> TorsionSprings(const std::vector<Shaft>& shafts) {
  std::vector<TorsionSpring> springs;
  std::size_t before = 0;  // inertias of the shafts before
  for (std::size_t s = 0; s < shafts.size(); ++s) {
    const Torsion& torsion = shafts[s].torsion;
    if (torsion.kind != TorsionKind::kInertias) continue;
    const auto& all = torsion.inertias;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      springs.push_back({s, before + i, all[i].name + " to " + all[i + 1].name,
                         all[i].stiffness_n_m_per_rad, torsion.gauges});
    }
    before += all.size();
  }
  return springs;
}

std::vector<TorsionSpring> GaugedSprings(const std::vector<Shaft>& shafts) {
  std::vector<TorsionSpring> springs = TorsionSprings(shafts);
  std::erase_if(springs, [](const TorsionSpring& spring) { return !spring.gauges.fitted; });
  return springs;
}

}  // namespace levitas::rotor
