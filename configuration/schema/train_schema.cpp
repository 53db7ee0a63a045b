// Table of geared shafts: shafts, what they stand on, their torsion, and the gears between them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "configuration/schema/schema.hpp"
#include "plant_sim/plant/train_model.hpp"
#include "plant_sim/rotor/lumped_shaft.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

// Where the disc's stiffness comes from: one number without tilt; a simply supported beam; or the
// three numbers of deflection and tilt, in which form it is written.
void DescribeStiffness(Visitor& v, rotor::LumpedShaft& shaft) {
  double span_m{};
  double bending_n_m2{};
  const std::array<Form, 3> forms{
      Form{"stiffness_n_per_m",
           [&] {
             v.Number({"stiffness", kStiffness, 1, 1e12, kRequired,
                       "of the shaft against deflection of a disc that does not tilt"},
                      shaft.kll_n_per_m);
           }},
      Form{"deflection_stiffness_n_per_m, coupling_stiffness_n and tilt_stiffness_n_m",
           [&] {
             v.Number({"deflection_stiffness", kStiffness, 1, 1e12, kRequired,
                       "force per deflection, the tilt held"},
                      shaft.kll_n_per_m);
             v.Number({"coupling_stiffness", kNewton, -1e12, 1e12, kRequired,
                       "force per tilt, and moment per deflection"},
                      shaft.kla_n);
             v.Number({"tilt_stiffness", kNewtonMetre, 1e-6, 1e12, kRequired,
                       "moment per tilt, the deflection held"},
                      shaft.kaa_n_m);
           }},
      Form{"span_mm and bending_stiffness_n_m2", [&] {
             v.Number({"span", kMillimetre, 1, 100000, kRequired,
                       "of a simply supported shaft; the disc sits at z"},
                      span_m);
             v.Number({"bending_stiffness", kBending, 1e-3, 1e12, kRequired, "E I of that shaft"},
                      bending_n_m2);
           }}};
  std::size_t chosen = shaft.tilts ? 1 : 0;
  v.OneOf("the stiffness of the shaft at its disc", forms, chosen);
  shaft.tilts = chosen == 1 || chosen == 2;
  const bool between = shaft.z_m > 0.0 && shaft.z_m < span_m;
  v.RefuseIf(chosen == 2 && span_m > 0.0 && !between, "z_mm",
             "the disc must lie between the ends of the span");
  if (chosen == 2 && between && bending_n_m2 > 0.0) {
    rotor::SetSimplySupported(shaft, span_m, bending_n_m2);
  }
  v.RefuseIf(chosen == 1 && shaft.kla_n * shaft.kla_n >= shaft.kll_n_per_m * shaft.kaa_n_m, "",
             "the three stiffnesses hold no disc: coupling^2 must be below deflection x tilt");
}

void Describe(Visitor& v, rotor::LumpedShaft& shaft) {
  v.Number({"z", kMillimetre, 0, 100000, 0, "place of the disc, the only plane of this shaft"},
           shaft.z_m);
  v.Number({"mass", kKilogram, 1e-6, 1e6, kRequired, "of the disc"}, shaft.mass_kg);
  v.Number({"damping", kDamping, 0, 1e9, 0, "of the deflection, to ground"},
           shaft.damping_n_s_per_m);
  DescribeStiffness(v, shaft);
  v.When(shaft.tilts, "for a disc that tilts", [&] {
    v.Number({"diametral_inertia", kInertia, 1e-12, 1e6, kRequired, "inertia about a diameter, Id"},
             shaft.diametral_inertia_kg_m2);
    v.Number({"polar_inertia", kInertia, 0, 1e6, kRequired, "inertia about the shaft axis, Ip"},
             shaft.polar_inertia_kg_m2);
    v.RefuseIf(shaft.polar_inertia_kg_m2 > 2.0 * shaft.diametral_inertia_kg_m2 * (1 + 1e-9),
               "polar_inertia_kg_m2", "no body has Ip greater than 2 Id");
  });
}

