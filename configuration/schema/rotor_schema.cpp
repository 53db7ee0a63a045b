// Table of a rotor: shaft, discs, rings, unbalance.
#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "configuration/schema/schema.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

constexpr double kMaxElements = 1000;  // dense matrices: 1000 take a minute, 10 000 all memory

/// Elements of the sections alone; planes and discs inside a section may add a few.
double CountElements(const rotor::RotorConfig& rotor) {
  double count = 0.0;
  for (const rotor::Section& section : rotor.sections) {
    const double pieces = std::ceil(section.length_m / rotor.max_element_length_m - 1e-9);
    count += pieces < 1.0 ? 1.0 : pieces;  // NaN, of a field that was refused, stays NaN
  }
  return count;
}

void Describe(Visitor& v, rotor::Material& material) {
  v.Number({"young", kGigapascal, 0.1, 2000, kRequired, "Young's modulus of the shaft"},
           material.young_pa);
  v.Number({"poisson", kOne, 0, 0.49, kRequired, "Poisson's ratio of the shaft"}, material.poisson);
  v.Number({"density", kDensity, 100, 100000, kRequired,
            "density of the shaft; more than a metal has where it stands for parts around it"},
           material.density_kg_per_m3);
}

void Describe(Visitor& v, rotor::Section& section) {
  v.Number({"length", kMillimetre, 0.01, 20000, kRequired, "length of this piece of shaft"},
           section.length_m);
  v.Number({"outer_diameter", kMillimetre, 0.1, 5000, kRequired, "outer diameter"},
           section.outer_diameter_m);
  v.Number({"inner_diameter", kMillimetre, 0, 5000, 0, "diameter of the bore, 0 for a solid shaft"},
           section.inner_diameter_m);
  v.RefuseIf(section.inner_diameter_m >= section.outer_diameter_m, "inner_diameter_mm",
             "the bore must be smaller than the outer diameter");
}

void Describe(Visitor& v, rotor::Disc& disc) {
  v.Number({"z", kMillimetre, 0, 100000, kRequired, "place, from the drive end of the shaft"},
           disc.z_m);
  v.Number({"mass", kKilogram, 0, 100000, kRequired, "mass"}, disc.mass_kg);
  v.Number({"diametral_inertia", kInertia, 0, 1e6, kRequired, "inertia about a diameter, Id"},
           disc.diametral_inertia_kg_m2);
  v.Number({"polar_inertia", kInertia, 0, 1e6, kRequired, "inertia about the shaft axis, Ip"},
           disc.polar_inertia_kg_m2);
  // Ip = sum m r^2 of a body of revolution is at most 2 Id (equal for a disc without thickness).
  v.RefuseIf(disc.polar_inertia_kg_m2 > 2.0 * disc.diametral_inertia_kg_m2 * (1 + 1e-9),
             "polar_inertia_kg_m2", "no body has Ip greater than 2 Id");
}

void Describe(Visitor& v, rotor::Ring& ring) {
  v.Number({"z", kMillimetre, 0, 100000, kRequired, "place of the middle, from the drive end"},
           ring.z_m);
  v.Number({"width", kMillimetre, 0.01, 20000, kRequired, "axial width"}, ring.width_m);
  v.Number({"bore", kMillimetre, 0, 5000, kRequired, "inner diameter (the shaft's)"}, ring.bore_m);
  v.Number({"outer_diameter", kMillimetre, 0.1, 10000, kRequired, "outer diameter"},
           ring.outer_diameter_m);
  v.Number({"density", kDensity, 100, 30000, kRequired, "density"}, ring.density_kg_per_m3);
  v.RefuseIf(ring.bore_m >= ring.outer_diameter_m, "bore_mm",
             "the bore must be smaller than the outer diameter");
}

