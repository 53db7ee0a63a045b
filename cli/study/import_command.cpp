// amb import: measured data of others becomes a session.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.hpp"
#include "cli/commands/study_commands.hpp"
#include "cli/json_file.hpp"
#include "cli/options/enter_session.hpp"
#include "cli/study/suggested_map.hpp"
#include "configuration/rig_file.hpp"
#include "levitas_version.hpp"
#include "rt/say.hpp"
#include "session/exchange/candump_import.hpp"
#include "session/exchange/coil_scales.hpp"
#include "session/exchange/column_guess.hpp"
#include "session/exchange/column_map.hpp"
#include "session/exchange/csv_import.hpp"
#include "session/exchange/recording.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kImportHelp =
    "The columns of the file are known by their names (docs/formats.md), or by a map. For a file "
    "of "
    "your own:\n"
    "  amb import mine.csv --rig my_rig.yaml --guess > map.yaml    # what each column probably is\n"
    "  amb import mine.csv --rig my_rig.yaml --map map.yaml --out mine.lcm\n"
    "Check the map in between, signs and offsets above all. With --suggest the map mends what law "
    "and rig show to be wrong: exchanged and reversed columns, units, times (docs/diagnosis.md).";

struct ImportCommandOptions {
  std::string data_path;
  std::string map_path;
  bool guess{false};
  bool suggest{false};
  std::string rig_name;
  std::string out_path;
  std::string json_path;
  bool overwrite{false};
  std::vector<std::string> tags;
};

