#include "identification/geared/elastic_of_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "identification/geared/elastic_shaft.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

void RefuseWhatOnePlaneDoesNotTell(const configuration::RigFile& rig, const gear::Wheel& wheel) {
  const rotor::Shaft& shaft = rig.plant.shafts[wheel.shaft];
  const std::string at = fmt::format("{}: shaft {}: ", rig.numbers.name, shaft.name);
  if (shaft.is_beam && shaft.supports.empty()) {
    throw BadInput(at + "no supports; full spectrum needs a shaft that stands without its magnet");
  }
  for (const rotor::Support& support : shaft.supports) {
    if (support.stiffness_x_n_per_m == support.stiffness_y_n_per_m &&
        support.damping_x_n_s_per_m == support.damping_y_n_s_per_m) {
      continue;
    }
    throw BadInput(at +
                   fmt::format("the support at z = {:.6g} mm is not alike in x and y: forward and "
                               "backward lines are not told apart",
                               1e3 * support.z_m));
  }
  for (const plant::UnbalanceMass& mass : rig.plant.unbalance) {
    if (mass.shaft != wheel.shaft || mass.moment_kg_m == 0.0) continue;
    throw BadInput(at +
                   fmt::format("unbalance at z = {:.6g} mm: a second force on the 1x line that "
                               "one plane of probes does not tell from the run-out's; balance "
                               "the shaft and leave it out",
                               1e3 * mass.z_m));
  }
  if (wheel.eccentric_mass_kg <= 0.0) {
    throw BadInput(at +
                   "its gear needs eccentric_mass_kg > 0, the mass that runs out with the teeth");
  }
}

/// Modes that move any place of the shaft.
std::vector<Index> ModesOf(const rotor::ModalRotor& all, std::size_t shaft) {
  std::vector<Index> own;
  for (Index mode = 0; mode < all.shapes.cols(); ++mode) {
    for (Index node = 0; node < all.shapes.rows(); ++node) {
      const bool here = all.node_shaft[static_cast<std::size_t>(node)] == shaft;
      if (!here || (all.shapes(node, mode) == 0.0 && all.slopes(node, mode) == 0.0)) continue;
      own.push_back(mode);
      break;
    }
  }
  return own;
}

Eigen::VectorXd Own(const Eigen::RowVectorXd& shape, const std::vector<Index>& own) {
  return shape(own).transpose();
}

}  // namespace

bool IsElastic(const rotor::Shaft& shaft) { return shaft.is_beam || !shaft.supports.empty(); }

ShaftKnown ElasticOfRig(const configuration::RigFile& rig, const plant::PlantModel& model,
                        const gear::Wheel& wheel) {
  RefuseWhatOnePlaneDoesNotTell(rig, wheel);
  const rotor::ModalRotor& all = model.parameters().modes;
  const std::vector<Index> own = ModesOf(all, wheel.shaft);
  const auto bearing =
      std::ranges::find(rig.plant.bearings, wheel.shaft, &plant::BearingConfig::shaft);
  ElasticShaft e;
  const Eigen::VectorXd frequency = all.frequency_rad_per_s(own);
  const Eigen::VectorXd damping = all.damping_ratio(own);
  e.stiffness_1_per_s2 = frequency.cwiseAbs2().asDiagonal();
  e.damping_1_per_s = (2.0 * damping.cwiseProduct(frequency)).asDiagonal();
  e.gyroscopic = all.gyroscopic(own, own);
  for (const plant::SupportModel& support : model.train().supports) {
    const Eigen::Map<const Eigen::RowVectorXd> shape(support.shape.data(), all.shapes.cols());
    const Eigen::VectorXd at = Own(shape, own);
    e.stiffness_1_per_s2 += support.stiffness_x_n_per_m * at * at.transpose();
    e.damping_1_per_s += support.damping_x_n_s_per_m * at * at.transpose();
  }
  e.gear_z_m = wheel.z_m;
  e.magnet_z_m = bearing->actuator_z_m;
  e.probe_z_m = bearing->sensor_z_m;
  e.gear = Own(all.ShapeAt(e.gear_z_m, wheel.shaft), own);
  e.magnet = Own(all.ShapeAt(e.magnet_z_m, wheel.shaft), own);
  e.probe = Own(all.ShapeAt(e.probe_z_m, wheel.shaft), own);
  ShaftKnown known;
  known.mass_kg = wheel.eccentric_mass_kg;
  known.elastic = std::make_shared<const ElasticShaft>(std::move(e));
  known.stiffness_n_per_m = 1.0 / ReceptancesOf(known, {}).magnet.real();
  return known;
}

}  // namespace levitas::identification
