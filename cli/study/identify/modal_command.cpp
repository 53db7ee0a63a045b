// amb identify modal: modal model of a rig from its frequency responses.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>
#include <utility>

#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/rig_of_records.hpp"
#include "cli/study/identify/decibel_table.hpp"
#include "cli/study/identify/identify_commands.hpp"
#include "cli/study/identify/start_options.hpp"
#include "cli/study/written_files.hpp"
#include "common/rotational_speed.hpp"
#include "identification/identified_rig.hpp"
#include "identification/modal/modal_starts.hpp"
#include "report/identification/modal_files.hpp"
#include "report/identification/response_files.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

constexpr const char* kModalHelp =
    "Frequencies, damping, deflections, current and position stiffness, rigid body and gyroscopic "
    "matrix, by nonlinear least squares. The rig file is the start and a wide prior. The standing "
    "response and the fastest one are fitted; the others are kept to validate.\n"
    "  amb run --scenario identify --record campaign.lcm\n"
    "  amb identify modal campaign.lcm --out identified.yaml --svg modal\n"
    "The file that --out writes holds the rotor as rigid body and modes, with the deflections and "
    "the\n"
    "gyroscopic matrix that were found; with --rotor shaft the file's shaft stays, and "
    "frequencies\n"
    "and damping are entries of effects.\n"
    "--svg P writes P_bode.svg (data, model, residual), P_validation.svg, P_campbell.svg and "
    "P_stabilisation.svg.";

struct ModalOptions : AnalysisOptions {
  std::string data_path;
  std::string out_path;
  std::string rotor{"modes"};
  std::string svg_prefix;
  ModalFitOptions fit;
  bool decibel_cost{false};
  int starts{0};
  StartSpread spread;
};

void PrintModes(const ModalResult& r) {
  const ModalLayout& at = r.start.frame.layout;
  fmt::print("\nbending modes of the free rotor, +- two standard deviations\n{:>4}{:>24}{:>26}\n",
             "", "Hz", "damping ratio");
  for (Eigen::Index i = 0; i < at.bending; ++i) {
    const double f = r.rig.frequency_rad_per_s[2 + i] / (2.0 * std::numbers::pi);
    const double z = r.rig.damping_ratio[2 + i];
    const ModeSupport& support = r.support[static_cast<std::size_t>(i)];
    if (support.support == Support::kNotShown) {
      fmt::print("{:>4}{:>14.3f}  (the rig file's)   not shown by the data: no stable pole\n",
                 i + 1, f);
      continue;
    }
    fmt::print(
        "{:>4}{:>14.3f} +- {:<7.3f}{:>14.5f} +- {:<8.5f}{}\n", i + 1, f,
        2.0 * f * r.uncertainty.deviation[at.frequency + i], z,
        2.0 * z * r.uncertainty.deviation[at.damping + i],
        support.support == Support::kMoved ? "  NOT TRUSTED: its pole is not the diagram's" : "");
  }
}

void PrintAxes(const ModalResult& r) {
  const ModalLayout& at = r.start.frame.layout;
  fmt::print("\n{:<8}{:>20}{:>24}{:>18}\n", "axis", "ki N/A", "ks N/m", "sensor gain");
  for (Eigen::Index a = 0; a < at.axes(); ++a) {
    fmt::print("{:<8}{:>10.3f} +- {:<7.3f}{:>13.0f} +- {:<8.0f}{:>9.4f} +- {:<7.4f}\n",
               r.channels[static_cast<std::size_t>(a)], r.rig.ki_n_per_a[a],
               2.0 * r.rig.ki_n_per_a[a] * r.uncertainty.deviation[at.ki + a], r.rig.ks_n_per_m[a],
               2.0 * r.rig.ks_n_per_m[a] * r.uncertainty.deviation[at.ks + a], r.rig.gain[a],
               2.0 * r.rig.gain[a] * r.uncertainty.deviation[at.gain + a]);
  }
  fmt::print("{:<8}{:>20}{:>24}   (identifiable from responses alone)\n", "", "ki gain/mass",
             "ks/mass");
  for (Eigen::Index a = 0; a < at.axes(); ++a) {
    const double ki = r.rig.ki_n_per_a[a] * r.rig.gain[a] / r.rig.mass_kg;
    const double ks = r.rig.ks_n_per_m[a] / r.rig.mass_kg;
    fmt::print("{:<8}{:>10.3f} +- {:<7.3f}{:>13.0f} +- {:<8.0f}\n",
               r.channels[static_cast<std::size_t>(a)], ki, 2.0 * ki * r.uncertainty.products[a],
               ks, 2.0 * ks * r.uncertainty.products[at.axes() + a]);
  }
  fmt::print(
      "mass {:.4f} kg, transverse inertia {:.5f} kg m2, centre at {:.2f} mm, delay {:.3f} "
      "samples\n",
      r.rig.mass_kg, r.rig.inertia_kg_m2, 1e3 * r.rig.centre_z_m, r.rig.delay_samples);
}

