// amb simulate: drives the model with a session's currents, one step ahead, and shows where it
// departs from the recorded positions.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/records/coil_prediction.hpp"
#include "analysis/records/innovations.hpp"
#include "analysis/records/recorded_rows.hpp"
#include "cli/commands/command.hpp"
#include "cli/commands/study_commands.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/rig_of_records.hpp"
#include "cli/study/free_run.hpp"
#include "cli/study/innovation_files.hpp"
#include "common/rotational_speed.hpp"
#include "report/text/text_table.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kSimulateHelp =
    "Drives the rig's nonlinear model with the recorded currents, corrected at every sample by a "
    "fixed Kalman gain, and reports the innovations (measured minus predicted one sample ahead) "
    "in time, spectrum and orders of rotation, as multiples of the sensors' noise.\n"
    "--free-run: the model also runs by itself in closed loop with the law of the session, moved "
    "by the recorded test signal, speed and angle alone; its fit to the measured positions in "
    "percent stands beside that of the prediction. (Without the law the rotor is unstable: any "
    "difference, however small, would grow e-fold within milliseconds.)\n"
    "  amb run --scenario identify --record campaign.lcm\n"
    "  amb simulate campaign.lcm --free-run --csv response.csv --svg response.svg\n"
    "Where coil currents were measured on coils without a current loop, they are predicted too, "
    "free running at the recorded commands and positions.";

struct SimulateOptions : AnalysisOptions {
  std::string session_path;
  std::string svg_path;
  std::string csv_path;
  bool free_run{};
  std::size_t departures{8};
  double from_s{};
  double force_noise_percent{100.0 * analysis::ObserverTuning{}.force_noise_share};
};

/// The model by itself in the loop of the record.
struct FreeLoop {
  session::Recording recording;
  LawOfRecord law;
  analysis::FreeRun run;
};

struct Simulation {
  configuration::RigFile rig;
  analysis::ObserverGain gain;
  analysis::InnovationRun run;
  analysis::InnovationReport report;
  std::string damage;
  double mean_speed_rad_per_s{};
  std::vector<analysis::CoilFit> coils;
  std::optional<FreeLoop> free;
};

void PrintCoils(const Simulation& s) {
  if (s.coils.empty()) return;
  fmt::print("\nCoil currents of the model at the recorded commands and positions\n");
  report::TextTable table;
  table.Add({"coil", "fit %", "mean measured A", "predicted A", "rms difference A"});
  for (const auto& coil : s.coils) {
    table.Add({coil.coil, fmt::format("{:.2f}", coil.fit_percent),
               fmt::format("{:.4f}", coil.measured_mean_a),
               fmt::format("{:.4f}", coil.predicted_mean_a),
               fmt::format("{:.4f}", coil.error_rms_a)});
  }
  fmt::print("{}", table.Text());
}

nlohmann::ordered_json CoilsJson(const Simulation& s) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& coil : s.coils) {
    json.push_back({{"coil", coil.coil},
                    {"fit_percent", coil.fit_percent},
                    {"measured_mean_a", coil.measured_mean_a},
                    {"predicted_mean_a", coil.predicted_mean_a},
                    {"difference_rms_a", coil.error_rms_a}});
  }
  return json;
}

/// Leaves out what lies before `from_s`, such as the lift of a rig whose log begins with it.
void CutBeginning(std::vector<analysis::RecordedRow>& rows, double from_s, double period_s) {
  if (rows.empty() || from_s <= 0.0) return;
  const auto first =
      rows.front().cycle + static_cast<std::uint64_t>(std::llround(from_s / period_s));
  std::erase_if(rows, [first](const auto& row) { return row.cycle < first; });
  if (rows.empty()) throw BadInput("--from leaves nothing of the session");
}

/// If other bands have less power than expected, one band can hold more than the total excess.
double Percent(double share) { return 100.0 * std::min(1.0, share); }

void PrintChannels(const Simulation& s) {
  report::TextTable table;
  table.Add({"channel", "rms um", "x noise", "expected", "peak x", "lag 1", "strongest line Hz"});
  for (std::size_t i = 0; i < s.report.channels.size(); ++i) {
    const auto& c = s.report.channels[i];
    table.Add({s.rig.numbers.channels[i], fmt::format("{:.3f}", c.rms_m * 1e6),
               fmt::format("{:.2f}", c.multiple), fmt::format("{:.2f}", c.expected_multiple),
               fmt::format("{:.1f}", c.peak_m / s.gain.sensor_noise_m[i]),
               fmt::format("{:.3f}", c.lag_one),
               fmt::format("{:.1f} ({:.0f} x)", c.dominant_hz, c.dominant_ratio)});
  }
  fmt::print("{}", table.Text());
}

