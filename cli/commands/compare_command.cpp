// amb compare: synchronous amplitudes and orbits of recorded runs, side by side.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>

#include "cli/commands/command.hpp"
#include "cli/commands/comparison_text.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/text_file.hpp"
#include "common/rotational_speed.hpp"
#include "report/session/comparison_page.hpp"
#include "session/log/output_path.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelp =
    "What of every axis and control current turns with the rotor, as peak amplitude of each order "
    "of rotation, and the largest distance from the centre of the clearance. Only rows without a "
    "test signal count. A speed that is held at most 0.2 % off for 0.2 s is taken from the last "
    "second of the longest such stretch; one that is only passed from the nearest window of four "
    "turns, and marked with ~. Where the rotor stands, the mean is shown.\n"
    "  amb run --scenario run_up_6000 --record pid.lcm\n"
    "  amb run --scenario run_up_6000 --controller other.yaml --record other.lcm\n"
    "  amb compare pid.lcm other.lcm --speeds 0,1600,3000,6000 --orders 1,3 --page c.html "
    "--circle-um 36";

struct CompareOptions : AnalysisOptions {
  std::vector<std::string> paths;
  std::vector<double> orders{1.0};
  std::string page_path;
  double circle_um{};
};

/// The rig and the law that a session says it is of.
void TakeHeader(const std::string& path, bool rig_given, report::RecordToCompare& record) {
  const session::SessionReader reader(path);
  const session::SessionHeader& header = reader.header();
  const std::string within = path + " (header)";
  if (!rig_given) record.rig = configuration::ParseRig(header.rig_yaml, within);
  if (header.controller_yaml.empty()) return;
  const auto controller =
      configuration::ParseController(header.controller_yaml, within, record.rig.numbers);
  record.controller = controller.name;
  record.standstill_rad_per_s = controller.supervisor.sequence.standstill_rad_per_s;
}

std::vector<report::RecordToCompare> Load(const CompareOptions& options) {
  std::map<std::string, int> stems;
  for (const std::string& path : options.paths) ++stems[fs::path(path).stem().string()];
  std::vector<report::RecordToCompare> records;
  for (const std::string& path : options.paths) {
    report::RecordToCompare record;
    record.path = path;
    const std::string stem = fs::path(path).stem().string();
    record.label = stems[stem] > 1 ? path : stem;
    const bool rig_given = !options.rig_name.empty();
    const bool session = session::IsSession(path);
    if (!session && !rig_given) {
      throw Problem(ExitStatus::kUsage, path + " does not say of which rig it is: name it, --rig");
    }
    if (rig_given) record.rig = LoadRig(options);
    if (session) TakeHeader(path, rig_given, record);
    record.recording = session::LoadRecording(path, record.rig);
    records.push_back(std::move(record));
  }
  return records;
}

ExitStatus Run(const CompareOptions& options) {
  for (const std::string& path : options.paths) {
    session::CheckOutputPath(options.json_path, path);
    session::CheckOutputPath(options.page_path, path);
  }
  report::ComparisonRequest request;
  request.orders = options.orders;
  for (const double rpm : options.speeds_rpm) {
    request.speeds_rad_per_s.push_back(std::abs(RpmToRadPerS(rpm)));
  }
  request.over_speed = !options.json_path.empty() || !options.page_path.empty();
  const report::Comparison comparison = report::Compare(Load(options), request);
  const std::string table = ComparisonText(comparison);
  fmt::print("{}", table);
  if (!options.page_path.empty()) {
    WriteTextFile(options.page_path, report::ComparisonPage(comparison, table, options.circle_um));
  }
  WriteJsonFile(options.json_path, ComparisonJson(comparison));
  return ExitStatus::kDone;
}

}  // namespace

void AddCompareCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CompareOptions>();
  options->rig_name.clear();
  CLI::App* command = app.add_subcommand(
      "compare", "Recorded runs side by side: synchronous amplitudes and orbits over speed");
  command->footer(kHelp);
  command
      ->add_option("RECORD", options->paths,
                   "Sessions, CSV or MAT files (docs/formats.md), one or several")
      ->required();
  command->add_option("--rig", options->rig_name,
                      "Rig file or shipped name; default: the one in the session, so that a file "
                      "that is no session needs it");
  command
      ->add_option("--speed-rpm,--speeds", options->speeds_rpm,
                   "Speeds to compare at [rpm]; default: those that the records hold")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1e6));
  command
      ->add_option("--orders", options->orders,
                   "Multiples of the speed, of each bearing's own shaft; several by commas")
      ->delimiter(',')
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  auto* page = command->add_option("--page", options->page_path,
                                   "Write one HTML page to this file: table, orbits, curves");
  command
      ->add_option("--circle-um", options->circle_um,
                   "Radius of the objective, drawn about the orbits of the page [um]")
      ->needs(page)
      ->check(CLI::Range(0.1, 1e5));
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
