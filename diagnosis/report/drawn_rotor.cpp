#include "diagnosis/report/drawn_rotor.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/diagnose/diagnose_files.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kThin = 0.01;        ///< of the shaft's length: a disc of unknown width
constexpr double kGivenShaft = 0.06;  ///< of its length: diameter of a shaft that is not drawn

using Piece = ReportRotor::Piece;

void AddGiven(const rotor::GivenRotor& given, const plant::PlantConfig& plant,
              std::vector<Piece>& pieces) {
  double from_m = given.centre_z_m;
  double to_m = given.centre_z_m;
  const auto reach = [&](double z_m) {
    from_m = std::min(from_m, z_m);
    to_m = std::max(to_m, z_m);
  };
  for (const auto& mode : given.modes) {
    for (const auto& point : mode.shape) reach(point.z_m);
  }
  for (const auto& bearing : plant.bearings) {
    reach(bearing.actuator_z_m);
    reach(bearing.sensor_z_m);
  }
  if (to_m > from_m) pieces.push_back({from_m, to_m, kGivenShaft * (to_m - from_m), 0.0, false});
}

std::vector<Piece> PiecesOf(const plant::PlantConfig& plant) {
  std::vector<Piece> pieces;
  const rotor::RotorConfig& rotor = plant.rotor;
  if (rotor.given) {
    AddGiven(*rotor.given, plant, pieces);
    return pieces;
  }
  double z_m = 0.0;
  for (const rotor::Section& s : rotor.sections) {
    pieces.push_back({z_m, z_m + s.length_m, s.outer_diameter_m, s.inner_diameter_m, false});
    z_m += s.length_m;
  }
  for (const rotor::Ring& r : rotor.rings) {
    pieces.push_back(
        {r.z_m - 0.5 * r.width_m, r.z_m + 0.5 * r.width_m, r.outer_diameter_m, r.bore_m, true});
  }
  for (const rotor::Disc& d : rotor.discs) {
    const double diameter_m =
        d.mass_kg > 0.0 ? std::sqrt(8.0 * d.polar_inertia_kg_m2 / d.mass_kg) : 0.0;
    pieces.push_back({d.z_m - 0.5 * kThin * z_m, d.z_m + 0.5 * kThin * z_m, diameter_m, 0.0, true});
  }
  return pieces;
}

/// Sensors stand elsewhere than magnets.
bool OnSensor(const NamedParameter& p) {
  const effect::Row* row = effect::Find(p.effect);
  return p.location.on_sensor || (row != nullptr && row->place == effect::Place::kSensor);
}

}  // namespace

ReportScale ScaleOf(const DiagnosisResult& answer) {
  const RigView& rig = *answer.view;
  ReportScale scale;
  scale.rated_speed_rad_per_s = rig.numbers.max_speed_rad_per_s;
  if (!rig.geared()) scale.rotor_mass_kg = rig.model->parameters().modes.total_mass_kg;
  for (const auto& bearing : rig.model->config().bearings) {
    const double own_m = bearing.touchdown.clearance_m;
    const bool first = scale.clearance_m == 0.0;
    scale.clearance_m = first ? own_m : std::min(scale.clearance_m, own_m);
  }
  return scale;
}

ReportRotor RotorOf(const DiagnosisResult& answer) {
  const plant::PlantConfig& plant = answer.view->model->config();
  ReportRotor drawn;
  if (answer.view->geared()) return drawn;
  drawn.pieces = PiecesOf(plant);
  for (const auto& bearing : plant.bearings) {
    drawn.bearings.push_back({bearing.name, bearing.actuator_z_m, bearing.sensor_z_m});
  }
  return drawn;
}

std::vector<ReportMark> MarksOf(const DiagnosisResult& answer,
                                const std::vector<NamedParameter>& parameters) {
  std::vector<ReportMark> marks;
  if (answer.view->geared()) return marks;
  const auto& bearings = answer.view->model->config().bearings;
  const auto add = [&](double z_m, const std::string& text) {
    const bool known = std::any_of(marks.begin(), marks.end(), [&](const ReportMark& mark) {
      return mark.z_m == z_m && mark.text == text;
    });
    if (!known) marks.push_back({z_m, text});
  };
  for (const NamedParameter& p : parameters) {
    const std::optional<std::size_t> bearing =
        p.location.axis ? std::optional(*p.location.axis / 2) : p.location.bearing;
    if (p.key == "z_mm") {
      add(p.value * p.si, p.effect);
    } else if (bearing && *bearing < bearings.size()) {
      add(OnSensor(p) ? bearings[*bearing].sensor_z_m : bearings[*bearing].actuator_z_m, p.effect);
    } else if (p.location.z_m && std::none_of(parameters.begin(), parameters.end(), [&](auto& o) {
                 return o.effect == p.effect && o.key == "z_mm";
               })) {
      add(*p.location.z_m, p.effect);
    }
  }
  return marks;
}

}  // namespace levitas::diagnosis
