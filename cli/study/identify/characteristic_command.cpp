// amb identify characteristic: a probe's static curve from a table of a positioning platform.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "cli/json_file.hpp"
#include "cli/study/identify/identify_commands.hpp"
#include "cli/study/written_files.hpp"
#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "identification/probe/probe_characteristic.hpp"
#include "report/identification/modal_files.hpp"
#include "rt/say.hpp"
#include "session/exchange/recording.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

constexpr const char* kCharacteristicHelp =
    "The table is a CSV file of two columns, displacement_<m|mm|um|nm> of a positioning platform "
    "and\n"
    "reading_<m|mm|um|nm|v|mv> of the probe, its rows in the order in which they were measured. "
    "Count\n"
    "the displacement from where the rotor is to levitate, along the axis. Go there and back, and\n"
    "repeat: hysteresis and repeatability come of it.\n"
    "  amb identify characteristic probe.csv\n"
    "  amb identify characteristic probe.csv --rig my_rig.yaml --channel ux --out measured.yaml\n"
    "  amb identify hammerstein-wiener run.csv ... --sensor-table ux.csv,uy.csv,lx.csv,ly.csv";

constexpr double kMicro = 1e6;

struct CharacteristicOptions {
  std::string table_path;
  ProbeFitOptions fit;
  double straight_error_um{1.0};
  std::string rig_name;
  std::string channel;
  std::string out_path;
  std::string json_path;
};

/// Readings are printed in um or mV.
struct ReadingUnit {
  double factor;
  const char* name;
};

void PrintPoints(const ProbeCharacteristic& found) {
  fmt::print("of a sensor in a rig file:\n      characteristic:\n");
  for (const sensor::ProbePoint& point : found.points) {
    fmt::print("        - {{displacement_um: {:.4f}, reading_um: {:.4f}}}\n",
               kMicro * point.displacement_m, kMicro * point.reading_m);
  }
}

std::string Judgement(const ProbeCharacteristic& found) {
  if (!found.cubic_suffices) return "not judged, for nothing was measured twice";
  if (*found.cubic_suffices) return "the cubic suffices";
  return fmt::format(
      "NO CUBIC, take the points rather than a2 and a3; they count from the line through the "
      "places about the centre, offset {:.4g} {}, gain {:.5g} {}",
      (found.volts ? 1e3 : kMicro) * found.points_offset, found.volts ? "mV" : "um",
      (found.volts ? 1e-3 : 1.0) * found.points_gain, found.volts ? "V/mm" : "um/um");
}

void Print(const CharacteristicOptions& options, const ProbeCharacteristic& found) {
  const ReadingUnit unit = found.volts ? ReadingUnit{1e3, "mV"} : ReadingUnit{kMicro, "um"};
  const auto line = [](const char* name, const Estimate& e, double factor, const char* in) {
    fmt::print("{:<14}{:>12.6g} +- {:<10.2g} {}\n", name, factor * e.value, factor * e.deviation,
               in);
  };
  fmt::print("{}: {} rows at {} places, {:.4g} to {:.4g} um\n", rt::OneLine(options.table_path),
             found.rows, found.places, kMicro * found.low_m, kMicro * found.high_m);
  fmt::print("reading = offset + gain (x + a2 x^2 + a3 x^3), +- one standard deviation\n");
  line("offset", found.offset, unit.factor, unit.name);
  line("gain", found.gain, found.volts ? 1e-3 : 1.0, found.volts ? "V/mm" : "um/um");
  line("a2", found.a2, 1.0, "1/m");
  line("a3", found.a3, 1.0, "1/m^2");
  if (found.hysteresis) {
    line("hysteresis", *found.hysteresis, unit.factor, unit.name);
    fmt::print("              {:.3g} {} at most of any place (towards + less back)\n",
               unit.factor * found.largest_hysteresis.value_or(0.0), unit.name);
  } else {
    fmt::print("hysteresis    not measured: the platform moved one way only\n");
  }
  if (found.repeatability) {
    fmt::print("repeatability {:>12.3g} {} (one standard deviation)\n",
               unit.factor * *found.repeatability, unit.name);
  } else {
    fmt::print("repeatability not measured: no place was visited twice the same way\n");
  }
  fmt::print("residual      {:>12.3g} {} rms; a place's mean is off by {:.3g} {} at most: {}\n",
             unit.factor * found.residual, unit.name, unit.factor * found.largest_misfit, unit.name,
             Judgement(found));
  fmt::print(
      "straight within {:.4g} um from {:.4g} to {:.4g} um; in the whole table off by {:.4g} "
      "um at most\n",
      options.straight_error_um, kMicro * found.straight_low_m, kMicro * found.straight_high_m,
      kMicro * found.largest_curvature_m);
}

void Put(nlohmann::ordered_json& json, const std::string& name, const std::string& unit,
         const Estimate& estimate) {
  json[name + unit] = estimate.value;
  json[name + "_deviation" + unit] = estimate.deviation;
}

