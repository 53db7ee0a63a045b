// amb design compare: two controllers on one rig, side by side.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <limits>
#include <memory>

#include "analysis/sensitivity.hpp"
#include "cli/json_file.hpp"
#include "cli/study/design/compare_page.hpp"
#include "cli/study/design/design_commands.hpp"
#include "cli/study/design/gate_options.hpp"
#include "cli/study/written_files.hpp"
#include "cli/text_file.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/running_law.hpp"
#include "design/gate/gate.hpp"
#include "report/text/text_table.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

struct CompareOptions {
  AnalysisOptions rig;
  GateCommandOptions gate;
  std::vector<std::string> controllers;
  std::string html_path;
};

/// One period of the law on this machine, without test signals: processor time, the least of some
/// batches, for others take the processor away.
double StepNs(const law::LawConfig& law, double speed_rad_per_s) {
  constexpr int kBatches = 9;
  constexpr int kSteps = 20'000;
  law::RunningLaw running(law);
  running.Start(0.0);
  running.JumpTo(speed_rad_per_s);
  double least_ns = std::numeric_limits<double>::infinity();
  double sum_a = 0.0;
  for (int batch = 0; batch < kBatches; ++batch) {
    const std::clock_t from = std::clock();
    for (int n = 0; n < kSteps; ++n) {
      AxisArray error_m{};
      error_m.fill(n % 2 == 0 ? 1e-6 : -1e-6);
      sum_a += running.Step(speed_rad_per_s, error_m, {}, law.current_limit_a).control_current_a[0];
    }
    const double took_s = static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC;
    least_ns = std::min(least_ns, 1e9 * took_s / kSteps);
  }
  return std::isfinite(sum_a) ? least_ns : 0.0;
}

Compared Measure(const configuration::RigFile& rig, const std::string& name,
                 const CompareOptions& options, const uncertainty::AnalysisWeights& weights) {
  constexpr int kSpeeds = 12;
  AnalysisOptions load = options.rig;
  load.controller_name = name;
  Compared out;
  const auto found = LoadController(load, rig);
  out.name = std::filesystem::path(found.path).stem().string();
  out.law = found.file.law;
  const auto pushed = design::WithThirdHarmonic(rig, options.gate.third_n);
  for (const double rpm : options.rig.speeds_rpm)
    out.runs.push_back(design::RunOnce(pushed, out.law,
                                       {.speed_rad_per_s = RpmToRadPerS(rpm),
                                        .settle_s = 0.6,
                                        .watch_s = 0.6,
                                        .seed = options.gate.seed,
                                        .keep_orbit = true}));
  const auto parameters = ParametersOf(rig, options.gate.from);
  const double top = rig.numbers.max_speed_rad_per_s;
  for (int i = 0; i <= kSpeeds; ++i) {
    const double speed = top * i / kSpeeds;
    double peak = 0.0;
    for (const auto& axis : analysis::SensitivityPeaks(rig.plant, out.law, speed).axes)
      peak = std::max(peak, axis.peak);
    out.speed_rpm.push_back(RadPerSToRpm(speed));
    out.peak.push_back(peak);
  }
  for (const double speed : {0.0, top}) {
    const auto peak = design::MuPeakAt(rig, out.law, parameters, weights, speed).of_real;
    if (peak.value > out.mu.value) out.mu = peak;
  }
  const design::GateOptions drawn = GateOf(options.gate, weights, rig);
  out.drawn = design::RunDrawnRigs(rig, out.law, parameters, drawn).drawn;
  out.rigs = drawn.draws;
  out.step_ns = StepNs(out.law, rig.numbers.max_speed_rad_per_s);
  return out;
}

nlohmann::ordered_json Json(const std::vector<Compared>& compared,
                            const std::vector<double>& speeds_rpm) {
  nlohmann::ordered_json json;
  for (const auto& c : compared) {
    nlohmann::ordered_json one{{"controller", c.name}};
    for (std::size_t i = 0; i < speeds_rpm.size(); ++i)
      one["runs"].push_back({{"speed_rpm", speeds_rpm[i]},
                             {"lost", c.runs[i].lost},
                             {"orbit_m", c.runs[i].orbit_m},
                             {"static_current_a", c.runs[i].static_a},
                             {"synchronous_current_a", c.runs[i].synchronous_a},
                             {"saturated_share", c.runs[i].saturated_share}});
    one["speed_rpm"] = c.speed_rpm;
    one["sensitivity_peak"] = c.peak;
    one["mu_upper"] = c.mu.value;
    one["mu_frequency_hz"] = c.mu.hz;
    one["drawn_runs"] = c.Runs();
    one["lost_runs"] = c.Lost();
    one["worst_orbit_m"] = c.WorstOrbit();
    one["law_step_ns"] = c.step_ns;
    json["controllers"].push_back(std::move(one));
  }
  return json;
}

ExitStatus Run(const CompareOptions& options) {
  session::CheckOutputPath(options.html_path, {});
  session::CheckOutputPath(options.rig.json_path, {});
  const auto rig = LoadRig(options.rig);
  std::vector<Compared> compared;
  const auto weights = DesignOf(options.gate).analysis;
  for (const auto& name : options.controllers)
    compared.push_back(Measure(rig, name, options, weights));
  fmt::print("rig {}, nonlinear runs with seed {}{}\n", rig.numbers.name, options.gate.seed,
             options.gate.third_n > 0.0
                 ? fmt::format(", {:.2f} N at three times the speed", options.gate.third_n)
                 : "");
  report::TextTable table;
  for (const auto& row : ComparedRows(compared, options.rig.speeds_rpm)) table.Add(row);
  fmt::print("{}", table.Text());
  if (!options.html_path.empty())
    WriteTextFile(options.html_path, ComparePage(compared, rig, options.rig.speeds_rpm));
  WriteJsonFile(options.rig.json_path, Json(compared, options.rig.speeds_rpm));
  TellWritten({options.html_path, options.rig.json_path});
  return ExitStatus::kDone;
}

}  // namespace

void AddDesignCompare(CLI::App& design, Action& action) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = design.add_subcommand(
      "compare",
      "Controllers on one rig side by side: Bode, orbits, currents, |S|, mu, drawn rigs");
  AddRigOption(*command, options->rig);
  command->add_option("CONTROLLER", options->controllers, "Controller files or shipped names")
      ->required();
  command->add_option("--html", options->html_path, "Page to write");
  AddSpeedOption(*command, options->rig, {0.0, 1600.0, 3000.0, 6000.0});
  AddGateOptions(*command, options->gate);
  AddJsonOption(*command, options->rig);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