/// [A] mean over the levitated rows.
double StaticCurrent(const session::Recording& record, std::size_t axis) {
  double sum = 0.0;
  std::size_t rows = 0;
  for (std::size_t n = 0; n < record.rows(); ++n) {
    if (record.levitated[n] == 0 || !std::isfinite(record.current_a[axis][n])) continue;
    sum += record.current_a[axis][n];
    ++rows;
  }
  return rows > 0 ? sum / static_cast<double>(rows) : 0.0;
}

/// A current that carries weight stiffens its magnet: dF/dx = 4 k (i0^2 + i^2) / s0^3 of two coils
/// in differential driving mode. A rig file states it without.
void PrintStaticShare(const configuration::RigFile& rig, const session::Recording& record,
                      const ModalResult& r) {
  constexpr double kSeen = 0.01;
  std::vector<std::string> axes;
  for (std::size_t a = 0; a < record.channels.size(); ++a) {
    const double bias_a = rig.plant.bearings[a / 2].magnet.bias_current_a;
    const double static_a = StaticCurrent(record, a);
    const double share = std::pow(static_a / bias_a, 2);
    if (share < kSeen) continue;
    axes.push_back(fmt::format("{} {:.3g} A makes {:.1f} % ({:.0f} N/m without)", r.channels[a],
                               static_a, 100.0 * share,
                               r.rig.ks_n_per_m[static_cast<Eigen::Index>(a)] / (1.0 + share)));
  }
  if (axes.empty()) return;
  fmt::print("ks is that of the working point, with what static currents add, (i/i0)^2: {}\n",
             fmt::join(axes, ", "));
}

void PrintSupport(const ModalResult& r) {
  for (std::size_t i = 0; i < r.support.size(); ++i) {
    const ModeSupport& s = r.support[i];
    if (s.support == Support::kShown) continue;
    if (s.support == Support::kMoved) {
      fmt::print("\nmode {}: the fitted plant has it at {:.1f} Hz, the diagram at {:.1f} Hz\n",
                 i + 1, s.plant_hz, s.shown_hz);
    } else {
      fmt::print("\nmode {}: the data do not determine its frequency and damping\n", i + 1);
    }
    fmt::print("    to determine them: excite more strongly or for more periods around it\n");
  }
}

void PrintStarts(const ModalResult& r, const std::vector<FrequencyResponse>& responses,
                 const ModalOptions& options) {
  if (options.starts == 0) return;
  const StartsOutcome outcome = TryStarts(r, responses, options.starts, options.spread, 1);
  fmt::print(
      "\n{} of {} random starts (+-{:.0f} % on everything, +-{:.0f} % on gains) reach the same "
      "optimum; {:.2f} s each\n",
      outcome.same, outcome.starts, 100.0 * options.spread.everything, 100.0 * options.spread.gains,
      outcome.median_time_s);
}

/// "deflection_3_sensor_de" is one of many: what people need is the mode.
std::string ShortName(const std::string& unknown) {
  constexpr std::string_view kDeflection = "deflection_";
  if (!unknown.starts_with(kDeflection)) return unknown;
  const auto end = unknown.find('_', kDeflection.size());
  return "deflections of mode " + unknown.substr(kDeflection.size(), end - kDeflection.size());
}

std::string Together(const Unidentifiable& direction) {
  std::vector<std::string> names;
  for (const std::string& unknown : direction.unknowns) {
    const std::string name = ShortName(unknown);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, " with "));
}

/// Grouped by the experiment that would determine them, one line per experiment.
void PrintLimits(const ModalResult& r) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const Unidentifiable& direction : r.uncertainty.directions) {
    auto group =
        std::ranges::find(groups, direction.experiment, [](const auto& g) { return g.first; });
    if (group == groups.end()) group = groups.insert(groups.end(), {direction.experiment, {}});
    const std::string text = Together(direction);
    if (std::ranges::find(group->second, text) == group->second.end()) {
      group->second.push_back(text);
    }
  }
  if (!groups.empty()) {
    fmt::print("\nnot separable with these data (values along them are the rig file's):\n");
  }
  for (const auto& [experiment, directions] : groups) {
    fmt::print("  {}\n    experiment: {}\n", fmt::join(directions, "; "), experiment);
  }
  for (const ProposedMode& mode : r.unmatched) {
    fmt::print("\nthe data show a mode at {:.1f} Hz that the rig file does not have\n",
               mode.frequency_hz);
  }
}

