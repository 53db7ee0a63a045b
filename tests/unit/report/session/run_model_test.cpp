#include "report/session/run_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::report {
namespace {

std::string TextOf(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

session::SessionHeader Header() {
  session::SessionHeader header;
  header.rig_yaml = TextOf(configuration::FindConfig("flexible_rotor", "rigs"));
  header.controller_yaml =
      TextOf(configuration::FindConfig("flexible_rotor_commissioned", "controllers"));
  return header;
}

/// A verdict on a run that stood, with a measured peak or without.
verdict::Verdict Standing(bool measured) {
  const auto rig = configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  const auto controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
  verdict::Verdict verdict;
  verdict.inputs.sensitivity = {analysis::SensitivityPeaks(rig.plant, controller.law, 0.0)};
  if (!measured) return verdict;
  verdict::MeasuredAxis axis;
  axis.channel = "de_x";
  axis.peak = 2.5;
  axis.frequency_hz = 60.0;
  axis.zone = analysis::Zone::kA;
  verdict.inputs.measured = verdict::MeasuredSensitivity{{{0.0, {axis}}}, ""};
  return verdict;
}

std::size_t Rings(const svg::Panel& panel) {
  std::size_t count = 0;
  for (const auto& series : panel.series) {
    if (series.mark == svg::Mark::kRing) count += series.x.size();
  }
  return count;
}

TEST(RunModel, HasACurveForEverySpeedOfTheVerdictAndTheCampbellDiagram) {
  const auto verdict = Standing(false);
  const RunModel model = ModelOf(Header(), verdict);
  ASSERT_EQ(model.loops.size(), 1U);
  EXPECT_DOUBLE_EQ(RadPerSToRpm(model.rated_rad_per_s), 6000.0);
  const auto pictures = ModelPictures(model, verdict);
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[0].name, "sensitivity_0_rpm");
  EXPECT_EQ(pictures[1].name, "campbell");
}

TEST(RunModel, ShowsMeasuredPeaksAtTheirPlace) {
  const auto without = Standing(false);
  const auto with = Standing(true);
  const RunModel model = ModelOf(Header(), with);
  EXPECT_EQ(Rings(ModelPictures(model, without)[0].figure.panels[0]), 0U);
  const svg::Panel panel = ModelPictures(model, with)[0].figure.panels[0];
  ASSERT_EQ(Rings(panel), 1U);
  const auto rings = std::find_if(panel.series.begin(), panel.series.end(),
                                  [](const auto& s) { return s.name == "peak measured"; });
  ASSERT_NE(rings, panel.series.end());
  EXPECT_DOUBLE_EQ(rings->x[0], 60.0);
  EXPECT_DOUBLE_EQ(rings->y[0], 2.5);
}

}  // namespace
}  // namespace levitas::report
