#include "plant_sim/rotor/finite_element.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plant_sim/rotor/beam_element.hpp"
#include "plant_sim/rotor/section_at.hpp"

namespace levitas::rotor {
namespace {

constexpr double kSamePlaceM = 1e-9;

void Require(bool condition, const std::string& text) {
  if (!condition) throw std::invalid_argument(text);
}

double LengthOf(const RotorConfig& config) {
  double length = 0.0;
  for (const auto& section : config.sections) length += section.length_m;
  return length;
}

void CheckShaft(const RotorConfig& config) {
  const auto& m = config.material;
  Require(m.young_pa > 0.0 && m.density_kg_per_m3 > 0.0, "rotor: material constants must be > 0");
  Require(m.poisson > -1.0 && m.poisson <= 0.5, "rotor: Poisson's ratio must lie in -1 .. 0.5");
  Require(!config.sections.empty(), "rotor: no shaft section");
  Require(config.max_element_length_m > 0.0, "rotor: max_element_length_m must be > 0");
  for (std::size_t i = 0; i < config.sections.size(); ++i) {
    const auto& s = config.sections[i];
    Require(
        s.length_m > 0.0 && s.outer_diameter_m > s.inner_diameter_m && s.inner_diameter_m >= 0.0,
        fmt::format("rotor: section {} has length {} m, diameters {} / {} m", i, s.length_m,
                    s.outer_diameter_m, s.inner_diameter_m));
  }
}

// Section ends, planes and lumped masses, ascending, without repetition.
std::vector<double> FixedPlaces(const RotorConfig& config, const std::vector<double>& planes_m) {
  const double length = LengthOf(config);
  std::vector<double> places{0.0};
  for (const auto& section : config.sections) places.push_back(places.back() + section.length_m);
  const auto add = [&](double z, const char* what) {
    Require(
        z >= -kSamePlaceM && z <= length + kSamePlaceM,
        fmt::format("rotor: {} at z = {} m lies outside the shaft, 0 to {} m", what, z, length));
    places.push_back(z);
  };
  for (const auto& disc : config.discs) add(disc.z_m, "disc");
  for (const auto& ring : config.rings) add(ring.z_m, "ring");
  for (const double z : planes_m) add(z, "plane");
  std::sort(places.begin(), places.end());
  const auto same = [](double a, double b) { return b - a < kSamePlaceM; };
  places.erase(std::unique(places.begin(), places.end(), same), places.end());
  return places;
}

std::size_t NearestNode(const std::vector<double>& nodes, double z_m) {
  const auto closer = [z_m](double a, double b) { return std::abs(a - z_m) < std::abs(b - z_m); };
  return static_cast<std::size_t>(std::min_element(nodes.begin(), nodes.end(), closer) -
                                  nodes.begin());
}

void AddDisc(FiniteElementModel& model, const Disc& disc) {
  Require(
      disc.mass_kg >= 0.0 && disc.diametral_inertia_kg_m2 >= 0.0 && disc.polar_inertia_kg_m2 >= 0.0,
      fmt::format("rotor: disc at z = {} m has a negative mass or inertia", disc.z_m));
  const auto row = static_cast<Eigen::Index>(2 * NearestNode(model.node_z_m, disc.z_m));
  model.mass(row, row) += disc.mass_kg;
  model.mass(row + 1, row + 1) += disc.diametral_inertia_kg_m2;
  model.gyroscopic(row + 1, row + 1) += disc.polar_inertia_kg_m2;
  model.total_mass_kg += disc.mass_kg;
}

}  // namespace

// Cylinder ring about a diameter and about its axis, (8).
Disc ToDisc(const Ring& ring) {
  const double ro = ring.outer_diameter_m / 2.0;
  const double ri = ring.bore_m / 2.0;
  Require(ro > ri && ri >= 0.0 && ring.width_m > 0.0,
          fmt::format("rotor: ring at z = {} m has bore {} m, outer diameter {} m, width {} m",
                      ring.z_m, ring.bore_m, ring.outer_diameter_m, ring.width_m));
  const double squares = ro * ro + ri * ri;
  const double mass =
      ring.density_kg_per_m3 * std::numbers::pi * (ro * ro - ri * ri) * ring.width_m;
  return {ring.z_m, mass, mass / 12.0 * (3.0 * squares + ring.width_m * ring.width_m),
          mass / 2.0 * squares};
}

FiniteElementModel Assemble(const RotorConfig& config, const std::vector<double>& planes_m) {
  CheckShaft(config);
  const auto places = FixedPlaces(config, planes_m);
  FiniteElementModel model;
  model.node_z_m.push_back(places.front());
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double span = places[i] - places[i - 1];
    const int pieces = static_cast<int>(std::ceil(span / config.max_element_length_m - 1e-9));
    for (int p = 1; p < pieces; ++p) model.node_z_m.push_back(places[i - 1] + span * p / pieces);
    model.node_z_m.push_back(places[i]);
  }
  const auto size = static_cast<Eigen::Index>(2 * model.node_z_m.size());
  model.mass = Eigen::MatrixXd::Zero(size, size);
  model.gyroscopic = model.mass;
  model.stiffness = model.mass;
  for (std::size_t i = 0; i + 1 < model.node_z_m.size(); ++i) {
    const double start = model.node_z_m[i];
    Section piece = SectionAt(config, start + kSamePlaceM);
    piece.length_m = model.node_z_m[i + 1] - start;
    const auto element = MakeBeamElement(config.material, piece);
    const auto row = static_cast<Eigen::Index>(2 * i);
    model.mass.block<4, 4>(row, row) += element.mass;
    model.gyroscopic.block<4, 4>(row, row) += element.gyroscopic;
    model.stiffness.block<4, 4>(row, row) += element.stiffness;
    model.total_mass_kg +=
        config.material.density_kg_per_m3 * CrossSectionM2(piece) * piece.length_m;
  }
  for (const auto& disc : config.discs) AddDisc(model, disc);
  for (const auto& ring : config.rings) AddDisc(model, ToDisc(ring));
  return model;
}

}  // namespace levitas::rotor
