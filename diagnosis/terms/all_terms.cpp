// The lists of terms put together, for one rotor or for geared shafts.

#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {

std::vector<Term> AllTerms(const RigView& rig, const Tolerances& tolerances,
                           double largest_orbit_m) {
  std::vector<Term> all;
  const auto add = [&all](const std::vector<Term>& group) {
    all.insert(all.end(), group.begin(), group.end());
  };
  add(MagnetTerms(rig, tolerances));
  add(MagnetMemoryTerms(rig));
  add(TimingTerms(rig, tolerances));
  add(SensorTerms(rig, tolerances));
  if (rig.geared()) {
    // What refers to the modes and planes of one rotor has no place here.
    add(RotatingTerms(rig, tolerances));
    add(GearTerms(rig, tolerances));
    return all;
  }
  add(RotorTerms(rig, tolerances));
  add(RotatingTerms(rig, tolerances));
  add(CrackTerms(rig));
  add(ExternalTerms(rig, tolerances, largest_orbit_m));
  return all;
}

}  // namespace levitas::diagnosis
