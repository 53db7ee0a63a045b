// amb export: a session as CSV, MAT, MCAP or plain LCM file for other tools.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.hpp"
#include "cli/commands/session_text.hpp"
#include "cli/json_file.hpp"
#include "rt/say.hpp"
#include "session/exchange/csv_export.hpp"
#include "session/exchange/mat_export.hpp"
#include "session/exchange/mcap_export.hpp"
#include "session/log/output_path.hpp"
#include "session/log/repack.hpp"

namespace levitas::cli {
namespace {

struct ExportOptions {
  std::string session_path;
  std::string csv_path;
  std::string mat_path;
  std::string mcap_path;
  std::string lcm_path;
  std::string json_path;
  session::ExportSelection selection;
};

using Exporter = session::ExportReport (*)(session::SessionReader&, const std::string&,
                                           const session::ExportSelection&);
using Exports = std::array<std::pair<const std::string*, Exporter>, 3>;  ///< to which file

/// Reads the session once for one file.
session::ExportReport Write(const ExportOptions& options, const std::string& path,
                            Exporter exporter) {
  session::SessionReader reader(options.session_path);
  const session::ExportReport report = exporter(reader, path, options.selection);
  fmt::print("{}: {} rows", rt::OneLine(path), report.rows);
  if (report.cycles_without_frame > 0) {
    fmt::print("; {} cycles had no sensor frame and have no row", report.cycles_without_frame);
  }
  fmt::print("\n");
  return report;
}

/// The log itself, byte for byte.
void WriteLog(const ExportOptions& options) {
  const session::RepackReport report = session::Repack(options.session_path, options.lcm_path);
  fmt::print("{}: {:.1f} MB of LCM log in {:.1f} MB\n", rt::OneLine(options.lcm_path),
             static_cast<double>(report.log_bytes) * 1e-6,
             static_cast<double>(report.out_bytes) * 1e-6);
}

void RefuseNothingToWrite(const ExportOptions& options, const Exports& files) {
  const bool no_table =
      std::all_of(files.begin(), files.end(), [](const auto& file) { return file.first->empty(); });
  if (!no_table || !options.lcm_path.empty()) return;
  throw Problem(ExitStatus::kUsage,
                "nothing to write: name --csv FILE, --mat FILE, --mcap FILE, --lcm FILE or several "
                "of them");
}

/// Under such a name nobody could read it, this program neither.
void RefusePacked(const std::string& path) {
  for (const char* ending : {".xz", ".zst"}) {
    if (!path.ends_with(ending)) continue;
    throw Problem(ExitStatus::kUsage, fmt::format("{}: an export is not packed; leave out {}, and "
                                                  "pack the file afterwards",
                                                  path, ending));
  }
}

void RefuseSelectedLog(const ExportOptions& options) {
  const session::ExportSelection all;
  const session::ExportSelection& some = options.selection;
  if (!options.lcm_path.empty() && (some.from_s != all.from_s || some.to_s != all.to_s ||
                                    some.every != all.every || !some.columns.empty())) {
    throw Problem(ExitStatus::kUsage,
                  "--lcm writes the log whole: leave out --from, --to, --every and --columns");
  }
}

ExitStatus Export(const ExportOptions& options) {
  const Exports files{{{&options.csv_path, session::ExportCsv},
                       {&options.mat_path, session::ExportMat},
                       {&options.mcap_path, session::ExportMcap}}};
  RefuseNothingToWrite(options, files);
  for (const auto& [path, exporter] : files) {
    session::CheckOutputPath(*path, options.session_path);
    RefusePacked(*path);
  }
  RefuseSelectedLog(options);
  session::CheckOutputPath(options.lcm_path, options.session_path);
  session::CheckOutputPath(options.json_path, options.session_path);
  session::SessionReader reader(options.session_path);
  fmt::print("{}\n", Describe(options.session_path, reader.header()));
  session::ExportReport report;
  for (const auto& [path, exporter] : files) {
    if (!path->empty()) report = Write(options, *path, exporter);
  }
  if (!options.lcm_path.empty()) WriteLog(options);
  cycle::CycleRecord record;
  while (reader.Next(record)) {
  }  // to its end, for what was lost
  const session::Damage& damage = reader.damage();
  PrintDamage(damage);
  WriteJsonFile(options.json_path, {{"session", options.session_path},
                                    {"csv", options.csv_path},
                                    {"mat", options.mat_path},
                                    {"mcap", options.mcap_path},
                                    {"lcm", options.lcm_path},
                                    {"rows", report.rows},
                                    {"cycles_without_frame", report.cycles_without_frame},
                                    {"damage", DamageJson(damage)}});
  return ExitStatus::kDone;
}

}  // namespace

void AddExportCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command =
      app.add_subcommand("export", "A session as CSV, MAT, MCAP or plain LCM file for other tools");
  command->add_option("SESSION", options->session_path, "Session or trip file")->required();
  command->add_option("--csv", options->csv_path, "CSV file to write");
  command->add_option("--mat", options->mat_path,
                      "MAT file to write (version 5: MATLAB, Octave, SciPy), a vector per column");
  command->add_option("--mcap", options->mcap_path,
                      "MCAP file to write (Foxglove, PlotJuggler, mcap libraries), with events");
  command->add_option("--lcm", options->lcm_path,
                      "LCM log to write, of a packed session the plain one, for lcm-logplayer and "
                      "lcm-spy; packed by zstd under a name that ends in .zst");
  session::ExportSelection& selection = options->selection;
  command->add_option("--from", selection.from_s, "First time of column time_s [s]");
  command->add_option("--to", selection.to_s, "Last time of column time_s [s]");
  command
      ->add_option("--every", selection.every,
                   "One row of so many; nothing is filtered, faster signals fold down")
      ->check(CLI::PositiveNumber);  // of a negative one the parser makes a large one
  command
      ->add_option("--columns", selection.columns,
                   "Names of columns behind time_s, in this order: speed_rpm,position_de_x_m")
      ->delimiter(',');
  command->add_option("--json", options->json_path, "Write what was done as JSON");
  command->callback([options, &action] { action = [options] { return Export(*options); }; });
  command->footer(
      "  amb export run.lcm --csv run.csv --mcap run.mcap\n"
      "  amb export run.lcm.zst --lcm run.lcm\n"
      "  amb export run.lcm --csv orbit.csv --from 2 --to 3 --columns "
      "position_de_x_m,position_de_y_m");
}

}  // namespace levitas::cli
