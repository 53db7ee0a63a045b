// amb bench mesh: what synchronous control does to gears, their housing and their torsion.

#include "cli/study/bench_mesh.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmark/gears/quiet_mesh.hpp"
#include "benchmark/gears/torque_impact.hpp"
#include "cli/json_file.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "report/text/text_table.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kHelp =
    "The nonlinear rig at steady speeds of its first shaft: without current, with its law alone, "
    "and with blocks of either target (rows vibration and current) at the orders of both shafts "
    "and of the teeth, as many harmonics as the coils reach. Prints the rms of the displacement at "
    "the probes, of each "
    "shaft's force on the housing, of the torque in each shaft, and the levels against the rig "
    "without current. Figures are the plant's own, not what a probe reads.\n"
    "--impact-n-m hits the last inertia of the last shaft instead, and prints how far the torque "
    "of "
    "each shaft leaves that without the impact: with the law, and with the currents beside it that "
    "make the squares of what the teeth pass on least, once the impact has begun or known "
    "beforehand.\n"
    "Example: amb bench mesh --rig geared_rotor_12dof --hz 15,22,29";

struct MeshOptions {
  std::string rig{"geared_rotor_12dof"};
  std::string controller;
  std::vector<double> hz{15.0, 22.0, 29.0};
  double impact_n_m{};
  double impact_ms{2.0};
  std::string json_path;
};

nlohmann::ordered_json Json(const gears::Quiet& quiet, const gears::Quiet& off) {
  nlohmann::ordered_json json{{"displacement_rms_m", quiet.displacement_m},
                              {"housing_force_rms_n", quiet.housing_n},
                              {"torque_rms_n_m", quiet.torque_n_m},
                              {"orders", quiet.orders},
                              {"trouble", quiet.trouble}};
  for (std::size_t s = 0; s < quiet.housing_n.size(); ++s) {
    json["housing_level_db"].push_back(gears::Decibel(quiet.housing_n[s], off.housing_n[s]));
  }
  return json;
}

std::vector<std::string> Row(double hz, const char* what, const gears::Quiet& quiet,
                             const gears::Quiet& off) {
  std::vector<std::string> row{fmt::format("{:.1f}", hz), what,
                               fmt::format("{:.2f}", 1e6 * quiet.displacement_m)};
  for (std::size_t s = 0; s < quiet.housing_n.size(); ++s) {
    row.push_back(fmt::format("{:.2f} ({:+.1f} dB)", quiet.housing_n[s],
                              gears::Decibel(quiet.housing_n[s], off.housing_n[s])));
  }
  for (const double torque : quiet.torque_n_m) row.push_back(fmt::format("{:.3f}", torque));
  std::string blocks;
  for (const double order : quiet.orders) {
    blocks += fmt::format("{}{:g}", blocks.empty() ? "orders " : ", ", order);
  }
  row.push_back(quiet.trouble.empty() ? blocks : "TRIPPED: " + quiet.trouble);
  return row;
}

nlohmann::ordered_json Json(const gears::Passed& passed) {
  return {{"torque_peak_n_m", passed.torque_n_m},
          {"largest_current_a", passed.current_a},
          {"saturated", passed.saturated},
          {"tripped", passed.tripped}};
}

std::vector<std::string> Row(double hz, const char* what, const gears::Passed& passed,
                             const gears::Passed& law) {
  std::vector<std::string> row{fmt::format("{:.1f}", hz), what};
  for (std::size_t s = 0; s < passed.torque_n_m.size(); ++s) {
    row.push_back(fmt::format("{:.3g} ({:+.1f} %)", passed.torque_n_m[s],
                              100.0 * (passed.torque_n_m[s] / law.torque_n_m[s] - 1.0)));
  }
  row.push_back(fmt::format("{:.2f}{}", passed.current_a,
                            passed.tripped     ? ", TRIPS"
                            : passed.saturated ? ", at its limit"
                                               : ""));
  return row;
}

