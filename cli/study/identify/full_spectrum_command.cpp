// amb identify full-spectrum: magnets, mesh, run-outs and transmission error of a geared rotor.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/rig_of_records.hpp"
#include "cli/study/identify/geared_commands.hpp"
#include "cli/study/written_files.hpp"
#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "identification/geared/half_spectrum.hpp"
#include "identification/geared/record_lines.hpp"
#include "identification/identified_rig.hpp"
#include "report/identification/geared_files.hpp"
#include "report/identification/modal_files.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

constexpr const char* kFullSpectrumHelp =
    "Linear least squares on the lines of the full spectrum (r = x + jy: forward and backward) of "
    "two steady speeds or more: ks and ki of both magnets, both run-outs, mesh stiffness and "
    "damping, mean and varying transmission error with phases, each with a standard deviation. "
    "Masses and shafts are known from the rig file; tilts are eliminated dynamically, torsion by "
    "its half spectrum. Where the rig measures torque and twist of its couplings, their half "
    "spectrum is held against that of the identified model, and the couplings' stiffnesses are "
    "found. Where probes stand beside the gear, one plane of them for each shaft is enough: the "
    "shaft's own model says how the gear moves, and the answer how much errors grow by that.\n"
    "  amb run --rig geared_rotor_8dof --record geared.lcm\n"
    "  amb identify full-spectrum geared.lcm --rig geared_rotor_8dof --out identified.yaml";

struct SpectrumOptions : AnalysisOptions {
  std::string data_path;
  std::string lines_path;
  std::string out_path;
  std::string svg_path;
  double known_percent{0.0};
};

void PrintShaft(const char* name, const ShaftFound& s) {
  fmt::print(
      "{:<7} ks {:>11.0f} +- {:<8.0f} N/m   ki {:>8.3f} +- {:<7.3f} N/A   run-out {:>7.3f} +- "
      "{:<6.3f} um at {:>7.3f} rad\n",
      name, s.ks_n_per_m, 2.0 * s.ks_sigma, s.ki_n_per_a, 2.0 * s.ki_sigma,
      1e6 * std::abs(s.run_out_m), 2e6 * s.run_out_sigma, std::arg(s.run_out_m));
}

void Print(const SpectrumOptions& options, const std::vector<GearedLine>& lines,
           const GearedKnown& known, const GearedParameters& p) {
  std::set<double> speeds;
  for (const GearedLine& line : lines) speeds.insert(line.speed_rad_per_s);
  const int freedom = known.torsion ? 12 : (known.pinion.tilt_stiffness_n_m > 0.0 ? 8 : 4);
  const bool elastic = known.pinion.elastic || known.gear.elastic;
  fmt::print("{}: {}, {} lines of {} speeds; +- two standard deviations\n",
             options.data_path.empty() ? options.lines_path : options.data_path,
             elastic ? "elastic shafts" : fmt::format("{} DOF", freedom), lines.size(),
             speeds.size());
  PrintShaft("pinion", p.pinion);
  PrintShaft("gear", p.gear);
  fmt::print("mesh    km {:>11.0f} +- {:<8.0f} N/m   cm {:>8.2f} +- {:<7.2f} N s/m\n",
             p.mesh_stiffness_n_per_m, 2.0 * p.mesh_stiffness_sigma, p.mesh_damping_n_s_per_m,
             2.0 * p.mesh_damping_sigma);
  fmt::print("\ntransmission error\n{:>8}{:>12}{:>12}{:>12}\n", "order", "um", "+- um", "rad");
  for (const TransmissionError& e : p.error) {
    fmt::print("{:>8}{:>12.4f}{:>12.4f}{:>12.4f}\n", e.harmonic, 1e6 * std::abs(e.amplitude_m),
               2e6 * e.sigma, std::arg(e.amplitude_m));
  }
  fmt::print("\ncondition number {:.1f}\n", p.condition);
  if (p.pinion.plane) fmt::print("{}", report::ProbePlaneText("pinion", *p.pinion.plane));
  if (p.gear.plane) fmt::print("{}", report::ProbePlaneText("gear", *p.gear.plane));
  fmt::print(
      "shaft stiffness and ks show only as their difference ({:.0f} and {:.0f} N/m): an error of "
      "the one is that of the other;\n    experiment: record at a second bias current, ks goes "
      "with "
      "its square\n",
      known.pinion.stiffness_n_per_m - p.pinion.ks_n_per_m,
      known.gear.stiffness_n_per_m - p.gear.ks_n_per_m);
  if (p.mean_along_line_unknown) {
    fmt::print(
        "the mean error along the line of action is not separable from the wheels' rotation: the "
        "line 0 is its part across;\n    experiment: measure the rotation of both shafts\n");
  }
}

