// amb identify frf: the frequency response of a levitated rig from a recorded campaign.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/rig_of_records.hpp"
#include "cli/study/identify/identify_commands.hpp"
#include "cli/study/written_files.hpp"
#include "common/rotational_speed.hpp"
#include "identification/frf/measured_sensitivity.hpp"
#include "report/identification/response_files.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kFrfHelp =
    "Closed loop, P = G Q^-1: from the excitation of each axis in turn to positions and currents. "
    "Read are signals that repeat (PRBS, multisine, strokes), the first period of which is dropped "
    "as transient, and sines held one after the other, of which the second half counts. Whole "
    "periods leak nothing, and their scatter is the variance. A signal may be added to "
    "the current or to the reading (point: measured_position of a scenario), the same for all axes "
    "at one speed. The largest of many noisy lines is too high: |S| is fitted over neighbouring "
    "lines (column fitted) and its noise's share is taken off; the largest single line stands "
    "beside it.\n"
    "  amb run --scenario identify --record campaign.lcm\n"
    "  amb identify frf campaign.lcm --csv frf.csv --svg frf.svg\n"
    "Scenarios identify_multisine, identify_impulse and identify_stepped_sine do it otherwise.\n"
    "The picture is of the first speed; --speed-rpm chooses another.";

struct FrfOptions : AnalysisOptions {
  std::string data_path;
  std::string csv_path;
  std::string svg_path;
  double picture_rpm{0.0};
  std::size_t dropped_periods{1};
  double highest_hz{5000.0};
  double orbit_bound_um{0.0};
};

/// Share of the lines below 1 kHz on which the noise is below a tenth of the response.
double ClearShare(const FrequencyResponse& r, Eigen::Index i, Eigen::Index j) {
  std::size_t clear = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < r.frequency_hz.size() && r.frequency_hz[k] < 1000.0; ++k) {
    ++count;
    if (std::sqrt(r.variance[k](i, j)) < 0.1 * std::abs(r.plant[k](i, j))) ++clear;
  }
  return count > 0 ? static_cast<double>(clear) / static_cast<double>(count) : 0.0;
}

