// amb design pid: gains of a decentralised PID with filters, as a controller file.

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/json_file.hpp"
#include "cli/run/interrupt.hpp"
#include "cli/study/design/design_commands.hpp"
#include "cli/study/design/gate_options.hpp"
#include "cli/study/design/judged_law.hpp"
#include "cli/study/design/pid_channels.hpp"
#include "cli/study/design/pid_options.hpp"
#include "cli/study/design/pid_page.hpp"
#include "cli/study/progress_line.hpp"
#include "cli/study/written_files.hpp"
#include "cli/text_file.hpp"
#include "common/rotational_speed.hpp"
#include "design/pid/pid_search.hpp"
#include "report/text/text_table.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

using design::Limit;

void PrintRequirements(const design::PidFigures& figures, const design::PidLimits& limits) {
  report::TextTable table;
  table.Add({"requirement", "limit", "reached", "at"});
  for (std::size_t i = 0; i < design::kLimits; ++i) {
    const auto limit = static_cast<Limit>(i);
    const auto& met = figures[limit];
    table.Add({design::NameOf(limit),
               limits[limit] ? design::ValueText(limit, *limits[limit]) : std::string("-"),
               design::ValueText(limit, met.found),
               fmt::format("{}{:.0f} rpm", met.hz > 0.0 ? fmt::format("{:.1f} Hz, ", met.hz) : "",
                           RadPerSToRpm(met.speed_rad_per_s))});
  }
  fmt::print("{}", table.Text());
}

/// Unit of a requirement's numbers, as the end of their keys.
std::string UnitOf(Limit limit) {
  switch (limit) {
    case Limit::kControl:
      return "_a_per_m";
    case Limit::kStanding:
    case Limit::kSpinning:
      return "_m";
    case Limit::kCurrent:
    case Limit::kNoise:
      return "_a";
    case Limit::kStiffness:
      return "_n_per_m";
    case Limit::kCompliance:
      return "_m_per_n";
    default:
      return "";
  }
}

nlohmann::ordered_json RequirementsJson(const design::PidFigures& figures,
                                        const design::PidLimits& limits) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < design::kLimits; ++i) {
    const auto limit = static_cast<Limit>(i);
    const auto& met = figures[limit];
    nlohmann::ordered_json one{{"name", design::NameOf(limit)},
                               {"reached" + UnitOf(limit), met.found}};
    if (limits[limit]) one["limit" + UnitOf(limit)] = *limits[limit];
    if (met.hz > 0.0) one["frequency_hz"] = met.hz;
    one["speed_rpm"] = RadPerSToRpm(met.speed_rad_per_s);
    json.push_back(std::move(one));
  }
  return json;
}

design::PidSearchResult Search(const PidCommandOptions& options, const configuration::RigFile& rig,
                               const design::PidLimits& limits) {
  ProgressLine line(stderr, isatty(STDERR_FILENO) != 0);
  const InterruptGuard interrupt;
  std::fflush(stdout);  // whoever reads a pipe sees what is being designed
  auto found = design::SearchPid(rig, limits, ParametersOf(rig, options.gate.from), options.search,
                                 [&](double share, const std::string& text) {
                                   line.Show(share, text);
                                   return interrupt.count() == 0;
                                 });
  line.Close();
  fmt::print("search   {} laws, {} of {} plants (speeds, corners) held in it{}\n",
             found.evaluations, found.plants_held, found.plants_met,
             found.interrupted ? "; ended by a signal, the best so far is judged" : "");
  return found;
}

/// Nothing is written for a law that misses what was asked.
void RefuseUnmet(const design::PidFigures& figures, const design::PidLimits& limits) {
  constexpr double kRounding = 1.0 + 1e-9;
  if (figures.growing > 0)
    throw Problem(ExitStatus::kOther,
                  "no PID found holds this rig at every speed and corner of its uncertainty: more "
                  "--evaluations, another --notches, or less delay");
  const Limit limiting = design::Limiting(figures);
  if (figures[limiting].ratio <= kRounding) return;
  constexpr double kHeldBack = 0.98;  // of its limit: what the search could not give up
  std::string others;
  for (std::size_t i = 0; i < design::kLimits; ++i) {
    const auto limit = static_cast<Limit>(i);
    if (limit != limiting && figures[limit].ratio > kHeldBack)
      others +=
          (others.empty() ? "; also at or beyond their limits: " : ", ") + design::NameOf(limit);
  }
  throw Problem(ExitStatus::kOther,
                "the requirements are not met together; the nearest law misses " +
                    design::MetText(limiting, figures[limiting], *limits[limiting]) + others);
}

