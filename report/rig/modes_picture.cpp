#include "report/rig/modes_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/rig/campbell_panel.hpp"

namespace levitas::report {
namespace {

using analysis::RotorFigures;
constexpr double kMm = 1e3;
constexpr double kThickest = 0.5;  // of the shaft's drawing, in the unit of a mode's deflection
constexpr const char* kSteel = "#8a93a3";
constexpr const char* kMagnet = "#3d4553";
constexpr const char* kProbe = "#7b8494";

/// Highest frequency drawn: every mode asked for, and 1x where that is higher.
double TopHz(const analysis::Campbell& campbell) {
  double top = campbell.speeds.back().speed_rad_per_s / (2.0 * std::acos(-1.0));
  for (const auto& at : campbell.speeds) {
    for (const auto& mode : at.modes) top = std::max(top, mode.frequency_hz);
  }
  return 1.08 * top;
}

svg::Panel CampbellOfRig(const configuration::RigFile& rig, const analysis::Campbell& campbell) {
  const bool several = !rig.plant.shafts.empty();
  CampbellLook look{
      several ? "Campbell diagram: damped modes, magnets without current; speed of the first shaft"
              : "Campbell diagram: free bending modes, magnets off",
      rig.numbers.max_speed_rad_per_s, TopHz(campbell)};
  if (several) return CampbellPanel(campbell, look);
  const auto& standing = campbell.speeds.front().modes;
  for (std::size_t i = 0; i < standing.size() / 2; ++i) {
    look.notes.push_back(
        {.x = 0.0,
         .y = standing[i].frequency_hz,
         .text = fmt::format("mode {}: {:.1f} Hz at rest", i + 1, standing[i].frequency_hz),
         .right_px = 6,
         .down_px = -9});
  }
  svg::Panel panel = CampbellPanel(campbell, look);
  if (standing.empty()) {
    panel.notes.push_back({.x = panel.x_range->high / 2,
                           .y = panel.y_range->high / 2,
                           .text = "rigid rotor: no bending mode",
                           .anchor = svg::Anchor::kMiddle});
  }
  return panel;
}

svg::Series Block(double from_m, double to_m, double radius, const char* fill) {
  return {.x = {kMm * from_m, kMm * to_m, kMm * to_m, kMm * from_m, kMm * from_m},
          .y = {-radius, -radius, radius, radius, -radius},
          .colour = kSteel,
          .width = 0.8,
          .fill = fill};
}

void AddShaft(const rotor::RotorConfig& rotor, svg::Panel& panel) {
  double largest = 0.0;
  for (const auto& section : rotor.sections) {
    largest = std::max(largest, section.outer_diameter_m);
  }
  for (const auto& ring : rotor.rings) largest = std::max(largest, ring.outer_diameter_m);
  double z = 0.0;
  // A plain shaft with lumped discs is thin, so that its modes stay visible on it.
  const double thickest = rotor.rings.empty() && rotor.sections.size() == 1 ? 0.12 : kThickest;
  for (const auto& section : rotor.sections) {
    panel.series.push_back(
        Block(z, z + section.length_m, thickest * section.outer_diameter_m / largest, "#e3e7ee"));
    z += section.length_m;
  }
  for (const auto& ring : rotor.rings) {
    panel.series.push_back(Block(ring.z_m - ring.width_m / 2, ring.z_m + ring.width_m / 2,
                                 thickest * ring.outer_diameter_m / largest, "#c9d0dc"));
  }
  for (const auto& disc : rotor.discs) {
    panel.series.push_back(Block(disc.z_m - 0.004 * z, disc.z_m + 0.004 * z, kThickest, "#aab3c2"));
  }
}

void AddPlanes(const configuration::RigFile& rig, const RotorFigures& figures, double height,
               svg::Panel& panel) {
  svg::Series magnets{.name = "magnet", .colour = kMagnet, .width = 2.5};
  svg::Series probes{.name = "probe", .colour = kProbe, .width = 1.2, .dashes = "2 3"};
  for (std::size_t i = 0; i < rig.plant.bearings.size(); ++i) {
    const auto& bearing = rig.plant.bearings[i];
    const auto line = [&](svg::Series& to, double z_m) {
      to.x.insert(to.x.end(), {kMm * z_m, kMm * z_m, std::nan("")});
      to.y.insert(to.y.end(), {-height, height, std::nan("")});
    };
    line(magnets, bearing.actuator_z_m);
    line(probes, bearing.sensor_z_m);
    const auto& load = figures.loads[i].load_n;
    panel.notes.push_back(
        {.x = kMm * bearing.actuator_z_m,
         .y = -height,
         .text = load ? fmt::format("{} carries {:.2f} N", bearing.name, *load) : bearing.name,
         .anchor = svg::Anchor::kMiddle,
         .down_px = -10});
  }
  panel.series.push_back(magnets);
  panel.series.push_back(probes);
}

void AddShapes(const RotorFigures& figures, svg::Panel& panel) {
  constexpr std::array kDashes{"", "8 3", "3 2", "10 3 2 3", "1 2", "14 4"};
  for (std::size_t i = 0; i < figures.shapes.size(); ++i) {
    const auto& shape = figures.shapes[i];
    svg::Series line{.name = fmt::format("mode {}: {:.1f} Hz", i + 1, shape.frequency_hz),
                     .y = shape.deflection,
                     .colour = svg::Colour(i),
                     .width = 1.8,
                     .dashes = kDashes[i % kDashes.size()]};
    for (const double z : shape.z_m) line.x.push_back(kMm * z);
    panel.series.push_back(line);
  }
}

svg::Range AlongShaft(const configuration::RigFile& rig, const RotorFigures& figures) {
  std::vector<double> z{kMm * figures.centre_z_m};
  for (const auto& bearing : rig.plant.bearings) {
    z.insert(z.end(), {kMm * bearing.actuator_z_m, kMm * bearing.sensor_z_m});
  }
  for (const auto& shape : figures.shapes) {
    for (const double place : shape.z_m) z.push_back(kMm * place);
  }
  double end = 0.0;
  for (const auto& section : rig.plant.rotor.sections) end += kMm * section.length_m;
  if (end > 0.0) z.insert(z.end(), {0.0, end});
  const auto [low, high] = std::minmax_element(z.begin(), z.end());
  const double room = std::max(0.08 * (*high - *low), 5.0);
  return {*low - room, *high + room};
}

svg::Panel ShapesPanel(const configuration::RigFile& rig, const RotorFigures& figures) {
  constexpr double kHeight = 1.45;
  svg::Panel panel{.title = figures.shapes.empty()
                                ? "The rotor and its bearings"
                                : "Mode shapes at rest on the shaft, largest deflection 1",
                   .x_label = "z from the drive end, mm",
                   .y_label = "deflection, relative"};
  panel.x_range = AlongShaft(rig, figures);
  panel.y_range = svg::Range{-kHeight, kHeight};
  if (!rig.plant.rotor.given) AddShaft(rig.plant.rotor, panel);
  panel.series.push_back({.x = {panel.x_range->low, panel.x_range->high},
                          .y = {0.0, 0.0},
                          .colour = kSteel,
                          .width = 1.0,
                          .dashes = "14 3 3 3"});
  AddPlanes(rig, figures, kHeight, panel);
  AddShapes(figures, panel);
  const double centre_mm = kMm * figures.centre_z_m;
  panel.series.push_back({.name = "centre of mass",
                          .x = {centre_mm},
                          .y = {0.0},
                          .colour = "#000000",
                          .width = 0.0,
                          .mark = svg::Mark::kSquare,
                          .mark_size = 4.5});
  panel.notes.push_back({.x = centre_mm,
                         .y = 0.0,
                         .text = fmt::format("{:.1f} mm", centre_mm),
                         .anchor = svg::Anchor::kMiddle,
                         .down_px = 15});
  return panel;
}

}  // namespace

svg::Figure ModesPicture(const configuration::RigFile& rig, const analysis::Campbell& campbell,
                         const std::optional<RotorFigures>& figures) {
  svg::Figure figure{.title = "Rig " + rig.numbers.name, .panel_width = 900, .panel_height = 400};
  figure.panels.push_back(CampbellOfRig(rig, campbell));
  if (!figures) return figure;
  figure.lines.push_back(fmt::format(
      "mass {:.3f} kg, centre of mass at z = {:.1f} mm, transverse inertia {:.4g} kg m² about it, "
      "polar inertia {:.4g} kg m²",
      figures->mass_kg, kMm * figures->centre_z_m, figures->transverse_inertia_kg_m2,
      figures->polar_inertia_kg_m2));
  figure.panels.push_back(ShapesPanel(rig, *figures));
  return figure;
}

}  // namespace levitas::report