void Describe(Visitor& v, plant::UnbalanceMass& mass) {
  v.Number({"z", kMillimetre, 0, 100000, kRequired, "place, from the drive end"}, mass.z_m);
  v.Number({"moment", kGramMillimetre, 0, 1e9, kRequired, "mass times eccentricity"},
           mass.moment_kg_m);
  v.Number({"phase", kDegree, -360, 360, 0, "direction in the rotor, from x towards y at angle 0"},
           mass.phase_rad);
}

void Describe(Visitor& v, rotor::GivenMode& mode) {
  v.Number({"frequency", kHertz, 0.01, 1e6, kRequired, "of the free rotor at rest"},
           mode.frequency_hz);
  v.Number({"damping_ratio", kOne, 0, 0.5, kRequired, "damping ratio"}, mode.damping_ratio);
  v.Number({"modal_mass", kKilogram, 1e-9, 1e9, kRequired, "with the shape as given here"},
           mode.modal_mass_kg);
  double last_m = -1.0;
  v.List(
      {"shape", 1, 1000, "straight between these points, ascending along the shaft"}, mode.shape,
      [&](rotor::ShapePoint& point, std::size_t) {
        v.Number({"z", kMillimetre, 0, 100000, kRequired, "place on the shaft"}, point.z_m);
        v.RefuseIf(point.z_m <= last_m, "z_mm", "must be greater than that of the point before");
        last_m = point.z_m;
        v.Number({"deflection", kOne, -1e6, 1e6, kRequired, "of the mode here"}, point.deflection);
      });
}

// A row without a column for the tilt is refused, as is an entry that stands twice: one of them
// would be lost without a word.
void DescribeGyroscopic(Visitor& v, rotor::GivenRotor& rotor) {
  const auto modes = static_cast<std::int64_t>(rotor.modes.size());
  std::set<std::pair<std::size_t, std::size_t>> given;
  v.List({"gyroscopic", 0, 5000, "entries of the symmetric gyroscopic matrix; left out: 0"},
         rotor.gyroscopic, [&](rotor::GyroscopicEntry& entry, std::size_t) {
           v.Integer({"row", 1, 98, kRequired, "bending mode, from the first on"}, entry.row);
           v.Integer({"column", 0, 98, kRequired, "0: tilt of the rigid body; else a bending mode"},
                     entry.column);
           v.Number({"ratio", kOne, -100, 100, kRequired,
                     "of mass-normalised modes, as Ip/It is of the rigid body"},
                    entry.ratio);
           v.RefuseIf(static_cast<std::int64_t>(entry.row) > modes, "row",
                      fmt::format("found {}, but there are {} modes", entry.row, modes));
           v.RefuseIf(entry.column > entry.row, "column",
                      "greater than row: the matrix is symmetric, give its lower half");
           v.RefuseIf(entry.column == 0 && rotor.transverse_inertia_kg_m2 == 0.0, "column",
                      "0, but this rotor cannot tilt: its transverse_inertia is 0");
           v.RefuseIf(!given.insert({entry.row, entry.column}).second, "row",
                      "this entry has been given already");
         });
}

void Describe(Visitor& v, rotor::GivenRotor& rotor) {
  v.Number({"mass", kKilogram, 1e-6, 100000, kRequired, "of the rotor"}, rotor.mass_kg);
  v.Number({"transverse_inertia", kInertia, 0, 1e6, kRequired,
            "about a diameter through the centre of mass; 0: it cannot tilt"},
           rotor.transverse_inertia_kg_m2);
  v.Number({"polar_inertia", kInertia, 0, 1e6, kRequired, "about the shaft axis"},
           rotor.polar_inertia_kg_m2);
  v.RefuseIf(rotor.polar_inertia_kg_m2 > 2.0 * rotor.transverse_inertia_kg_m2 * (1 + 1e-9) &&
                 rotor.transverse_inertia_kg_m2 > 0.0,
             "polar_inertia_kg_m2", "no body has Ip greater than 2 It");
  v.Number({"centre_z", kMillimetre, 0, 100000, kRequired, "place of the centre of mass"},
           rotor.centre_z_m);
  v.List({"modes", 0, 98, "bending modes, the rigid body's excluded"}, rotor.modes,
         [&](rotor::GivenMode& mode, std::size_t) { Describe(v, mode); });
  DescribeGyroscopic(v, rotor);
}