/// Empty without gauges, as of a file that is no session.
HalfSpectrum Torsion(const std::optional<session::Recording>& record, const std::string& path,
                     const configuration::RigFile& rig, const std::vector<GearedLine>& lines,
                     const GearedParameters& found) {
  if (!record || !session::IsSession(path)) return {};
  const session::TorsionRecording torsion = session::LoadTorsion(path);
  if (torsion.rows() == 0) return {};
  return HalfSpectrumOf(*record, torsion, rig, lines, found);
}

/// Of each coupling the lines that carry most, those that the noise may have made left out.
void PrintTorsion(const HalfSpectrum& half) {
  constexpr std::size_t kShown = 5;
  constexpr double kDeviations = 4.0;
  for (std::size_t c = 0; c < half.couplings.size(); ++c) {
    const CouplingFound& at = half.couplings[c];
    fmt::print("\ntorsion, {}", at.name);
    if (at.lines_used > 0) {
      fmt::print(": stiffness {:.1f} +- {:.1f} N m/rad from {} lines (rig file {:.1f})",
                 at.stiffness_n_m_per_rad, 2.0 * at.stiffness_sigma, at.lines_used,
                 at.known_n_m_per_rad);
    }
    fmt::print("\nhalf spectrum: {}\n",
               at.unexplained_share
                   ? fmt::format("the model leaves {:.2f} % of its power unexplained",
                                 100.0 * *at.unexplained_share)
                   : "not held against the model: the probes see none of its lines");
    std::vector<const TorsionLine*> lines;
    for (const TorsionLine& line : half.lines) {
      const bool stands_out = std::abs(line.torque_n_m) > kDeviations * line.torque_sigma_n_m;
      if (line.coupling == c && stands_out) lines.push_back(&line);
    }
    std::ranges::sort(lines, [](const TorsionLine* a, const TorsionLine* b) {
      return std::abs(a->torque_n_m) > std::abs(b->torque_n_m);
    });
    fmt::print("{:>12}{:>10}{:>10}{:>12}{:>12}{:>12}\n", "line", "pinion Hz", "Hz", "N m", "+- N m",
               "model N m");
    for (std::size_t i = 0; i < std::min(kShown, lines.size()); ++i) {
      const TorsionLine& line = *lines[i];
      fmt::print("{:>12}{:>10.2f}{:>10.1f}{:>12.4f}{:>12.4f}{:>12}\n", line.name,
                 line.speed_rad_per_s / kTwoPi, line.frequency_rad_per_s / kTwoPi,
                 std::abs(line.torque_n_m), 2.0 * line.torque_sigma_n_m,
                 line.model_n_m ? fmt::format("{:.4f}", std::abs(*line.model_n_m)) : "not seen");
    }
  }
}

ExitStatus Run(const SpectrumOptions& options) {
  if (options.data_path.empty() == options.lines_path.empty()) {
    throw Problem(ExitStatus::kUsage, "give a record, or --lines with a file of lines, not both");
  }
  for (const std::string& path : {options.out_path, options.json_path, options.svg_path}) {
    session::CheckOutputPath(path, options.data_path);
  }
  const configuration::RigFile rig = LoadRigOfRecords(options, {options.data_path});
  GearedKnown known = KnownOfRig(rig);
  known.uncertainty = 0.01 * options.known_percent;
  std::optional<session::Recording> record;
  if (options.lines_path.empty()) record = session::LoadRecording(options.data_path, rig);
  const auto lines = record ? LinesOfRecord(*record, rig) : ReadGearedLines(options.lines_path);
  const GearedParameters found = IdentifyGeared(lines, known);
  Print(options, lines, known, found);
  const HalfSpectrum half = Torsion(record, options.data_path, rig, lines, found);
  PrintTorsion(half);
  auto json = report::GearedJson(found);
  json["torsion"] = report::TorsionJson(half);
  WriteJsonFile(options.json_path, json);
  report::WriteGearedPicture(options.svg_path, lines, half);
  if (!options.out_path.empty()) report::WriteRigFile(options.out_path, IdentifiedRig(rig, found));
  TellWritten({options.out_path, options.json_path, options.svg_path});
  return ExitStatus::kDone;
}

}  // namespace

void AddIdentifyFullSpectrum(CLI::App& identify, Action& action) {
  auto options = std::make_shared<SpectrumOptions>();
  options->rig_name = "geared_rotor_4dof";
  CLI::App* command = identify.add_subcommand(
      "full-spectrum", "Mesh, run-outs, transmission error and magnets of a geared rotor");
  command->footer(kFullSpectrumHelp);
  command->add_option("DATA", options->data_path, "Session, or CSV file (.csv, .csv.xz)");
  command->add_option("--lines", options->lines_path,
                      "CSV of lines instead of a record (docs/identification.md)");
  AddRigOfRecordsOption(*command, *options);
  command
      ->add_option("--known-percent", options->known_percent,
                   "How well mass, damping and stiffness of the shafts are known; 0 = exactly")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command->add_option("--out", options->out_path, "Write the identified rig file");
  command->add_option("--svg", options->svg_path, "Draw the full spectra into this file");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
