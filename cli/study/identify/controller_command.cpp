// amb identify controller: the transfer functions of an existing controller, as a law.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/study/controller_output.hpp"
#include "cli/study/identify/identify_commands.hpp"
#include "cli/study/written_files.hpp"
#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "identification/law/law_record.hpp"
#include "identification/nonlinear/series.hpp"
#include "report/identification/law_files.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

constexpr const char* kControllerHelp =
    "From a recorded run, the law of each axis as it answers sample by sample; from a CSV file, "
    "an\n"
    "analogue controller, of which an input and an output were sampled together while a chirp ran\n"
    "over the band. Loops around it may be closed. The order is chosen from the data.\n"
    "  amb identify controller run.lcm --out law.yaml\n"
    "  amb identify controller chirps.csv --rig turbomolecular_pump --rate-hz 50000 \\\n"
    "      --axis ux=ux_in:ux_out --axis uy=uy_in:uy_out --axis lx=lx_in:lx_out \\\n"
    "      --axis ly=ly_in:ly_out --input-v-per-mm 25 --output-a-per-v 2.044 --out law.yaml\n"
    "Without --input-v-per-mm and --output-a-per-v the columns are metres and amperes. A "
    "controller\n"
    "alone (of a thrust axis, say) needs no --out, and its --axis may have any name.";

struct ControllerOptions : AnalysisOptions {
  std::string data_path;
  std::vector<std::string> axes;
  double rate_hz{};
  std::string time;  ///< empty: discrete of a run, continuous of a CSV file
  double input_v_per_mm{};
  double output_a_per_v{};
  LawFitOptions fit;
  std::size_t order{};
  std::string out_path;
  std::string svg_path;
};

bool IsTable(const std::string& path) {
  return path.ends_with(".csv") || path.ends_with(".csv.xz");
}

/// "ux=in:out" in its three parts.
std::array<std::string, 3> PartsOf(const std::string& text) {
  const std::size_t equal = text.find('=');
  const std::size_t colon = text.find(':', equal == std::string::npos ? 0 : equal);
  if (equal == std::string::npos || colon == std::string::npos || equal == 0 ||
      colon == equal + 1 || colon + 1 == text.size()) {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("--axis '{}': allowed NAME=INPUT:OUTPUT, two columns of the file", text));
  }
  return {text.substr(0, equal), text.substr(equal + 1, colon - equal - 1), text.substr(colon + 1)};
}

std::vector<LawSignals> ReadTable(const ControllerOptions& options, double& period_s) {
  if (options.axes.empty()) {
    throw Problem(ExitStatus::kUsage,
                  "a CSV file needs --axis NAME=INPUT:OUTPUT for each controller in it");
  }
  std::vector<LawSignals> signals;
  SeriesColumns columns;
  for (const std::string& text : options.axes) {
    const auto [name, input, output] = PartsOf(text);
    signals.push_back({name, {}, {}});
    columns.inputs.push_back(input);
    columns.outputs.push_back(output);
  }
  const Series series =
      ReadSeries(options.data_path, columns, options.rate_hz > 0.0 ? 1.0 / options.rate_hz : 0.0);
  period_s = series.period_s;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    signals[i].input = series.input.col(static_cast<Eigen::Index>(i));
    signals[i].output = series.output.col(static_cast<Eigen::Index>(i));
  }
  return signals;
}

std::vector<LawFit> FitAll(const ControllerOptions& options, const configuration::RigFile& rig) {
  LawFitOptions how = options.fit;
  const bool table = IsTable(options.data_path);
  const std::string time = !options.time.empty() ? options.time : table ? "continuous" : "discrete";
  how.domain = time == "discrete" ? LawDomain::kDiscrete : LawDomain::kContinuous;
  if (options.order > 0) how.order = options.order;
  how.period_s = rig.numbers.period_s();
  const std::vector<LawSignals> signals =
      table ? ReadTable(options, how.period_s)
            : ReadLawSignals(session::LoadRecording(options.data_path, rig));
  std::vector<LawFit> fits;
  fits.reserve(signals.size());
  for (const LawSignals& one : signals) fits.push_back(FitLaw(one, how));
  return fits;
}

/// In hertz and damping ratio, of a discrete law those of the pole e^{sT} that it runs as.
void PrintPoles(const LawFit& fit) {
  const bool discrete = fit.options.domain == LawDomain::kDiscrete;
  for (const Pole& pole : fit.law.poles) {
    const std::complex<double> s =
        discrete ? std::log(pole.place) / fit.options.period_s : pole.place;
    if (pole.order() == 1) {
      fmt::print("    pole at {:.2f} Hz{}\n", -s.real() / kTwoPi,
                 s.real() > 0.0 ? ": GROWS by itself" : "");
    } else {
      fmt::print("    poles at {:.2f} Hz, damping {:.4f}{}\n", std::abs(s) / kTwoPi,
                 -s.real() / std::abs(s), s.real() > 0.0 ? ": GROW by themselves" : "");
    }
  }
}