void DescribeReduction(Visitor& v, rotor::RotorConfig& rotor) {
  v.Number({"max_element_length", kMillimetre, 0.1, 20000, 10.0,
            "finite elements of the shaft are not longer than this"},
           rotor.max_element_length_m);
  const double elements = CountElements(rotor);
  v.RefuseIf(elements > kMaxElements, "max_element_length_mm",
             fmt::format("divides the shaft into {:.0f} finite elements, allowed 1 to {:.0f}",
                         elements, kMaxElements));
  v.Integer({"modes_per_plane", 0, 100, 8,
             "modes kept in the simulation, the two rigid ones included; 0 keeps all"},
            rotor.modes_per_plane);
  v.RefuseIf(rotor.modes_per_plane == 1, "modes_per_plane",
             "found 1, but a rotor has two rigid modes per plane: allowed 0 or 2 to 100");
  // Deflection and slope of every node are the degrees of freedom there are to keep.
  v.RefuseIf(elements > 0.0 && static_cast<double>(rotor.modes_per_plane) > 2.0 * (elements + 1.0),
             "modes_per_plane",
             fmt::format("more than the {:.0f} that {:.0f} finite elements have",
                         2.0 * (elements + 1.0), elements));
  v.Number({"modal_damping_ratio", kOne, 0, 0.5, 0.003,
            "damping ratio of every flexible mode; rigid modes are undamped"},
           rotor.modal_damping_ratio);
}

void DescribeShaft(Visitor& v, rotor::RotorConfig& rotor) {
  v.Group("material", "of the shaft", [&] { Describe(v, rotor.material); });
  v.List({"sections", 1, 500, "pieces of shaft, one after the other from the drive end (z = 0)"},
         rotor.sections, [&](rotor::Section& section, std::size_t) { Describe(v, section); });
  const auto on_shaft = [&](auto& part, std::size_t) {
    Describe(v, part);
    RefuseBeyondShaft(v, rotor, part.z_m, "z_mm");
  };
  v.List({"discs", 0, 200, "rigid discs given by mass and inertia"}, rotor.discs, on_shaft);
  v.List({"rings", 0, 200, "solid rings on the shaft, mass and inertia from their geometry"},
         rotor.rings, on_shaft);
  DescribeReduction(v, rotor);
}

}  // namespace

void RefuseBeyondShaft(Visitor& v, const rotor::RotorConfig& rotor, double z_m,
                       std::string_view key) {
  double shaft_m = 0.0;
  for (const rotor::Section& section : rotor.sections) shaft_m += section.length_m;
  // A sum of lengths may fall short of a typed place by rounding; a nanometre is nothing here.
  v.RefuseIf(shaft_m > 0.0 && z_m > shaft_m + 1e-9, key,
             fmt::format("beyond the end of the shaft ({:.6g} mm)", shaft_m * 1e3));
}

void Describe(Visitor& v, rotor::RotorConfig& rotor, std::vector<plant::UnbalanceMass>& unbalance) {
  bool given = rotor.given.has_value();
  rotor::GivenRotor modal = rotor.given.value_or(rotor::GivenRotor{});
  v.OptionalGroup("modal", "a rigid body with given modes, instead of a shaft and its parts", given,
                  [&] { Describe(v, modal); });
  if (given) rotor.given = modal;
  v.When(!given, "without modal", [&] { DescribeShaft(v, rotor); });
  v.List({"unbalance", 0, 100, "unbalance masses"}, unbalance,
         [&](plant::UnbalanceMass& mass, std::size_t) {
           Describe(v, mass);
           RefuseBeyondShaft(v, rotor, mass.z_m, "z_mm");
         });
}

}  // namespace levitas::configuration