void RunImpacts(const MeshOptions& options, const configuration::RigFile& rig,
                const configuration::ControllerFile& controller, nlohmann::ordered_json& json) {
  const gears::Impact impact{options.impact_n_m, 1e-3 * options.impact_ms};
  report::TextTable table;
  for (const double hz : options.hz) {
    const auto relief = gears::Relieve(rig, controller, RpmToRadPerS(60.0 * hz), impact);
    if (json["impacts"].empty()) {
      std::vector<std::string> head{"Hz", ""};
      for (const std::string& twisted : relief.twisted) head.push_back(twisted);
      head.emplace_back("current A");
      table.Add(head);
    }
    table.Add(Row(hz, "law", relief.law, relief.law));
    table.Add(Row(hz, "added, once it has begun", relief.answered, relief.law));
    table.Add(Row(hz, "added, known beforehand", relief.foreseen, relief.law));
    json["impacts"].push_back({{"speed_hz", hz},
                               {"twisted", relief.twisted},
                               {"law", Json(relief.law)},
                               {"once_begun", Json(relief.answered)},
                               {"known_beforehand", Json(relief.foreseen)}});
  }
  fmt::print("rig {}, controller {}\n", rig.numbers.name, controller.name);
  fmt::print("largest deviation [N m] by an impact of {:g} N m in {:g} ms on the last inertia\n",
             options.impact_n_m, options.impact_ms);
  fmt::print("{}", table.Text());
}

void RunSpeeds(const MeshOptions& options, const configuration::RigFile& rig,
               const configuration::ControllerFile& controller, nlohmann::ordered_json& json) {
  report::TextTable table;
  bool first = true;
  for (const double hz : options.hz) {
    const gears::QuietMesh mesh = gears::Listen(rig, controller, RpmToRadPerS(60.0 * hz));
    if (first) {
      std::vector<std::string> head{"Hz", "", "probes um"};
      for (const auto& shaft : rig.plant.shafts) head.push_back("housing N, " + shaft.name);
      for (const std::string& twisted : mesh.twisted) head.push_back("torque N m, " + twisted);
      head.emplace_back("blocks");
      table.Add(head);
    }
    first = false;
    table.Add(Row(hz, "off", mesh.off, mesh.off));
    table.Add(Row(hz, "law", mesh.law, mesh.off));
    table.Add(Row(hz, "vibration", mesh.still, mesh.off));
    table.Add(Row(hz, "current", mesh.soft, mesh.off));
    json["speeds"].push_back({{"speed_hz", hz},
                              {"twisted", mesh.twisted},
                              {"off", Json(mesh.off, mesh.off)},
                              {"law", Json(mesh.law, mesh.off)},
                              {"vibration", Json(mesh.still, mesh.off)},
                              {"current", Json(mesh.soft, mesh.off)}});
  }
  fmt::print("rig {}, controller {}; rms of one second, levels against the rig without current\n",
             rig.numbers.name, controller.name);
  fmt::print("{}", table.Text());
}

ExitStatus Run(const MeshOptions& options) {
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig(options.rig, "rigs"));
  gears::RefuseWithoutGears(rig);
  const std::string& name = options.controller.empty() ? rig.run.controller : options.controller;
  if (name.empty()) {
    throw BadInput(rig.numbers.name + ": the rig names no controller; give one with --controller");
  }
  const configuration::ControllerFile controller =
      configuration::LoadController(configuration::FindConfig(name, "controllers"), rig.numbers);
  nlohmann::ordered_json json{{"rig", rig.numbers.name}, {"controller", controller.name}};
  if (options.impact_n_m != 0.0) {
    RunImpacts(options, rig, controller, json);
  } else {
    RunSpeeds(options, rig, controller, json);
  }
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

}  // namespace

void AddBenchMesh(CLI::App& bench, Action& action) {
  auto options = std::make_shared<MeshOptions>();
  CLI::App* command = bench.add_subcommand(
      "mesh", "Gears without current, with the law, and with synchronous control");
  command->footer(kHelp);
  command->add_option("--rig", options->rig, "Rig file, or the name of a shipped rig")
      ->capture_default_str();
  command->add_option("--controller", options->controller,
                      "Controller file or shipped name; default: the rig's own");
  command->add_option("--hz", options->hz, "Rotations of the first shaft")
      ->delimiter(',')
      ->check(CLI::Range(0.5, 1000.0))
      ->capture_default_str();
  CLI::Option* impact = command->add_option("--impact-n-m", options->impact_n_m,
                                            "Torque impact on the last inertia, at a steady speed");
  impact->check(CLI::Range(0.001, 1e6));
  command->add_option("--impact-ms", options->impact_ms, "How long it lasts")
      ->needs(impact)
      ->check(CLI::Range(0.1, 50.0))
      ->capture_default_str();
  command->add_option("--json", options->json_path, "Every figure");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
