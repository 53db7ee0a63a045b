// amb export: a session as CSV for other tools.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "cli/session_text.hpp"
#include "session/csv_export.hpp"
#include "session/output_path.hpp"

namespace levitas::cli {
namespace {

struct ExportOptions {
  std::string session_path;
  std::string csv_path;
  std::string json_path;
};

ExitStatus Export(const ExportOptions& options) {
  for (const std::string& path : {options.csv_path, options.json_path}) {
    session::CheckOutputPath(path, options.session_path);
  }
  session::SessionReader reader(options.session_path);
  const session::ExportReport report = session::ExportCsv(reader, options.csv_path);
  const session::Damage& damage = reader.damage();
  fmt::print("{}\n", Describe(options.session_path, reader.header()));
  fmt::print("{}: {} rows", options.csv_path, report.rows);
  if (report.cycles_without_frame > 0) {
    fmt::print("; {} cycles had no sensor frame and have no row", report.cycles_without_frame);
  }
  fmt::print("\n");
  PrintDamage(damage);
  WriteJsonFile(options.json_path, {{"session", options.session_path},
                                    {"csv", options.csv_path},
                                    {"rows", report.rows},
                                    {"cycles_without_frame", report.cycles_without_frame},
                                    {"damage", DamageJson(damage)}});
  return ExitStatus::kDone;
}

}  // namespace

void AddExportCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "A session as CSV for other tools");
  command->add_option("SESSION", options->session_path, "Session or trip file")->required();
  command->add_option("--csv", options->csv_path, "CSV file to write")->required();
  command->add_option("--json", options->json_path, "Write what was done as JSON");
  command->callback([options, &action] { action = [options] { return Export(*options); }; });
}

}  // namespace levitas::cli