nlohmann::ordered_json JsonOf(const CharacteristicOptions& options,
                              const ProbeCharacteristic& found) {
  const std::string unit = found.volts ? "_v" : "_m";
  nlohmann::ordered_json json{
      {"data", options.table_path}, {"rows", found.rows}, {"places", found.places}};
  Put(json, "offset", unit, found.offset);
  Put(json, "gain", found.volts ? "_v_per_m" : "", found.gain);
  Put(json, "a2", "_1_per_m", found.a2);
  Put(json, "a3", "_1_per_m2", found.a3);
  if (found.hysteresis) {
    Put(json, "hysteresis", unit, *found.hysteresis);
    json["largest_hysteresis" + unit] = found.largest_hysteresis.value_or(0.0);
  }
  if (found.repeatability) json["repeatability" + unit] = *found.repeatability;
  json["residual" + unit] = found.residual;
  json["largest_misfit" + unit] = found.largest_misfit;
  json["cubic_suffices"] =
      found.cubic_suffices ? nlohmann::ordered_json(*found.cubic_suffices) : nullptr;
  json["points_offset" + unit] = found.points_offset;
  json[found.volts ? "points_gain_v_per_m" : "points_gain"] = found.points_gain;
  json["from_m"] = found.low_m;
  json["to_m"] = found.high_m;
  json["straight_error_m"] = options.fit.straight_error_m;
  json["straight_from_m"] = found.straight_low_m;
  json["straight_to_m"] = found.straight_high_m;
  json["largest_curvature_m"] = found.largest_curvature_m;
  json["points"] = nlohmann::ordered_json::array();
  for (const sensor::ProbePoint& point : found.points) {
    json["points"].push_back(
        {{"displacement_m", point.displacement_m}, {"reading_m", point.reading_m}});
  }
  return json;
}

/// The bearing whose probe was measured.
std::size_t BearingOf(const CharacteristicOptions& options, const configuration::RigFile& rig) {
  const auto& channels = rig.numbers.channels;
  const auto at = std::ranges::find(channels, options.channel);
  if (at == channels.end()) {
    std::string all;
    for (const std::string& channel : channels) all += (all.empty() ? "" : ", ") + channel;
    throw Problem(ExitStatus::kUsage, fmt::format("--channel {}: rig {} has {}", options.channel,
                                                  rig.numbers.name, all));
  }
  return static_cast<std::size_t>(at - channels.begin()) / 2;
}

/// Writes the rig with the points as the curve of the bearing.
void WriteWithCurve(const std::string& path, configuration::RigFile rig, std::size_t bearing,
                    const ProbeCharacteristic& found) {
  plant::BearingConfig& config = rig.plant.bearings[bearing];
  config.sensor.characteristic = found.points;
  const std::size_t probes = std::min<std::size_t>(2, rig.numbers.axes() - 2 * bearing);
  fmt::print("bearing {}: the curve is that of {}", config.name,
             probes == 1 ? "its probe" : "both its probes");
  if (config.sensor.gain != 1.0) {
    fmt::print("; gain {:g} of the file multiplies it", config.sensor.gain);
  }
  fmt::print("\n");
  report::WriteRigFile(path, rig);
}

ExitStatus Run(const CharacteristicOptions& given) {
  CharacteristicOptions options = given;
  options.fit.straight_error_m = options.straight_error_um / kMicro;
  const bool some = !options.rig_name.empty() || !options.channel.empty();
  if (options.out_path.empty() ? some : options.rig_name.empty() || options.channel.empty()) {
    throw Problem(ExitStatus::kUsage,
                  "--rig, --channel and --out belong together: the rig file, the probe that was "
                  "measured, and the rig file to write");
  }
  for (const std::string& path : {options.out_path, options.json_path}) {
    session::CheckOutputPath(path, options.table_path);
  }
  std::optional<configuration::RigFile> rig;
  std::size_t bearing = 0;
  if (!options.out_path.empty()) {
    rig = configuration::LoadRig(configuration::FindConfig(options.rig_name, "rigs"));
    bearing = BearingOf(options, *rig);
  }
  if (session::IsSession(options.table_path)) {
    throw BadInput(options.table_path +
                   ": is a recorded session; allowed: a table of a positioning platform, columns "
                   "displacement_um and reading_um (docs/identification.md)");
  }
  const ProbeCharacteristic found =
      FitProbe(ReadPlatformTable(options.table_path), options.table_path, options.fit);
  Print(options, found);
  if (rig) {
    WriteWithCurve(options.out_path, std::move(*rig), bearing, found);
  } else {
    PrintPoints(found);
  }
  WriteJsonFile(options.json_path, JsonOf(options, found));
  TellWritten({options.out_path, options.json_path});
  return ExitStatus::kDone;
}

}  // namespace

void AddIdentifyCharacteristic(CLI::App& identify, Action& action) {
  auto options = std::make_shared<CharacteristicOptions>();
  CLI::App* command = identify.add_subcommand(
      "characteristic", "A probe's static curve, from a table of a positioning platform");
  command->footer(kCharacteristicHelp);
  command->add_option("TABLE", options->table_path, "CSV file (.csv, .csv.xz)")->required();
  command
      ->add_option("--straight-error-um", options->straight_error_um,
                   "Up to which offset and gain alone count as right")
      ->check(CLI::Range(1e-3, 1e4))
      ->capture_default_str();
  command
      ->add_option("--places", options->fit.most_places,
                   "Equal parts of the way whose rows are averaged into a point each")
      ->check(CLI::Range(6, 198))
      ->capture_default_str();
  command->add_option("--rig", options->rig_name, "Rig file, or name of a shipped one, for --out");
  command->add_option("--channel", options->channel, "Channel whose probe was measured");
  command->add_option("--out", options->out_path, "Write the rig with this characteristic");
  command->add_option("--json", options->json_path, "Write the results as JSON");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
