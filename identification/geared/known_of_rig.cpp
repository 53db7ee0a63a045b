#include <cmath>

#include "common/problem.hpp"
#include "identification/geared/elastic_of_rig.hpp"
#include "identification/geared/record_lines.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::identification {
namespace {

ShaftKnown Shaft(const configuration::RigFile& rig, const plant::PlantModel& model,
                 const gear::Wheel& wheel, double ratio) {
  const rotor::Shaft& shaft = rig.plant.shafts[wheel.shaft];
  if (IsElastic(shaft)) {
    ShaftKnown elastic = ElasticOfRig(rig, model, wheel);
    elastic.ratio = ratio;
    return elastic;
  }
  const rotor::LumpedShaft& lumped = shaft.lumped;
  ShaftKnown known{lumped.mass_kg, lumped.damping_n_s_per_m, lumped.kll_n_per_m};
  known.ratio = ratio;
  if (lumped.tilts) {
    known.coupling_n = lumped.kla_n;
    known.tilt_stiffness_n_m = lumped.kaa_n_m;
    known.diametral_kg_m2 = lumped.diametral_inertia_kg_m2;
    known.polar_kg_m2 = lumped.polar_inertia_kg_m2;
  }
  return known;
}

void RefuseOtherRigs(const configuration::RigFile& rig) {
  const plant::PlantConfig& plant = rig.plant;
  const bool pair = plant.gears.size() == 1 && plant.shafts.size() == 2 &&
                    plant.bearings.size() == 2 &&
                    plant.bearings[0].shaft != plant.bearings[1].shaft;
  if (!pair) {
    throw BadInput(rig.numbers.name +
                   ": full spectrum needs one gear pair on two shafts with a magnetic bearing each "
                   "(as geared_rotor_4dof)");
  }
  if (plant.gears.front().direction != gear::Direction::kIsotropic) {
    throw BadInput(rig.numbers.name +
                   ": full spectrum takes teeth that transmit the whole displacement; "
                   "gears[0].direction is line_of_action, allowed isotropic");
  }
}

}  // namespace

GearedKnown KnownOfRig(const configuration::RigFile& rig) {
  RefuseOtherRigs(rig);
  const gear::GearPair& pair = rig.plant.gears.front();
  const plant::PlantModel model(rig.plant);
  GearedKnown known;
  known.pinion = Shaft(rig, model, pair.driving, 1.0);
  known.gear =
      Shaft(rig, model, pair.driven, -static_cast<double>(pair.driving.teeth) / pair.driven.teeth);
  for (std::size_t b = 0; b < 2; ++b) {
    const plant::BearingConfig& bearing = rig.plant.bearings[b];
    const magnet::Magnet magnet{bearing.magnet.force_constant_n_m2_per_a2, bearing.magnet.gap_m,
                                bearing.magnet.max_coil_current_a};
    ShaftKnown& shaft = bearing.shaft == pair.driving.shaft ? known.pinion : known.gear;
    shaft.ki_n_per_a = magnet::ForcePerCurrent(magnet, bearing.magnet.bias_current_a);
    shaft.ks_n_per_m = magnet::NegativeStiffness(magnet, bearing.magnet.bias_current_a);
  }
  const auto& modes = model.parameters().torsion;
  const Eigen::Index twists = modes.frequency_rad_per_s.size();
  if (twists == 0) return known;
  TorsionKnown torsion;
  const plant::MeshModel& mesh = model.train().meshes.front();
  torsion.normal = {mesh.law.normal.x, mesh.law.normal.y};
  torsion.frequency_rad_per_s = modes.frequency_rad_per_s;
  torsion.damping_ratio = modes.damping_ratio;
  torsion.twist_m = Eigen::Map<const Eigen::VectorXd>(mesh.twist.data(), twists);
  torsion.damping_1_per_s = Eigen::MatrixXd::Zero(twists, twists);
  for (const plant::TwistDamper& damper : model.train().dampers) {
    const Eigen::Map<const Eigen::VectorXd> shape(damper.twist.data(), twists);
    torsion.damping_1_per_s += damper.damping_n_m_s_per_rad * shape * shape.transpose();
  }
  known.torsion = torsion;
  return known;
}

}  // namespace levitas::identification
