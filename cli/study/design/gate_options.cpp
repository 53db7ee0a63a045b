#include "cli/study/design/gate_options.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "cli/study/design/identified_deviations.hpp"
#include "cli/study/progress_line.hpp"
#include "common/rotational_speed.hpp"
#include "report/text/text_table.hpp"

namespace levitas::cli {
namespace {

std::string PeakText(const design::Peak& peak) {
  return fmt::format("{:.2f} at {:.1f} Hz, {:.0f} rpm", peak.value, peak.hz,
                     RadPerSToRpm(peak.speed_rad_per_s));
}

std::string Micrometres(const std::vector<double>& values) {
  std::string out;
  for (const double value : values)
    out += fmt::format("{}{:.1f}", out.empty() ? "" : "/", 1e6 * value);
  return out;
}

nlohmann::ordered_json PeakJson(const design::Peak& peak) {
  return {{"value", peak.value},
          {"frequency_hz", peak.hz},
          {"speed_rpm", RadPerSToRpm(peak.speed_rad_per_s)}};
}

/// Poles, laws, |S| and mu.
void PrintLoops(const configuration::RigFile& rig, const GateCommandOptions& options,
                const design::GateOptions& gate, const design::GateResult& result) {
  fmt::print("poles    {} loops from rest to {:.0f} rpm and {} corners: largest |z| {:.6f}\n",
             result.loops, gate.over_speed * RadPerSToRpm(rig.numbers.max_speed_rad_per_s),
             options.corners, result.pole_modulus);
  if (result.rungs > 0)
    fmt::print("laws     {} of the schedule, each at its speed{}\n", result.rungs,
               !result.run_up        ? ""
               : result.run_up->lost ? "; the rotor is lost in a run-up through them and back"
                                     : fmt::format("; run-up through them and back: orbit {} um",
                                                   Micrometres(result.run_up->orbit_m)));
  if (result.exchanges > 0)
    fmt::print("exchange {} of laws, each law judged as far beyond it as it may act\n",
               result.exchanges);
  fmt::print("|S|      {}; corners {}; largest singular value {}\n", PeakText(result.sensitivity),
             PeakText(result.corner_sensitivity), PeakText(result.singular));
  fmt::print("mu       at most {}, real parameters; were they complex, {}\n", PeakText(result.mu),
             PeakText(result.mu_complex));
  if (result.mu.value > 1.0 && !gate.mu) {
    fmt::print(
        "         above 1 is no instability: with currents and orbits weighed as for the "
        "flexible_rotor's design, some rig of the uncertainty exceeds them; a limit with "
        "--most-mu\n");
  }
}

/// Of the drawn rigs on the nonlinear plant.
void PrintRuns(const GateCommandOptions& options, const design::GateResult& result) {
  fmt::print("runs     {} drawn rigs on the nonlinear plant{}\n", result.rigs,
             options.third_n > 0.0
                 ? fmt::format(", {:.2f} N at three times the speed", options.third_n)
                 : "");
  if (options.tolerances)
    fmt::print("         drawn within the file's tolerances too: |S| {}\n",
               PeakText(result.drawn_sensitivity));
  report::TextTable table;
  table.Add({"  rpm", "lost", "worst orbit [um]", "median [um]"});
  for (const auto& at : result.drawn)
    table.Add({fmt::format("  {:.0f}", RadPerSToRpm(at.speed_rad_per_s)),
               fmt::format("{}", at.lost), Micrometres(at.worst_orbit_m),
               Micrometres(at.median_orbit_m)});
  fmt::print("{}", table.Text());
}

}  // namespace

void AddUncertaintyOption(CLI::App& command, std::string& from) {
  const CLI::Validator allowed(
      [](std::string& text) {
        const bool known = text == "stated" || text == "tolerances" || text.ends_with(".json");
        return known ? std::string{}
                     : "found '" + text +
                           "', allowed: stated, tolerances, or a .json file of "
                           "amb identify modal --json";
      },
      "stated|tolerances|FILE.json");
  command
      .add_option("--uncertainty", from,
                  "stated (+-2 Hz, +-50 % damping, +-5 % ki, +-5 % ks), tolerances (of the rig "
                  "file, three deviations), or the file that amb identify modal --json wrote "
                  "(three of its deviations)")
      ->check(allowed)
      ->capture_default_str();
}

void AddGateOptions(CLI::App& command, GateCommandOptions& options) {
  command.add_option("--design", options.design_path,
                     "Design file: weights of the judgement, and of the law where one is made");
  AddUncertaintyOption(command, options.from);
  command.add_option("--draws", options.draws, "Rigs drawn for the nonlinear runs")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command.add_flag(
      "--tolerances", options.tolerances,
      "Draw everything else that the rig file's tolerances state, too, and judge poles "
      "and |S| of each rig");
  command.add_option("--corners", options.corners, "Corners of the uncertainty judged by poles")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Of the draws")->capture_default_str();
  command.add_option("--most-sensitivity", options.sensitivity, "Largest |S| of an axis allowed")
      ->check(CLI::Range(1.0, 100.0))
      ->capture_default_str();
  command
      .add_option("--most-corner-sensitivity", options.corner_sensitivity,
                  "Largest |S| allowed at the corners; else it is printed and not judged")
      ->check(CLI::Range(1.0, 100.0));
  command
      .add_option("--most-mu", options.mu, "Largest mu allowed; else it is printed and not judged")
      ->check(CLI::Range(0.01, 100.0));
  command
      .add_option("--third-harmonic", options.third_n,
                  "Force [N] at three times the speed, against rotation, in the nonlinear runs")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
}

std::vector<uncertainty::Parameter> ParametersOf(const configuration::RigFile& rig,
                                                 const std::string& from) {
  if (from == "tolerances") return uncertainty::FromTolerances(rig, 4);
  if (from == "stated") return uncertainty::Stated(rig, {});
  return uncertainty::FromIdentification(rig, ReadIdentifiedDeviations(from));
}

design::DesignFile DesignOf(const GateCommandOptions& options) {
  return options.design_path.empty() ? design::DesignFile{}
                                     : design::LoadDesign(options.design_path);
}

design::GateOptions GateOf(const GateCommandOptions& options,
                           const uncertainty::AnalysisWeights& weights,
                           const configuration::RigFile& rig) {
  design::GateOptions gate;
  gate.draws = options.draws;
  gate.corners = options.corners;
  gate.seed = options.seed;
  gate.sensitivity = options.sensitivity;
  gate.corner_sensitivity = options.corner_sensitivity;
  gate.mu = options.mu;
  gate.third_n = options.third_n;
  gate.tolerances = options.tolerances;
  gate.weights = weights;
  gate.run_speeds_rad_per_s = design::RunSpeeds(rig.numbers.max_speed_rad_per_s);
  return gate;
}

design::GateResult JudgeAndPrint(const configuration::RigFile& rig, const law::LawConfig& law,
                                 const GateCommandOptions& options,
                                 const uncertainty::AnalysisWeights& weights) {
  const design::GateOptions gate = GateOf(options, weights, rig);
  ProgressLine line(stderr, isatty(STDERR_FILENO) != 0);
  auto result =
      design::Judge(rig, law, ParametersOf(rig, options.from), gate,
                    [&](double share, const std::string& what) { line.Show(share, what); });
  line.Close();
  PrintLoops(rig, options, gate, result);
  PrintRuns(options, result);
  if (result.accepted)
    fmt::print("ACCEPTED by the checks above\n");
  else
    fmt::print("NOT ACCEPTED: {}\n", result.reason);
  return result;
}

nlohmann::ordered_json GateJson(const design::GateResult& result) {
  nlohmann::ordered_json json;
  json["accepted"] = result.accepted;
  json["reason"] = result.reason;
  json["loops"] = result.loops;
  json["largest_pole_modulus"] = result.pole_modulus;
  json["sensitivity"] = PeakJson(result.sensitivity);
  json["corner_sensitivity"] = PeakJson(result.corner_sensitivity);
  json["singular_value"] = PeakJson(result.singular);
  json["mu_upper"] = PeakJson(result.mu);
  json["mu_upper_complex"] = PeakJson(result.mu_complex);
  if (result.rungs > 0) json["schedule_laws"] = result.rungs;
  if (result.exchanges > 0) json["exchanges"] = result.exchanges;
  if (result.run_up)
    json["run_up"] = {{"lost", result.run_up->lost}, {"orbit_m", result.run_up->orbit_m}};
  json["drawn_rigs"] = result.rigs;
  json["drawn_sensitivity"] = PeakJson(result.drawn_sensitivity);
  for (const auto& at : result.drawn)
    json["speeds"].push_back({{"speed_rpm", RadPerSToRpm(at.speed_rad_per_s)},
                              {"lost", at.lost},
                              {"worst_orbit_m", at.worst_orbit_m},
                              {"median_orbit_m", at.median_orbit_m}});
  return json;
}

}  // namespace levitas::cli