ExitStatus Run(PidCommandOptions options) {
  session::CheckOutputPath(options.out_path, {});
  session::CheckOutputPath(options.html_path, {});
  session::CheckOutputPath(options.loop.json_path, {});
  const auto weights = DesignOf(options.gate);
  auto rig = LoadRig(options.loop);
  const std::string delay = TakeDelayOfPort(options.loop, rig);
  const auto template_controller = LoadController(options.loop, rig);
  CompleteSearch(rig, options);
  if (options.tilt) options.search.coordinates = design::TranslationAndTilt(rig);
  fmt::print("rig {}; protections from {}\n{}", rig.numbers.name, template_controller.path, delay);
  const auto limits = LimitsOf(options, rig);
  const auto found = Search(options, rig, limits);
  PrintRequirements(found.figures, limits);
  RefuseUnmet(found.figures, limits);
  const auto& coordinates = options.search.coordinates;
  const law::LawConfig law =
      coordinates.empty() ? found.law : design::BetweenAxes(found.law, coordinates);
  if (options.tilt) fmt::print("law      {}\n", ChannelsText(found.law));
  const auto result = JudgeAndPrint(rig, law, options.gate, weights.analysis);
  const configuration::ControllerFile file{rig.numbers.name + "_pid", law,
                                           template_controller.file.supervisor};
  const std::string made =
      options.tilt ? "amb design pid --tilt, " + ChannelsText(found.law) : "amb design pid";
  auto written = WriteJudged(options.out_path, made, options.gate.seed, file, rig.numbers, result);
  if (!options.html_path.empty())
    WriteTextFile(
        options.html_path,
        PidPage(rig,
                {{"before: " + template_controller.file.name, template_controller.file.law},
                 {"after", found.law, coordinates}},
                found.figures, limits));
  written.push_back(options.html_path);
  auto json = GateJson(result);
  json["requirements"] = RequirementsJson(found.figures, limits);
  json["laws_tried"] = found.evaluations;
  if (options.tilt) json["channels"] = ChannelsJson(found.law);
  WriteJsonFile(options.loop.json_path, json);
  written.push_back(options.loop.json_path);
  TellWritten(written);
  return result.accepted ? ExitStatus::kDone : ExitStatus::kOther;
}

}  // namespace

void AddDesignPid(CLI::App& design, Action& action) {
  auto options = std::make_shared<PidCommandOptions>();
  CLI::App* command = design.add_subcommand(
      "pid", "Decentralised PID with filters against named limits, judged before it is written");
  AddRigOption(*command, options->loop);
  AddControllerOption(*command, options->loop);
  AddPortOption(*command, options->loop);
  command->add_option("--out", options->out_path, "Controller file to write when accepted");
  command->add_option(
      "--html", options->html_path,
      "Page to write: requirements, map of the gains that hold the rig before and after");
  AddPidSearchOptions(*command, *options);
  command->add_flag(
      "--tilt", options->tilt,
      "PIDs of translation and tilt of a rotor in two bearings, each with gains of its "
      "own; the file holds them as one law between the axes");
  command->add_flag("--first-levitation", options->search.first_levitation,
                    "From ki, ks, mass, inertia and delay alone, at rest: the largest margin with "
                    "which a flexible mode at any frequency stays damped");
  command
      ->add_option("--unknown-damping", options->unknown_damping_percent,
                   "With --first-levitation: damping [%] that any flexible mode has of its own")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str();
  AddGateOptions(*command, options->gate);
  AddJsonOption(*command, options->loop);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
