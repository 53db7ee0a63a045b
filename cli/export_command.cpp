// amb export: a session as CSV or MAT file for other tools.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "cli/session_text.hpp"
#include "session/csv_export.hpp"
#include "session/mat_export.hpp"
#include "session/output_path.hpp"

namespace levitas::cli {
namespace {

struct ExportOptions {
  std::string session_path;
  std::string csv_path;
  std::string mat_path;
  std::string json_path;
};

/// Reads the session once for one file.
session::ExportReport Write(const ExportOptions& options, bool mat) {
  session::SessionReader reader(options.session_path);
  const std::string& path = mat ? options.mat_path : options.csv_path;
  const session::ExportReport report =
      mat ? session::ExportMat(reader, path) : session::ExportCsv(reader, path);
  fmt::print("{}: {} rows", path, report.rows);
  if (report.cycles_without_frame > 0) {
    fmt::print("; {} cycles had no sensor frame and have no row", report.cycles_without_frame);
  }
  fmt::print("\n");
  return report;
}

ExitStatus Export(const ExportOptions& options) {
  if (options.csv_path.empty() && options.mat_path.empty()) {
    throw Problem(ExitStatus::kUsage, "nothing to write: name --csv FILE, --mat FILE or both");
  }
  for (const std::string& path : {options.csv_path, options.mat_path, options.json_path}) {
    session::CheckOutputPath(path, options.session_path);
  }
  session::SessionReader reader(options.session_path);
  fmt::print("{}\n", Describe(options.session_path, reader.header()));
  session::ExportReport report;
  for (const bool mat : {false, true}) {
    if (!(mat ? options.mat_path : options.csv_path).empty()) report = Write(options, mat);
  }
  cycle::CycleRecord record;
  while (reader.Next(record)) {
  }  // to its end, for what was lost
  const session::Damage& damage = reader.damage();
  PrintDamage(damage);
  WriteJsonFile(options.json_path, {{"session", options.session_path},
                                    {"csv", options.csv_path},
                                    {"mat", options.mat_path},
                                    {"rows", report.rows},
                                    {"cycles_without_frame", report.cycles_without_frame},
                                    {"damage", DamageJson(damage)}});
  return ExitStatus::kDone;
}

}  // namespace

void AddExportCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "A session as CSV or MAT file for other tools");
  command->add_option("SESSION", options->session_path, "Session or trip file")->required();
  command->add_option("--csv", options->csv_path, "CSV file to write");
  command->add_option("--mat", options->mat_path,
                      "MAT file to write (version 5: MATLAB, Octave, SciPy), a vector per column");
  command->add_option("--json", options->json_path, "Write what was done as JSON");
  command->callback([options, &action] { action = [options] { return Export(*options); }; });
}

}  // namespace levitas::cli