void Describe(Visitor& v, rotor::Support& support) {
  v.Number({"z", kMillimetre, 0, 100000, kRequired, "place on the shaft"}, support.z_m);
  v.Number({"stiffness_x", kStiffness, 0, 1e12, kRequired, "to ground, in x"},
           support.stiffness_x_n_per_m);
  v.Number({"stiffness_y", kStiffness, 0, 1e12, kRequired, "to ground, in y"},
           support.stiffness_y_n_per_m);
  v.Number({"damping_x", kDamping, 0, 1e9, 0, "to ground, in x"}, support.damping_x_n_s_per_m);
  v.Number({"damping_y", kDamping, 0, 1e9, 0, "to ground, in y"}, support.damping_y_n_s_per_m);
}

void Describe(Visitor& v, rotor::TorsionInertia& inertia) {
  v.Name({"name", "of the inertia, for people"}, inertia.name);
  v.Number({"inertia", kInertia, 1e-12, 1e6, kRequired, "about the shaft axis"},
           inertia.inertia_kg_m2);
  v.Number({"stiffness", kTorsion, 0, 1e12, 0, "of the shaft to the next inertia"},
           inertia.stiffness_n_m_per_rad);
  v.Number({"ground_stiffness", kTorsion, 0, 1e12, 0, "of a drive that holds the angle"},
           inertia.ground_stiffness_n_m_per_rad);
  v.Number({"ground_damping", kTorsionDamping, 0, 1e9, 0, "of a drive that holds the angle"},
           inertia.ground_damping_n_m_s_per_rad);
}

void Describe(Visitor& v, rotor::TorsionGauges& gauges) {
  v.Number({"torque_noise_rms", kNewtonMetre, 0, 1e9, 0, "white, of every sample of the torque"},
           gauges.torque_noise_rms_n_m);
  v.Number({"twist_noise_rms", kMicroradian, 0, 1e6, 0, "white, of every sample of the twist"},
           gauges.twist_noise_rms_rad);
}

void DescribeTorsion(Visitor& v, rotor::Shaft& shaft) {
  using rotor::TorsionKind;
  constexpr std::array<std::string_view, 3> kTorsionKinds{"none", "inertias", "beam"};
  auto kind = static_cast<std::size_t>(shaft.torsion.kind);
  v.Choice(
      {"kind", kTorsionKinds, kRequired, "inertias on springs, or the torsion of the beam itself"},
      kind);
  shaft.torsion.kind = static_cast<TorsionKind>(kind);
  v.RefuseIf(shaft.torsion.kind == TorsionKind::kBeam && !shaft.is_beam, "kind",
             "beam is for a shaft described as a beam");
  v.When(shaft.torsion.kind == TorsionKind::kInertias, "with kind: inertias", [&] {
    v.List({"inertias", 1, 100, "one after the other along the shaft"}, shaft.torsion.inertias,
           [&](rotor::TorsionInertia& inertia, std::size_t) { Describe(v, inertia); });
    std::size_t number = shaft.torsion.gear_at + 1;
    v.Integer({"gear_at", 1, 100, 1, "which of them carries the gear, counted from 1"}, number);
    v.RefuseIf(
        number > shaft.torsion.inertias.size() && !shaft.torsion.inertias.empty(), "gear_at",
        fmt::format("found {}, but there are {} inertias", number, shaft.torsion.inertias.size()));
    shaft.torsion.gear_at = number - 1;
    v.OptionalGroup("gauges", "torque and twist between the inertias are measured and recorded",
                    shaft.torsion.gauges.fitted, [&] { Describe(v, shaft.torsion.gauges); });
  });
  v.Number({"damping_ratio", kOne, 0, 0.5, 0, "of every torsional mode with stiffness"},
           shaft.torsion.damping_ratio);
}

