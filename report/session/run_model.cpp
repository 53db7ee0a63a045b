#include "report/session/run_model.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/speed_sweep.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "report/rig/campbell_panel.hpp"
#include "report/rig/poles_picture.hpp"

namespace levitas::report {
namespace {

svg::Figure Tall(svg::Panel panel) {
  svg::Figure figure = Wide(std::move(panel));
  figure.panel_height = 330;
  return figure;
}

/// Graded peaks measured within 1 rpm of this speed.
svg::Series MeasuredPeaks(const verdict::Verdict& verdict, double speed_rad_per_s,
                          const std::vector<std::string>& channels) {
  svg::Series rings{.colour = "#000000", .width = 0.0, .mark = svg::Mark::kRing, .mark_size = 4.5};
  if (!verdict.inputs.measured) return rings;
  for (const std::string& channel : channels) {
    const auto* axis = verdict::FindGraded(*verdict.inputs.measured, channel, speed_rad_per_s);
    if (axis == nullptr) continue;
    rings.name = "peak measured";
    rings.x.push_back(axis->frequency_hz);
    rings.y.push_back(axis->peak);
  }
  return rings;
}

NamedPicture SensitivityOf(const RunModel& model, const LoopAtSpeed& loop,
                           const verdict::Verdict& verdict) {
  svg::Panel panel = SensitivityPanel(loop, model.channels);
  panel.series.push_back(MeasuredPeaks(verdict, loop.peaks.speed_rad_per_s, model.channels));
  const std::size_t worst = analysis::WorstAxis(loop.peaks);
  const double rpm = RadPerSToRpm(loop.peaks.speed_rad_per_s);
  return {fmt::format("sensitivity_{:.0f}_rpm", rpm),
          fmt::format("Sensitivity of the loop that ran, computed from its files at {:.0f} rpm, "
                      "with the zones of ISO 14839-3. Largest |S|: {} {:.2f} at {:.1f} Hz.",
                      rpm, model.channels[worst], loop.peaks.axes[worst].peak,
                      loop.peaks.axes[worst].frequency_hz),
          Tall(std::move(panel))};
}

}  // namespace

RunModel ModelOf(const session::SessionHeader& header, const verdict::Verdict& verdict) {
  const configuration::RigFile rig = configuration::ParseRig(header.rig_yaml, "header");
  const configuration::ControllerFile controller =
      configuration::ParseController(header.controller_yaml, "header", rig.numbers);
  RunModel model;
  model.channels = rig.numbers.channels;
  model.rated_rad_per_s = rig.numbers.max_speed_rad_per_s;
  for (const auto& peaks : verdict.inputs.sensitivity) {
    model.loops.push_back(
        {peaks, analysis::CurvesOf(rig.plant, controller.law, peaks.speed_rad_per_s)});
  }
  model.levitated =
      analysis::LevitatedCampbell(rig.plant, controller.law, kBeyondRated * model.rated_rad_per_s);
  return model;
}

std::vector<NamedPicture> ModelPictures(const RunModel& model, const verdict::Verdict& verdict) {
  std::vector<NamedPicture> pictures;
  for (const LoopAtSpeed& loop : model.loops) {
    pictures.push_back(SensitivityOf(model, loop, verdict));
  }
  pictures.push_back(
      {"campbell",
       fmt::format("Frequencies of the levitated rotor over speed, computed from the run's files, "
                   "and 1x: {} crossings up to {:.0f} rpm (F forward, B backward whirl).",
                   model.levitated.crossings.size(),
                   RadPerSToRpm(model.levitated.speeds.back().speed_rad_per_s)),
       Tall(LevitatedPanel(model.levitated, model.rated_rad_per_s))});
  return pictures;
}

}  // namespace levitas::report
