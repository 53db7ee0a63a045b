// amb design compare: two controllers on one rig, side by side.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "analysis/sensitivity.hpp"
#include "cli/json_file.hpp"
#include "cli/study/design/design_commands.hpp"
#include "cli/study/design/gate_options.hpp"
#include "cli/study/written_files.hpp"
#include "cli/text_file.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/law_schedule.hpp"
#include "design/gate/gate.hpp"
#include "report/svg/figure.hpp"
#include "report/text/text_table.hpp"
#include "session/output_path.hpp"

namespace levitas::cli {
namespace {

struct CompareOptions {
  AnalysisOptions rig;
  GateCommandOptions gate;
  std::vector<std::string> controllers;
  std::string html_path;
};

/// What one controller does.
struct Compared {
  std::string name;
  law::LawConfig law;
  std::vector<design::RunFigures> runs;  ///< at the speeds asked
  std::vector<double> speed_rpm, peak;   ///< |S| over speed
  design::Peak mu;
  std::size_t lost{}, drawn{};
  double worst_m{};
};

Compared Measure(const config::RigFile& rig, const std::string& name, const CompareOptions& options,
                 const uncertainty::AnalysisWeights& weights) {
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
  for (const auto& at : design::RunDrawnRigs(rig, out.law, parameters, drawn).drawn) {
    out.lost += at.lost;
    out.drawn += drawn.draws;
    for (const double orbit_m : at.worst_orbit_m) out.worst_m = std::max(out.worst_m, orbit_m);
  }
  return out;
}

std::string Pair(const std::vector<double>& values, double scale, const char* format) {
  std::string out;
  for (const double value : values)
    out += (out.empty() ? "" : "/") + fmt::format(fmt::runtime(format), scale * value);
  return out;
}

void Print(const std::vector<Compared>& compared, const std::vector<double>& speeds_rpm) {
  TextTable table;
  std::vector<std::string> head{""};
  for (const auto& c : compared) head.push_back(c.name);
  table.Add(head);
  const auto row = [&](const std::string& name, const auto& text_of) {
    std::vector<std::string> cells{name};
    for (const auto& c : compared) cells.push_back(text_of(c));
    table.Add(cells);
  };
  for (std::size_t i = 0; i < speeds_rpm.size(); ++i) {
    row(fmt::format("orbit at {:.0f} rpm [um]", speeds_rpm[i]), [&](const Compared& c) {
      return c.runs[i].lost ? std::string("LOST") : Pair(c.runs[i].orbit_m, 1e6, "{:.1f}");
    });
    row(fmt::format("current at {:.0f} rpm [A]", speeds_rpm[i]), [&](const Compared& c) {
      return Pair(speeds_rpm[i] > 0.0 ? c.runs[i].synchronous_a : c.runs[i].static_a, 1.0,
                  "{:.3f}");
    });
  }
  row("|S| over speed, largest", [](const Compared& c) {
    return fmt::format("{:.2f}", *std::max_element(c.peak.begin(), c.peak.end()));
  });
  row("mu, at most",
      [](const Compared& c) { return fmt::format("{:.2f} at {:.1f} Hz", c.mu.value, c.mu.hz); });
  row("drawn rigs at 20 speeds: lost, worst [um]", [](const Compared& c) {
    return fmt::format("{} of {} runs, {:.1f}", c.lost, c.drawn, 1e6 * c.worst_m);
  });
  fmt::print("{}", table.Text());
}

void AddBode(const std::vector<Compared>& compared, const config::RigFile& rig,
             svg::Figure& figure) {
  constexpr int kPoints = 400;
  for (std::size_t b = 0; b < rig.numbers.bearings.size(); ++b) {
    const std::size_t axis = 2 * b;
    svg::Panel gain{fmt::format("controller, {}", rig.numbers.channels[axis]), "frequency [Hz]",
                    "|current/position| [A/mm]", svg::Scale::kLogarithmic,
                    svg::Scale::kLogarithmic};
    svg::Panel phase{gain.title, "frequency [Hz]", "phase [deg]", svg::Scale::kLogarithmic};
    for (std::size_t c = 0; c < compared.size(); ++c) {
      const uncertainty::LawResponse response(law::LawAt(compared[c].law, 0.0));
      svg::Series size{compared[c].name};
      size.colour = svg::Colour(c);
      svg::Series angle = size;
      for (int i = 0; i < kPoints; ++i) {
        const double hz = 0.1 * std::pow(4e4, i / (kPoints - 1.0));
        const auto k = static_cast<Eigen::Index>(axis);
        const std::complex<double> at = -response.At(hz)(k, k);
        size.x.push_back(hz);
        size.y.push_back(1e-3 * std::abs(at));
        angle.x.push_back(hz);
        angle.y.push_back(std::arg(at) * 180.0 / std::numbers::pi);
      }
      gain.series.push_back(std::move(size));
      phase.series.push_back(std::move(angle));
    }
    figure.panels.push_back(std::move(gain));
    figure.panels.push_back(std::move(phase));
  }
}

svg::Series Circle(double radius_um) {
  svg::Series out{"objective"};
  out.colour = "#666666";
  out.dashes = "5 3";
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * std::numbers::pi / 36.0;
    out.x.push_back(radius_um * std::cos(angle));
    out.y.push_back(radius_um * std::sin(angle));
  }
  return out;
}

svg::Figure Picture(const std::vector<Compared>& compared, const config::RigFile& rig,
                    const std::vector<double>& speeds_rpm) {
  svg::Figure figure;
  figure.columns = 2;
  AddBode(compared, rig, figure);
  svg::Panel peaks{"largest |S| of an axis", "speed [rpm]", "[1]"};
  for (std::size_t c = 0; c < compared.size(); ++c) {
    svg::Series line{compared[c].name, compared[c].speed_rpm, compared[c].peak};
    line.colour = svg::Colour(c);
    peaks.series.push_back(std::move(line));
  }
  figure.panels.push_back(peaks);
  figure.panels.push_back({"", "", ""});
  for (std::size_t i = 0; i < speeds_rpm.size(); ++i)
    for (std::size_t b = 0; b < rig.numbers.bearings.size(); ++b) {
      const double objective_m = speeds_rpm[i] > 0.0 ? rig.numbers.spinning_orbit_objective_m
                                                     : rig.numbers.standing_orbit_objective_m;
      svg::Panel panel{fmt::format("orbit, {}, {:.0f} rpm", rig.numbers.bearings[b], speeds_rpm[i]),
                       "x [um]", "y [um]"};
      panel.same_scale = true;
      if (objective_m > 0.0) panel.series.push_back(Circle(1e6 * objective_m));
      for (std::size_t c = 0; c < compared.size(); ++c) {
        svg::Series orbit{compared[c].name};
        orbit.colour = svg::Colour(c);
        for (const AxisArray& at : compared[c].runs[i].positions_m) {
          orbit.x.push_back(1e6 * at[2 * b]);
          orbit.y.push_back(1e6 * at[2 * b + 1]);
        }
        panel.series.push_back(std::move(orbit));
      }
      figure.panels.push_back(std::move(panel));
    }
  return figure;
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
    one["drawn_runs"] = c.drawn;
    one["lost_runs"] = c.lost;
    one["worst_orbit_m"] = c.worst_m;
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
  Print(compared, options.rig.speeds_rpm);
  if (!options.html_path.empty()) {
    const std::string picture = svg::Draw(Picture(compared, rig, options.rig.speeds_rpm));
    WriteTextFile(options.html_path,
                  "<!doctype html><meta charset=\"utf-8\"><title>controllers compared</title>\n" +
                      picture + "\n");
  }
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