// Unbalance is listed with the beam it sits on and kept in one list for the rig.
void DescribeBeam(Visitor& v, plant::PlantConfig& plant, rotor::Shaft& shaft, std::size_t index) {
  std::vector<plant::UnbalanceMass> own;
  const auto here = [index](const plant::UnbalanceMass& mass) { return mass.shaft == index; };
  std::ranges::copy_if(plant.unbalance, std::back_inserter(own), here);
  std::erase_if(plant.unbalance, here);
  Describe(v, shaft.beam, own);
  for (plant::UnbalanceMass& mass : own) mass.shaft = index;
  plant.unbalance.insert(plant.unbalance.end(), own.begin(), own.end());
}

void Describe(Visitor& v, plant::PlantConfig& plant, rotor::Shaft& shaft, std::size_t index) {
  v.Name({"name", "of the shaft, for people"}, shaft.name);
  bool lumped = !shaft.is_beam;
  v.OptionalGroup("lumped", "one rigid disc on an elastic shaft", lumped,
                  [&] { Describe(v, shaft.lumped); });
  v.OptionalGroup("beam", "finite-element description, as that of rotor", shaft.is_beam,
                  [&] { DescribeBeam(v, plant, shaft, index); });
  v.RefuseIf(lumped == shaft.is_beam, "", "give either lumped or beam");
  v.List({"supports", 0, 20, "springs and dampers to ground"}, shaft.supports,
         [&](rotor::Support& support, std::size_t) {
           Describe(v, support);
           RefuseBesideShaft(v, plant, index, support.z_m, "z_mm");
         });
  bool twists = shaft.torsion.kind != rotor::TorsionKind::kNone;
  v.OptionalGroup("torsion", "rotation about the axis, relative to the drive's", twists,
                  [&] { DescribeTorsion(v, shaft); });
}

void Describe(Visitor& v, const plant::PlantConfig& plant, gear::Wheel& wheel) {
  DescribeShaftNumber(v, plant, wheel.shaft);
  v.Number({"z", kMillimetre, 0, 100000, 0, "place on its shaft"}, wheel.z_m);
  RefuseBesideShaft(v, plant, wheel.shaft, wheel.z_m, "z_mm");
  v.Integer({"teeth", 1, 10000, kRequired, "number of teeth"}, wheel.teeth);
  v.Number({"base_radius", kMillimetre, 0, 100000, kRequired, "radius of the base circle"},
           wheel.base_radius_m);
  v.Number({"runout", kMicrometre, 0, 10000, 0, "of the pitch circle against the shaft axis"},
           wheel.runout_m);
  v.Number({"runout_phase", kDegree, -720, 720, 0,
            "its direction in the wheel, from x towards y at angle 0"},
           wheel.runout_phase_rad);
  v.Number({"eccentric_mass", kKilogram, 0, 1e6, 0, "mass that the run-out moves off the axis"},
           wheel.eccentric_mass_kg);
}

void Describe(Visitor& v, gear::Harmonic& harmonic) {
  v.Integer({"order", -100, 100, kRequired, "of the mesh frequency; negative: backward, 0: mean"},
            harmonic.order);
  v.Number({"amplitude", kMicrometre, 0, 10000, kRequired, "amplitude"}, harmonic.amplitude_m);
  v.Number({"phase", kRadian, -100, 100, 0, "phase at angle 0"}, harmonic.phase_rad);
}

