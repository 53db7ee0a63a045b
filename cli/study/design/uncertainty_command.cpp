// amb design uncertainty: the plants that a controller must hold, as a table and a fan of Bode
// curves.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "cli/json_file.hpp"
#include "cli/study/design/design_commands.hpp"
#include "cli/study/design/gate_options.hpp"
#include "cli/study/written_files.hpp"
#include "common/rotational_speed.hpp"
#include "design/uncertainty/uncertain_plant.hpp"
#include "report/svg/figure.hpp"
#include "report/text/text_table.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

struct UncertaintyOptions {
  AnalysisOptions rig;
  std::string from{"stated"};
  std::string svg_path;
  std::size_t draws{20};
  std::uint64_t seed{1};
};

/// |P_ii| [um/A] of every drawn rig at one speed, a panel per axis.
svg::Figure Fan(const configuration::RigFile& rig,
                const std::vector<uncertainty::Parameter>& parameters,
                const UncertaintyOptions& options) {
  constexpr int kPoints = 400;
  svg::Figure figure;
  figure.columns = 2;
  figure.panel_width = 520;
  auto rigs = uncertainty::DrawRigs(rig, parameters, options.draws, options.seed);
  rigs.push_back(rig);  // drawn last, on top
  for (const double rpm : options.rig.speeds_rpm) {
    const std::size_t first = figure.panels.size();
    for (const auto& channel : rig.numbers.channels)
      figure.panels.push_back({fmt::format("{} at {:.0f} rpm", channel, rpm), "frequency [Hz]",
                               "|position/current| [um/A]", svg::Scale::kLogarithmic,
                               svg::Scale::kLogarithmic});
    for (std::size_t r = 0; r < rigs.size(); ++r) {
      const uncertainty::UncertainPlant plant(rigs[r], {}, RpmToRadPerS(rpm));
      std::vector<svg::Series> series(rig.numbers.axes());
      for (int i = 0; i < kPoints; ++i) {
        const double hz = 5.0 * std::pow(400.0, i / (kPoints - 1.0));
        const auto at = plant.At(hz);
        for (std::size_t axis = 0; axis < series.size(); ++axis) {
          series[axis].x.push_back(hz);
          const auto k = static_cast<Eigen::Index>(axis);
          series[axis].y.push_back(1e6 * std::abs(at.yu(k, k)));
        }
      }
      for (std::size_t axis = 0; axis < series.size(); ++axis) {
        const bool nominal = r + 1 == rigs.size();
        series[axis].colour = svg::Colour(nominal ? 0 : 1);
        series[axis].width = nominal ? 1.6 : 0.4;
        if (nominal) series[axis].name = "rig file";
        if (r == 0) series[axis].name = "drawn";
        figure.panels[first + axis].series.push_back(std::move(series[axis]));
      }
    }
  }
  return figure;
}

std::string SourceText(const std::string& from) {
  if (from == "stated") return "as stated: +-2 Hz, +-50 % damping, +-5 % ki, +-5 % ks";
  if (from == "tolerances") return "three deviations of the file's tolerances";
  return "three deviations of the identification " + from;
}

ExitStatus Run(const UncertaintyOptions& options) {
  session::CheckOutputPath(options.svg_path, {});
  session::CheckOutputPath(options.rig.json_path, {});
  const auto rig = LoadRig(options.rig);
  const auto parameters = ParametersOf(rig, options.from);
  fmt::print("rig {}, uncertainty {}\n", rig.numbers.name, SourceText(options.from));
  report::TextTable table;
  table.Add({"parameter", "rig file", "least", "most"});
  nlohmann::ordered_json json;
  for (const auto& p : parameters) {
    const std::string name = uncertainty::NameOf(p, rig.numbers.channels);
    table.Add({name, fmt::format("{:.5g}", p.nominal), fmt::format("{:.5g}", p.low),
               fmt::format("{:.5g}", p.high)});
    json["parameters"].push_back(
        {{"name", name}, {"nominal", p.nominal}, {"low", p.low}, {"high", p.high}});
  }
  fmt::print("{}", table.Text());
  if (!options.svg_path.empty()) svg::Write(options.svg_path, Fan(rig, parameters, options));
  WriteJsonFile(options.rig.json_path, json);
  TellWritten({options.svg_path, options.rig.json_path});
  return ExitStatus::kDone;
}

}  // namespace

void AddDesignUncertainty(CLI::App& design, Action& action) {
  auto options = std::make_shared<UncertaintyOptions>();
  CLI::App* command = design.add_subcommand(
      "uncertainty", "By how much the rig may differ: a table, and a fan of Bode curves");
  AddRigOption(*command, options->rig);
  AddSpeedOption(*command, options->rig, {0.0});
  AddUncertaintyOption(*command, options->from);
  command->add_option("--svg", options->svg_path, "Picture to write: |P_ii| of drawn rigs");
  command->add_option("--draws", options->draws, "Rigs drawn for the picture")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the draws")->capture_default_str();
  AddJsonOption(*command, options->rig);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