std::int64_t UtcNowNs() {
  using std::chrono::duration_cast;
  using std::chrono::nanoseconds;
  return duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// What a column that was left out may have been, where the record now lacks just that.
std::string MayBe(const std::string& name, const session::ImportReport& report,
                  const RigNumbers& rig) {
  const auto guess = session::GuessColumns({{name}, {""}, {{}}}, rig);
  const std::string& quantity = guess.columns.front().quantity;
  const bool test_signal = quantity.starts_with("excitation_") && !report.has_excitation;
  const bool rotation = (quantity == "speed" || quantity == "rotor_angle") && !report.has_rotation;
  if (!test_signal && !rotation) return {};
  return fmt::format("; it may be {} (amb import --guess, --map)", quantity);
}

void Print(const std::string& out_path, const session::ImportReport& report,
           const RigNumbers& rig) {
  fmt::print("{}: {} samples over {:.4f} s", rt::OneLine(out_path), report.rows, report.duration_s);
  fmt::print(", rotation {}", report.has_rotation ? "known" : "not given: taken as standing");
  fmt::print(", excitation {}\n", report.has_excitation ? "known" : "not given: taken as none");
  if (report.drop_outs > 0) {
    fmt::print("{} drop-outs in time, {} samples missing in them\n", report.drop_outs,
               report.missing_cycles);
  }
  for (const auto& name : report.ignored_columns) {
    fmt::print("column \"{}\" ignored{}\n", rt::OneLine(name), MayBe(name, report, rig));
  }
  for (const auto& column : report.implausible) rt::Say("amb: warning: " + column.sentence);
}

ExitStatus ImportBusLog(const ImportCommandOptions& options, const configuration::RigFile& rig,
                        const session::ImportOptions& import) {
  if (rig.buses.empty()) {
    throw BadInput(options.rig_name + ": names no CAN buses (section buses, docs/real_rig.md)");
  }
  const can::Layout layout = can::MakeLayout(rig.numbers, can::FormatOf(rig.buses));
  const session::CandumpReport report = session::ImportCandump(import, layout);
  fmt::print("{}: {} samples over {:.4f} s of the rig's count, from {} lines\n", options.out_path,
             report.records, report.duration_s, report.lines);
  fmt::print(
      "{} samples missing, {} without currents of their own, {} frames damaged, {} copies or "
      "out of order, {} restarts of the rig, {} other lines\n",
      report.missing_cycles, report.without_answer, report.damaged, report.out_of_order,
      report.rig_restarts, report.other_lines);
  EnterSession(options.out_path, options.tags);
  WriteJsonFile(options.json_path, {{"data", options.data_path},
                                    {"rig", rig.numbers.name},
                                    {"session", options.out_path},
                                    {"samples", report.records},
                                    {"duration_s", report.duration_s},
                                    {"missing_samples", report.missing_cycles},
                                    {"without_answer", report.without_answer},
                                    {"damaged", report.damaged},
                                    {"out_of_order", report.out_of_order},
                                    {"rig_restarts", report.rig_restarts},
                                    {"other_lines", report.other_lines}});
  return ExitStatus::kDone;
}

bool IsBusLog(const std::string& path) {
  return path.ends_with(".log") || path.ends_with(".log.xz");
}

/// Of a guess: a map for a person to confirm.
ExitStatus Guess(const ImportCommandOptions& options) {
  session::CheckOutputPath(options.json_path, options.data_path);
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig(options.rig_name, "rigs"));
  const session::ColumnGuess guess = session::GuessColumns(
      options.data_path.ends_with(".mat")
          ? session::SampleMat(options.data_path, rig.log.matrix, rig.log.rows)
          : session::SampleColumns(options.data_path),
      rig.numbers);
  fmt::print("{}", rt::Printable(session::GuessText(
                       guess, rig.numbers, options.data_path,
                       fmt::format("amb import {} --rig {} --map MAP.yaml --out SESSION.lcm",
                                   options.data_path, options.rig_name))));
  nlohmann::ordered_json json{{"data", options.data_path}, {"rig", rig.numbers.name}};
  json["columns"] = nlohmann::ordered_json::array();
  for (const auto& column : guess.columns) {
    json["columns"].push_back({{"column", column.column},
                               {"is", column.quantity},
                               {"unit", column.unit},
                               {"unit_by_values", column.unit_by_values}});
  }
  json["missing"] = guess.missing;
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

/// Of the errors that the record itself has: a map that mends them.
ExitStatus Suggest(const ImportCommandOptions& options) {
  session::CheckOutputPath(options.json_path, options.data_path);
  // What is not called a session may be a file of columns with an ending of its own; one that holds
  // a session after all is refused when it is read.
  const std::string name = std::filesystem::path(options.data_path).filename().string();
  const bool session =
      session::IsSession(options.data_path) && name.find(".lcm") != std::string::npos;
  if (IsBusLog(options.data_path) || session) {
    throw Problem(
        ExitStatus::kUsage,
        "--suggest: sessions and logs of candump have no columns; give a CSV or MAT file");
  }
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig(options.rig_name, "rigs"));
  const bool mapped = !options.map_path.empty();
  const session::ColumnMap present =
      mapped ? session::LoadColumnMap(options.map_path) : session::ColumnMap{};
  const SuggestedMap map =
      SuggestMap(options.data_path, rig, mapped ? &present : nullptr,
                 fmt::format("amb import {} --rig {} --map MAP.yaml --out SESSION.lcm",
                             options.data_path, options.rig_name));
  fmt::print("{}", rt::Printable(map.text));
  nlohmann::ordered_json json{{"data", options.data_path}, {"rig", rig.numbers.name}};
  json["record_errors"] = nlohmann::ordered_json::array();
  for (const diagnosis::RecordError& error : map.found.errors) {
    json["record_errors"].push_back({{"kind", diagnosis::Name(error.kind)},
                                     {"channels", error.columns},
                                     {"size", error.size},
                                     {"sentence", error.sentence},
                                     {"mend", error.mend},
                                     {"by_map", error.by_map}});
    if (error.by_map) continue;
    fmt::print(stderr, "{}: {}: {}\n", rt::OneLine(options.data_path), error.sentence, error.mend);
  }
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

void CheckImport(const ImportCommandOptions& options) {
  if (options.out_path.empty()) {
    throw Problem(
        ExitStatus::kUsage,
        "--out is required: the session to write (or --guess, --suggest, which write none)");
  }
  if (!options.map_path.empty() && IsBusLog(options.data_path)) {
    throw Problem(ExitStatus::kUsage,
                  "--map: a log of candump has no columns, its frames say what they hold");
  }
  for (const std::string& path : {options.out_path, options.json_path}) {
    session::CheckOutputPath(path, options.data_path);
  }
  session::CheckNoRecording(options.out_path, options.overwrite);
}

nlohmann::ordered_json ImportJson(const ImportCommandOptions& options, const RigNumbers& rig,
                                  const session::ImportReport& report) {
  std::vector<std::string> warnings;
  for (const auto& column : report.implausible) warnings.push_back(column.sentence);
  return {{"data", options.data_path},
          {"rig", rig.name},
          {"session", options.out_path},
          {"samples", report.rows},
          {"duration_s", report.duration_s},
          {"drop_outs", report.drop_outs},
          {"missing_samples", report.missing_cycles},
          {"has_rotation", report.has_rotation},
          {"has_excitation", report.has_excitation},
          {"has_coil_currents", report.has_coil_currents},
          {"ignored_columns", report.ignored_columns},
          {"warnings", warnings}};
}

ExitStatus Import(const ImportCommandOptions& options) {
  if (options.guess) return Guess(options);
  if (options.suggest) return Suggest(options);
  CheckImport(options);
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig(options.rig_name, "rigs"));
  session::ImportOptions import{.data_path = options.data_path,
                                .out_path = options.out_path,
                                .rig = rig.numbers,
                                .rig_yaml = configuration::WriteRig(rig),
                                .program_version = LEVITAS_VERSION,
                                .start_utc_ns = UtcNowNs(),
                                .coils = session::CoilScales(rig.plant, rig.numbers.axes()),
                                .matrix = rig.log.matrix,
                                .matrix_rows = rig.log.rows};
  session::ColumnMap map;
  if (!options.map_path.empty()) {
    map = session::LoadColumnMap(options.map_path);
    import.map = &map;
  }
  if (IsBusLog(options.data_path)) return ImportBusLog(options, rig, import);
  const session::ImportReport report =
      options.data_path.ends_with(".mat") ? session::ImportMat(import) : session::ImportCsv(import);
  Print(options.out_path, report, rig.numbers);
  EnterSession(options.out_path, options.tags);
  WriteJsonFile(options.json_path, ImportJson(options, rig.numbers, report));
  return ExitStatus::kDone;
}

}  // namespace

void AddImportCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ImportCommandOptions>();
  CLI::App* command = AddStudyCommand(app, "import");
  command->footer(kImportHelp);
  command
      ->add_option(
          "DATA", options->data_path,
          "CSV file or log of candump (.log), either compressed by xz (.xz), or MAT file (.mat)")
      ->required();
  command->add_option("--rig", options->rig_name, "Rig file, or name of a shipped one")->required();
  command->add_option("--out", options->out_path,
                      "Session to write; required without --guess or --suggest");
  auto* map = command->add_option("--map", options->map_path,
                                  "Map of columns: what each column of the file is, its unit, sign "
                                  "and offset (docs/formats.md)");
  auto* guess = command->add_flag(
      "--guess", options->guess,
      "Print a map of columns as it probably is, for you to check; write no session");
  guess->excludes(map);
  command
      ->add_flag(
          "--suggest", options->suggest,
          "Print the map of columns that mends the errors of the record: exchanged, reversed, "
          "in another unit, times; of --map, where one is given; write no session")
      ->excludes(guess);
  command->add_flag("--overwrite", options->overwrite, "Replace a session that is there already");
  command->add_option("--tag", options->tags,
                      "Tag in the catalogue (amb sessions); may be repeated");
  command->add_option("--json", options->json_path, "Write what was done as JSON");
  command->callback([options, &action] { action = [options] { return Import(*options); }; });
}

}  // namespace levitas::cli