void Describe(Visitor& v, const plant::PlantConfig& plant, gear::GearPair& pair) {
  constexpr std::array<std::string_view, 2> kDirections{"isotropic", "line_of_action"};
  v.Name({"name", "of the gear pair"}, pair.name);
  v.Group("driving", "the wheel on the side of the motor",
          [&] { Describe(v, plant, pair.driving); });
  v.Group("driven", "the wheel it turns, backwards", [&] { Describe(v, plant, pair.driven); });
  v.RefuseIf(pair.driving.shaft == pair.driven.shaft, "driven", "must be on another shaft");
  v.Number({"stiffness", kStiffness, 1, 1e12, kRequired, "mean mesh stiffness"},
           pair.stiffness_n_per_m);
  v.Number({"damping", kDamping, 0, 1e9, 0, "mesh damping"}, pair.damping_n_s_per_m);
  v.Number({"pressure_angle", kDegree, 0, 45, 20, "between line of action and common tangent"},
           pair.pressure_angle_rad);
  auto direction = static_cast<std::size_t>(pair.direction);
  v.Choice({"direction", kDirections, "isotropic",
            "what the teeth transmit: the whole relative displacement, or its share along the "
            "line of action"},
           direction);
  pair.direction = static_cast<gear::Direction>(direction);
  v.Number({"driving_torque", kNewtonMetre, 0, 1e9, 0,
            "static, on the driving wheel; positions count from the rest under it"},
           pair.driving_torque_n_m);
  v.RefuseIf(pair.driving_torque_n_m > 0.0 && pair.driving.base_radius_m == 0.0,
             "driving_torque_n_m", "needs the base radius of the driving wheel");
  v.List({"transmission_error", 0, 201, "complex Fourier series over the tooth engagement"},
         pair.transmission_error,
         [&](gear::Harmonic& harmonic, std::size_t) { Describe(v, harmonic); });
}

/// Every shaft must be turned; the numbers of shafts in the gears are in range by now.
void RefuseIdleShafts(Visitor& v, const plant::PlantConfig& plant) {
  std::vector<bool> turned(plant.shafts.size(), false);
  if (!turned.empty()) turned[0] = true;
  for (std::size_t round = 0; round < plant.gears.size(); ++round) {
    for (const gear::GearPair& pair : plant.gears) {
      const std::size_t last = std::max(pair.driving.shaft, pair.driven.shaft);
      if (last < turned.size() && turned[pair.driving.shaft]) turned[pair.driven.shaft] = true;
    }
  }
  const auto idle = std::ranges::find(turned, false);
  v.RefuseIf(idle != turned.end(), "gears",
             fmt::format("shaft {} is turned by no gear", idle - turned.begin() + 1));
}

}  // namespace

void DescribeShaftNumber(Visitor& v, const plant::PlantConfig& plant, std::size_t& shaft) {
  std::size_t number = shaft + 1;
  v.Integer({"shaft", 1, static_cast<std::int64_t>(plant::kMaxShafts), 1,
             "which of the shafts, counted from 1"},
            number);
  v.RefuseIf(number > plant.shafts.size() && !plant.shafts.empty(), "shaft",
             fmt::format("found {}, but the rig has {} shafts", number, plant.shafts.size()));
  shaft = number - 1;
}

void RefuseBesideShaft(Visitor& v, const plant::PlantConfig& plant, std::size_t shaft, double z_m,
                       std::string_view key) {
  if (shaft >= plant.shafts.size()) return;
  const rotor::Shaft& at = plant.shafts[shaft];
  if (at.is_beam) {
    RefuseBeyondShaft(v, at.beam, z_m, key);
  } else {
    v.RefuseIf(std::abs(z_m - at.lumped.z_m) > 1e-9, key,
               fmt::format("a lumped shaft has one plane, that of its disc at {:.6g} mm",
                           at.lumped.z_m * 1e3));
  }
}

void DescribeTrain(Visitor& v, plant::PlantConfig& plant) {
  v.List({"shafts", 0, plant::kMaxShafts,
          "instead of rotor: shafts coupled by gears; the drive turns the first"},
         plant.shafts,
         [&](rotor::Shaft& shaft, std::size_t index) { Describe(v, plant, shaft, index); });
  v.List({"gears", 0, plant::kMaxGears, "between the shafts"}, plant.gears,
         [&](gear::GearPair& pair, std::size_t) { Describe(v, plant, pair); });
  v.RefuseIf(!plant.gears.empty() && plant.shafts.empty(), "gears", "need shafts");
  RefuseIdleShafts(v, plant);
}

}  // namespace levitas::configuration