void Print(const FrequencyResponse& r, double orbit_bound_um) {
  fmt::print(
      "\n{:.0f} rpm: {} lines, {:.3f} to {:.0f} Hz, {} periods averaged, {} lines next to orders "
      "of rotation left out\n",
      RadPerSToRpm(r.speed_rad_per_s), r.frequency_hz.size(), r.frequency_hz.front(),
      r.frequency_hz.back(), r.periods, r.left_out_hz.size());
  fmt::print("largest orbit {:.1f} um{}, largest control current {:.3f} A\n",
             1e6 * r.largest_orbit_m,
             orbit_bound_um > 0.0 ? fmt::format(" (bound {:.1f} um)", orbit_bound_um) : "",
             r.largest_current_a);
  fmt::print("lines below 1 kHz with less than 10 % noise, from (columns) to (rows):\n{:<8}", "");
  for (const auto& channel : r.channels) fmt::print("{:>8}", channel);
  for (Eigen::Index i = 0; i < r.axes(); ++i) {
    fmt::print("\n{:<8}", r.channels[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < r.axes(); ++j) fmt::print("{:>6.0f} %", 100 * ClearShare(r, i, j));
  }
  fmt::print("\n");
}

/// Computed with the controller that the user names; empty without one.
std::vector<double> ComputedPeaks(const FrequencyResponse& r, const configuration::RigFile& rig,
                                  const std::optional<FoundController>& controller) {
  std::vector<double> peaks;
  if (!controller) return peaks;
  for (const auto& axis :
       analysis::SensitivityPeaks(rig.plant, controller->file.law, r.speed_rad_per_s).axes) {
    peaks.push_back(axis.peak);
  }
  return peaks;
}

void PrintSensitivity(const FrequencyResponse& r, const std::vector<double>& computed) {
  fmt::print(
      "measured sensitivity, excited at the {}, zones of ISO 14839-3:\n"
      "{:<8}{:>9}{:>9}{:>10}{:>11}{:>9}{:>13}   {}\n",
      r.point == identification::SummingPoint::kReading ? "reading" : "current", "axis", "max |S|",
      "sigma", "at Hz", "lines Hz", "fitted", "single line", "zone");
  const auto measured = identification::MeasuredPeaks(r);
  for (const auto& peak : measured) {
    fmt::print("{:<8}{:>9.3f}{:>9.3f}{:>10.2f}{:>11.3f}{:>9}{:>13.3f}   {}\n", peak.channel,
               peak.peak, peak.sigma, peak.frequency_hz, peak.spacing_hz, peak.lines,
               peak.line_peak,
               peak.zone ? std::string(analysis::Name(*peak.zone)) : "none: " + peak.refused);
  }
  for (std::size_t i = 0; i < computed.size(); ++i) {
    const bool apart = measured[i].zone && identification::Disagree(computed[i], measured[i].peak);
    fmt::print("{:<8}{:>9.3f}   computed{}\n", measured[i].channel, computed[i],
               apart ? fmt::format("; WARNING: measured {:.3f}, more than 20 % apart: the rig file "
                                   "or the controller is not what runs",
                                   measured[i].peak)
                     : "");
  }
}

void RefuseWideOrbits(const std::vector<FrequencyResponse>& responses, double bound_um) {
  if (bound_um <= 0.0) return;
  for (const FrequencyResponse& r : responses) {
    if (1e6 * r.largest_orbit_m <= bound_um) continue;
    throw Problem(ExitStatus::kOther,
                  fmt::format("the orbit reached {:.1f} um at {:.0f} rpm, bound {:.1f} um: excite "
                              "with {:.0f} % of the amplitude",
                              1e6 * r.largest_orbit_m, RadPerSToRpm(r.speed_rad_per_s), bound_um,
                              1e-4 * bound_um / r.largest_orbit_m));
  }
}

ExitStatus Run(const FrfOptions& options) {
  for (const std::string& path : {options.csv_path, options.svg_path, options.json_path}) {
    session::CheckOutputPath(path, options.data_path);
  }
  const configuration::RigFile rig = LoadRigOfRecords(options, {options.data_path});
  std::optional<FoundController> controller;
  if (!options.controller_name.empty()) controller = LoadController(options, rig);
  const auto record = session::LoadRecording(options.data_path, rig);
  const double delay_s = rig.plant.delay_samples * rig.numbers.period_s();
  identification::ExperimentOptions experiment;
  experiment.dropped_periods = options.dropped_periods;
  identification::ResponseOptions response;
  response.highest_hz = options.highest_hz;
  const auto responses = identification::EstimateResponses(record, delay_s, experiment, response);
  fmt::print("{}: frequency response of {} at {} speed(s)\n", options.data_path, rig.numbers.name,
             responses.size());
  for (const auto& r : responses) {
    Print(r, options.orbit_bound_um);
    PrintSensitivity(r, ComputedPeaks(r, rig, controller));
  }
  report::WriteResponseCsv(options.csv_path, responses);
  const auto nearest = std::ranges::min_element(responses, {}, [&](const auto& r) {
    return std::abs(RadPerSToRpm(r.speed_rad_per_s) - options.picture_rpm);
  });
  report::WriteBode(options.svg_path, *nearest);
  nlohmann::ordered_json json{{"data", options.data_path}, {"rig", rig.numbers.name}};
  for (const auto& r : responses) json["responses"].push_back(report::ResponseJson(r));
  WriteJsonFile(options.json_path, json);
  TellWritten({options.csv_path, options.svg_path, options.json_path});
  RefuseWideOrbits(responses, options.orbit_bound_um);
  return ExitStatus::kDone;
}

}  // namespace

void AddIdentifyFrf(CLI::App& identify, Action& action) {
  auto options = std::make_shared<FrfOptions>();
  CLI::App* command =
      identify.add_subcommand("frf", "Frequency response in closed loop, with its variance");
  command->footer(kFrfHelp);
  command->add_option("DATA", options->data_path, "Session, or CSV file (.csv, .csv.xz)")
      ->required();
  AddRigOfRecordsOption(*command, *options);
  command->add_option("--controller", options->controller_name,
                      "Hold the measured sensitivity against that computed with this controller");
  command->add_option("--drop", options->dropped_periods, "Periods taken as transient")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--highest-hz", options->highest_hz, "Lines beyond it are left out")
      ->check(CLI::Range(10.0, 1e6))
      ->capture_default_str();
  command
      ->add_option("--orbit-um", options->orbit_bound_um,
                   "Exit status 1 when the orbit left this radius meanwhile; 0 = no bound")
      ->check(CLI::Range(0.0, 1e4))
      ->capture_default_str();
  command->add_option("--csv", options->csv_path, "Write the response to this file");
  command->add_option("--svg", options->svg_path, "Draw magnitude and phase into this file");
  command->add_option("--speed-rpm", options->picture_rpm, "Speed of the picture")
      ->capture_default_str();
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