void PrintFit(const ModalResult& r) {
  const auto fitted = std::ranges::count(r.fit.fitted, true);
  fmt::print("{} unknowns from {} numbers, {:.2f} s ({})\n", fitted, r.fit.residuals, r.time_s,
             r.fit.converged ? "converged" : "stopped at its iteration limit");
  for (const FitStage& stage : r.fit.stages) {
    fmt::print("  {:<26} cost {:>12.1f} in {:>3} iterations, {:.2f} s\n", stage.name, stage.cost,
               stage.iterations, stage.time_s);
  }
  fmt::print("modes shown by the data up to {:.0f} Hz:", r.options.highest_hz);
  for (const ProposedMode& mode : r.stabilisation.modes) fmt::print(" {:.1f}", mode.frequency_hz);
  fmt::print("{}\n\nmisfit (1: only noise is left) and fit (ceiling: the data's own noise)\n",
             r.stabilisation.modes.empty()
                 ? " none; one that bends the shaft lies above what was excited, or in no shape "
                   "that these test signals reach"
                 : " Hz");
  for (const SpeedQuality& q : r.quality) {
    fmt::print("  {:>6.0f} rpm {:>8.3f} {:>8.2f} % of {:.2f} %  {}\n",
               RadPerSToRpm(q.speed_rad_per_s), q.misfit, q.percent.fit, q.percent.ceiling,
               q.fitted ? "fitted" : "validation, not used in the fit");
  }
}

/// Deviation of the record from the rig file, and from the identified model.
void PrintResiduals(const ModalResult& r) {
  fmt::print("\nresidual per channel, rms in units of what noise allows: rig file -> identified\n");
  for (const SpeedQuality& q : r.quality) {
    fmt::print("  {:>6.0f} rpm", RadPerSToRpm(q.speed_rad_per_s));
    for (Eigen::Index a = 0; a < q.after.size(); ++a) {
      fmt::print("   {} {:.1f} -> {:.2f}", r.channels[static_cast<std::size_t>(a)],
                 std::sqrt(q.before[a]), std::sqrt(q.after[a]));
    }
    fmt::print("\n");
  }
}

ExitStatus Run(const ModalOptions& options) {
  for (const std::string& path : {options.out_path, options.json_path}) {
    session::CheckOutputPath(path, options.data_path);
  }
  const configuration::RigFile rig = LoadRigOfRecords(options, {options.data_path});
  const auto record = session::LoadRecording(options.data_path, rig);
  const double delay_s = rig.plant.delay_samples * rig.numbers.period_s();
  const auto responses = EstimateResponses(record, delay_s, {}, ModalResponseOptions(rig));
  const auto began = std::chrono::steady_clock::now();
  ModalResult result = IdentifyModal(rig, responses, options.fit);
  result.time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  fmt::print("{}: modal model of {}\n", options.data_path, rig.numbers.name);
  PrintFit(result);
  PrintResiduals(result);
  PrintModes(result);
  PrintAxes(result);
  PrintStaticShare(rig, record, result);
  PrintSupport(result);
  PrintLimits(result);
  PrintStarts(result, responses, options);
  auto json = report::ModalJson(result);
  if (options.decibel_cost) {
    const DecibelFit decibels = FitDecibels(result, responses);
    PrintDecibelFit(result, decibels);
    json["decibel_cost"] = report::DecibelJson(result, decibels);
  }
  WriteJsonFile(options.json_path, json);
  std::vector<std::string> written =
      report::WriteModalPictures(options.svg_prefix, result, responses);
  if (!options.out_path.empty()) {
    const RotorForm form = options.rotor == "shaft" ? RotorForm::kShaft : RotorForm::kModes;
    report::WriteRigFile(options.out_path, IdentifiedRig(rig, result, form));
  }
  written.insert(written.begin(), {options.out_path, options.json_path});
  TellWritten(written);
  return ExitStatus::kDone;
}

}  // namespace

void AddIdentifyModal(CLI::App& identify, Action& action) {
  auto options = std::make_shared<ModalOptions>();
  CLI::App* command =
      identify.add_subcommand("modal", "Modes, stiffnesses and gyroscopic matrix, with intervals");
  command->footer(kModalHelp);
  command->add_option("DATA", options->data_path, "Session, or CSV file (.csv, .csv.xz)")
      ->required();
  AddRigOfRecordsOption(*command, *options);
  command->add_option("--highest-hz", options->fit.highest_hz, "Lines beyond it are not fitted")
      ->check(CLI::Range(50.0, 1e5))
      ->capture_default_str();
  command->add_flag("--fit-amplifiers", options->fit.fit_amplifiers,
                    "Bandwidths of the amplifiers are unknown too");
  command->add_flag("--fit-sensors", options->fit.fit_sensors,
                    "Bandwidths of the sensors are unknown too");
  command->add_flag("--decibel-cost", options->decibel_cost,
                    "Fit by errors in decibels with marked regions, too, and compare");
  command->add_option("--starts", options->starts, "Repeat the fit from random starts")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  AddSpreadOptions(*command, options->spread);
  command->add_option("--out", options->out_path, "Write the identified rig file");
  command->add_option("--rotor", options->rotor, "How that file holds the rotor: modes or shaft")
      ->check(CLI::IsMember({"modes", "shaft"}))
      ->capture_default_str();
  command->add_option("--svg", options->svg_prefix, "Draw pictures, their names begin with this");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