void Print(const LawFit& fit) {
  fmt::print("{:<6} order {}, fit {:.4f} % of {} lines from {:.4g} to {:.4g} Hz{}\n", fit.name,
             fit.law.order(), fit.fit_percent, fit.lines, fit.options.lowest_hz,
             fit.options.highest_hz,
             fit.fit_percent < 90.0 ? "  WARNING: not this input alone, not linear, or noise" : "");
  PrintPoles(fit);
}

/// The law of the rig in which every axis has what was found.
law::LawConfig LawOf(const ControllerOptions& options, const std::vector<LawFit>& fits,
                     const configuration::RigFile& rig, const law::LawConfig& before) {
  law::LawConfig law = before;
  law.axes.clear();
  law.schedule.clear();
  law::StateSpaceConfig blocks;
  blocks.axes = rig.numbers.axes();
  blocks.discrete = fits.front().options.domain == LawDomain::kDiscrete;
  const bool volts = options.input_v_per_mm > 0.0;
  // Of columns in metres and amperes: a signal of 1 V/um keeps the file's numbers readable.
  const double input_v_per_m = volts ? 1e3 * options.input_v_per_mm : 1e6;
  for (std::size_t axis = 0; axis < rig.numbers.axes(); ++axis) {
    const auto fit = std::ranges::find(fits, rig.numbers.channels[axis], &LawFit::name);
    if (fit == fits.end()) {
      throw BadInput(fmt::format(
          "--out: no controller for axis {} of rig {}; give it with --axis, or leave --out out",
          rig.numbers.channels[axis], rig.numbers.name));
    }
    blocks.input_v_per_m[axis] = input_v_per_m;
    blocks.output_a_per_v[axis] = volts ? options.output_a_per_v : 1.0;
    AddToLaw(*fit, axis, volts ? 1.0 : 1.0 / input_v_per_m, blocks);
  }
  if (blocks.states() > law::StateSpaceConfig::kMaxStates) {
    throw BadInput(fmt::format("--out: {} states, a law has {} at most; choose a lower --order",
                               blocks.states(), law::StateSpaceConfig::kMaxStates));
  }
  law.state_space = blocks;
  return law;
}

ExitStatus Run(const ControllerOptions& options) {
  for (const std::string& path : {options.out_path, options.svg_path, options.json_path}) {
    session::CheckOutputPath(path, options.data_path);
  }
  if ((options.input_v_per_mm > 0.0) != (options.output_a_per_v > 0.0)) {
    throw Problem(ExitStatus::kUsage,
                  "--input-v-per-mm and --output-a-per-v: both, or neither (metres and amperes)");
  }
  const configuration::RigFile rig = LoadRig(options);
  const std::vector<LawFit> fits = FitAll(options, rig);
  fmt::print("{}: {} controllers, {} time\n", options.data_path, fits.size(),
             fits.front().options.domain == LawDomain::kDiscrete ? "discrete" : "continuous");
  for (const LawFit& fit : fits) Print(fit);
  if (!options.out_path.empty()) {
    const FoundController before = LoadController(options, rig);
    const configuration::ControllerFile file{rig.numbers.name + "_identified",
                                             LawOf(options, fits, rig, before.file.law),
                                             before.file.supervisor};
    WriteControllerFile(options.out_path, "", file, rig.numbers);
    fmt::print("sequence and protection from {}\n", before.path);
  }
  report::WriteLawPicture(options.svg_path, fits);
  WriteJsonFile(options.json_path, report::LawJson(fits));
  TellWritten({options.out_path, options.svg_path, options.json_path});
  return ExitStatus::kDone;
}

}  // namespace

void AddIdentifyController(CLI::App& identify, Action& action) {
  auto options = std::make_shared<ControllerOptions>();
  CLI::App* command = identify.add_subcommand(
      "controller", "Transfer functions of an existing controller, as a law that amb run takes");
  command->footer(kControllerHelp);
  command->add_option("DATA", options->data_path, "Session, or CSV file (.csv, .csv.xz)")
      ->required();
  AddRigOption(*command, *options);
  AddControllerOption(*command, *options);
  command->add_option("--axis", options->axes,
                      "NAME=INPUT:OUTPUT of a CSV file; may be given several times");
  command
      ->add_option("--rate-hz", options->rate_hz, "Sampling rate, when there is no column time_s")
      ->check(CLI::PositiveNumber);
  command
      ->add_option(
          "--time", options->time,
          "continuous or discrete; default: discrete of a session, continuous of a CSV file")
      ->check(CLI::IsMember({"continuous", "discrete"}));
  command->add_option("--input-v-per-mm", options->input_v_per_mm, "Of the input column in volts")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--output-a-per-v", options->output_a_per_v,
                   "Amplifier behind the output column in volts")
      ->check(CLI::PositiveNumber);
  command->add_option("--from-hz", options->fit.lowest_hz, "Lines below it are not fitted")
      ->check(CLI::PositiveNumber);
  command->add_option("--to-hz", options->fit.highest_hz, "Lines above it are not fitted")
      ->check(CLI::PositiveNumber);
  command->add_option("--order", options->order, "Of each controller, instead of a choice")
      ->check(CLI::Range(1, 24));
  command->add_option("--out", options->out_path, "Controller file to write");
  command->add_option("--svg", options->svg_path, "Picture to write: measured and fitted");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