/// One column for each entry of a channel, one row for each channel.
template <class Entries, class Head, class Cell>
std::string ByChannel(const Simulation& s, const std::string& corner, Entries entries, Head head,
                      Cell cell) {
  report::TextTable table;
  std::vector<std::string> row{corner};
  for (const auto& entry : entries(s.report.channels.front())) row.push_back(head(entry));
  table.Add(row);
  for (std::size_t i = 0; i < s.report.channels.size(); ++i) {
    row = {s.rig.numbers.channels[i]};
    for (const auto& entry : entries(s.report.channels[i])) row.push_back(cell(entry));
    table.Add(row);
  }
  return table.Text();
}

template <class Band>
std::string BandText(const Band& band) {
  return fmt::format("{:.0f}-{:.0f}", band.low_hz, band.high_hz);
}

void PrintBands(const Simulation& s) {
  fmt::print("\nBands: rms / expected (share of the unexplained power)\n{}",
             ByChannel(
                 s, "Hz", [](const auto& c) -> const auto& { return c.bands; },
                 [](const auto& band) { return BandText(band); },
                 [](const auto& band) {
                   return fmt::format("{:.2f} ({:.0f} %)", band.ratio, Percent(band.share));
                 }));
}

void PrintExcitation(const Simulation& s) {
  if (s.report.channels.front().excitation.empty()) return;
  fmt::print("\nFollows the excitation: coherence / chance (a right model: 1.0)\n{}",
             ByChannel(
                 s, "Hz", [](const auto& c) -> const auto& { return c.excitation; },
                 [](const auto& band) { return BandText(band); },
                 [](const auto& band) { return fmt::format("{:.2f}", band.ratio); }));
}

void PrintOrders(const Simulation& s) {
  if (s.report.channels.front().orders.empty()) {
    fmt::print("\nOrders of rotation: none, the rotor stands (or the record has no rotation)\n");
    return;
  }
  fmt::print("\nOrders of rotation: amplitude um, x what noise leaves (share)\n{}",
             ByChannel(
                 s, "order", [](const auto& c) -> const auto& { return c.orders; },
                 [](const auto& order) { return fmt::format("{}x", order.order); },
                 [](const auto& order) {
                   return fmt::format("{:.3f} um, {:.1f} x ({:.0f} %)", order.amplitude_m * 1e6,
                                      order.ratio, Percent(order.share));
                 }));
}

void PrintWindows(const Simulation& s) {
  report::TextTable table;
  std::vector<std::string> from{"from s"};
  std::vector<std::string> speed{"rpm"};
  for (const auto& window : s.report.channels.front().windows) {
    from.push_back(fmt::format("{:.2f}", window.start_s));
    speed.push_back(fmt::format("{:.0f}", RadPerSToRpm(window.speed_rad_per_s)));
  }
  table.Add(from);
  table.Add(speed);
  for (std::size_t i = 0; i < s.report.channels.size(); ++i) {
    std::vector<std::string> row{s.rig.numbers.channels[i]};
    for (const auto& window : s.report.channels[i].windows) {
      row.push_back(fmt::format("{:.2f}", window.ratio));
    }
    table.Add(row);
  }
  fmt::print("\nTime: rms / expected\n{}", table.Text());
}

void PrintDepartures(const Simulation& s, std::size_t count) {
  if (s.report.departures.empty()) {
    fmt::print("\nThe model departs nowhere by more than {} times what noise explains.\n",
               analysis::kDepartureRatio);
    return;
  }
  fmt::print("\nWhere the model departs most (share of the channel's unexplained power):\n");
  for (std::size_t i = 0; i < std::min(count, s.report.departures.size()); ++i) {
    const auto& d = s.report.departures[i];
    const std::string share = d.share < 0.005 ? "< 1 %" : fmt::format("{:.0f} %", 100.0 * d.share);
    fmt::print("  {:<8} {:<38} {:>7}   {:.1f} x expected\n", s.rig.numbers.channels[d.channel],
               d.place, share, d.ratio);
  }
}

void Print(const Simulation& s, const SimulateOptions& options) {
  fmt::print("{} against rig {}: {:.3f} s compared", options.session_path, s.rig.numbers.name,
             s.report.duration_s);
  fmt::print(
      " in {} piece(s), mean speed {:.0f} rpm; left out: {} samples while the observer "
      "settles, {} not levitated; {} gap(s)\n",
      s.run.pieces.size(), RadPerSToRpm(s.mean_speed_rad_per_s), s.run.settling_rows,
      s.run.idle_rows, s.run.gaps);
  if (!s.damage.empty()) fmt::print("{}\n", s.damage);
  fmt::print(
      "\nInnovations (x noise: multiples of one reading's noise; expected: with a right "
      "model)\n");
  PrintChannels(s);
  PrintBands(s);
  PrintExcitation(s);
  PrintOrders(s);
  PrintWindows(s);
  fmt::print("\nConstant force the rig file does not have, N:");
  for (std::size_t i = 0; i < s.report.channels.size(); ++i) {
    fmt::print("  {} {:+.3f}", s.rig.numbers.channels[i], s.run.unknown_force_n[i]);
  }
  fmt::print("\n");
  PrintDepartures(s, options.departures);
  PrintCoils(s);
}

/// Refuses a record that a free run has no law or no test signal of, before the work is done.
FreeLoop WithLaw(const SimulateOptions& options, const configuration::RigFile& rig,
                 session::Recording recording) {
  FreeLoop free{
      std::move(recording), FindLaw(options.session_path, options.controller_name, rig), {}};
  analysis::RefuseUnexcited(free.recording);
  return free;
}

FreeRunContext ContextOf(const Simulation& s) {
  return {s.rig.numbers, s.free->recording, s.free->run, s.free->law.name};
}

Simulation Simulate(const SimulateOptions& options) {
  Simulation s;
  s.rig = LoadRigOfRecords(options, {options.session_path});
  std::vector<analysis::RecordedRow> rows;
  {
    session::Recording recording = session::LoadRecording(options.session_path, s.rig);
    s.damage = recording.damage;
    rows = analysis::RowsOf(recording);
    if (options.free_run) s.free = WithLaw(options, s.rig, std::move(recording));
  }
  if (!rows.empty() && rows.front().coils > 0) {
    s.coils = analysis::FitCoils(rows, analysis::PredictCoilCurrents(s.rig.plant, rows),
                                 s.rig.numbers.period_s(), options.from_s, s.rig.numbers.channels);
  }
  CutBeginning(rows, options.from_s, s.rig.numbers.period_s());
  s.mean_speed_rad_per_s = analysis::MeanSpeed(rows);
  analysis::ObserverTuning tuning;
  tuning.force_noise_share = 0.01 * options.force_noise_percent;
  tuning.speed_rad_per_s = s.mean_speed_rad_per_s;
  s.gain = analysis::DesignObserver(s.rig.plant, tuning);
  s.run = analysis::RunObserver(s.rig.plant, std::make_shared<const analysis::ObserverGain>(s.gain),
                                rows, s.gain.settling_s);
  s.report = analysis::Examine(s.run, s.gain, s.rig.numbers.axes());
  if (s.free) {
    s.free->run = analysis::RunFree(s.rig.plant, s.free->law.law, s.free->recording, s.run);
  }
  return s;
}

ExitStatus Run(const SimulateOptions& options) {
  for (const std::string& path : {options.csv_path, options.svg_path, options.json_path}) {
    session::CheckOutputPath(path, options.session_path);
  }
  const Simulation s = Simulate(options);
  Print(s, options);
  const InnovationContext context{s.rig.numbers, s.gain, s.run, s.report};
  auto json = InnovationJson(context);
  if (!s.coils.empty()) json["coil_currents"] = CoilsJson(s);
  if (s.free) {
    PrintFreeRun(ContextOf(s));
    json["free_run"] = FreeRunJson(ContextOf(s));
  }
  WriteJsonFile(options.json_path, json);
  if (s.free) {
    WriteFreeRunCsv(options.csv_path, ContextOf(s));
    WriteFreeRunSvg(options.svg_path, ContextOf(s));
    return ExitStatus::kDone;
  }
  WriteSpectrumCsv(options.csv_path, context);
  WriteSpectrumSvg(options.svg_path, context);
  return ExitStatus::kDone;
}

}  // namespace

void AddSimulateCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = AddStudyCommand(app, "simulate");
  command->footer(kSimulateHelp);
  command
      ->add_option("session", options->session_path, "Session, CSV or MAT file (docs/formats.md)")
      ->required();
  AddRigOfRecordsOption(*command, *options);
  command
      ->add_option("--force-noise-percent", options->force_noise_percent,
                   "Observer: unknown force per axis and sample, rms, in percent of ki i0; larger "
                   "follows the sensors more closely and hides slow departures")
      ->check(CLI::Range(1e-3, 100.0))
      ->capture_default_str();
  command->add_option("--departures", options->departures, "How many places to list")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      ->add_option("--from", options->from_s,
                   "Compare from this many seconds after the first sample on")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command->add_flag("--free-run", options->free_run,
                    "Also run model and law in closed loop, moved by the recorded test signal");
  command->add_option("--controller", options->controller_name,
                      "Law of the free run, a file or shipped name; default: that of the session");
  command->add_option("--csv", options->csv_path,
                      "Write the spectra to this file; with --free-run the responses");
  command->add_option("--svg", options->svg_path,
                      "Draw the spectra into this file; with --free-run the responses");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
