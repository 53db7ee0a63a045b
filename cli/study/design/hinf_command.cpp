// amb design hinf: a robust state-space law of a rig, as a controller file.

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/json_file.hpp"
#include "cli/run/interrupt.hpp"
#include "cli/study/design/design_commands.hpp"
#include "cli/study/design/gate_options.hpp"
#include "cli/study/design/judged_law.hpp"
#include "cli/study/progress_line.hpp"
#include "cli/study/written_files.hpp"
#include "cli/text_file.hpp"
#include "common/rotational_speed.hpp"
#include "design/search/weight_search.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

struct HinfCommandOptions {
  AnalysisOptions loop;
  GateCommandOptions gate;
  std::string out_path;
  std::string weights_path;
  std::size_t evaluations{};
  std::size_t states{48};
  double mu_goal{1.0};
  double sensitivity_goal{3.0};
  double orbit_goal_um{30.0};
  double current_goal_a{0.6};
};

hinf::HinfWeights Search(const HinfCommandOptions& options, const configuration::RigFile& rig,
                         const design::DesignFile& start, const hinf::HinfDesignOptions& design) {
  design::FigureOptions figures;
  figures.weights = start.analysis;
  const double top = rig.numbers.max_speed_rad_per_s;
  figures.speeds_rad_per_s = {0.0, top};
  for (int i = 2; i <= 20; ++i) figures.orbit_speeds_rad_per_s.push_back(top * i / 20.0);
  const design::FigureMaker maker(rig, ParametersOf(rig, options.gate.from), figures);
  design::SearchOptions search;
  search.evaluations = options.evaluations;
  search.seed = options.gate.seed;
  search.goals = {options.mu_goal, options.sensitivity_goal, 1e-6 * options.orbit_goal_um,
                  options.current_goal_a};
  ProgressLine line(stderr, isatty(STDERR_FILENO) != 0);
  const InterruptGuard interrupt;
  const auto found = design::SearchWeights(
      rig, start.synthesis, design, maker, search, [&](std::size_t n, double cost) {
        line.Show(static_cast<double>(n) / static_cast<double>(options.evaluations),
                  fmt::format("weights: cost {:.3f}; Ctrl-C goes on with the best", cost));
        return interrupt.count() == 0;
      });
  line.Close();
  fmt::print("search   {} syntheses, cost {:.3f}{}\n", found.evaluations, found.cost,
             interrupt.count() > 0 ? "; ended by a signal, the best so far is judged" : "");
  return found.weights;
}

ExitStatus Run(const HinfCommandOptions& options) {
  session::CheckOutputPath(options.out_path, {});
  session::CheckOutputPath(options.weights_path, {});
  session::CheckOutputPath(options.loop.json_path, {});
  auto weights = DesignOf(options.gate);
  auto rig = LoadRig(options.loop);
  const std::string delay = TakeDelayOfPort(options.loop, rig);
  const auto template_controller = LoadController(options.loop, rig);
  hinf::HinfDesignOptions design;
  design.current_limit_a = ControlLimitA(rig.numbers);
  design.top_speed_rad_per_s = rig.numbers.max_speed_rad_per_s;
  design.most_states = options.states;
  fmt::print("rig {}; protections from {}\n{}", rig.numbers.name, template_controller.path, delay);
  if (options.evaluations > 0) weights.synthesis = Search(options, rig, weights, design);
  const auto made = hinf::DesignHinf(rig.plant, weights.synthesis, design);
  fmt::print(
      "law      {} states of {}, gamma {:.3f}, slowest state decays at {:.2f} 1/s, no integrator\n",
      made.states, made.full_states, made.gamma, made.slowest_pole_1_per_s);
  const auto result = JudgeAndPrint(rig, made.law, options.gate, weights.analysis);
  const configuration::ControllerFile file{rig.numbers.name + "_hinf", made.law,
                                           template_controller.file.supervisor};
  auto written = WriteJudged(options.out_path, "amb design hinf", options.gate.seed, file,
                             rig.numbers, result);
  if (!options.weights_path.empty()) {
    WriteTextFile(options.weights_path, design::WriteDesign(weights));
    written.push_back(options.weights_path);
  }
  auto json = GateJson(result);
  json["states"] = made.states;
  json["gamma"] = made.gamma;
  WriteJsonFile(options.loop.json_path, json);
  written.push_back(options.loop.json_path);
  TellWritten(written);
  return result.accepted ? ExitStatus::kDone : ExitStatus::kOther;
}

ExitStatus Check(const HinfCommandOptions& options) {
  session::CheckOutputPath(options.out_path, {});
  session::CheckOutputPath(options.loop.json_path, {});
  const auto weights = DesignOf(options.gate).analysis;
  const auto [rig, controller, delay] = LoadLoop(options.loop);
  fmt::print("rig {}, controller {}\n{}", rig.numbers.name, ControllerText(controller), delay);
  const auto result = JudgeAndPrint(rig, controller.file.law, options.gate, weights);
  if (!options.out_path.empty() && result.worst)
    WriteTextFile(options.out_path, configuration::WriteRig(*result.worst));
  WriteJsonFile(options.loop.json_path, GateJson(result));
  TellWritten({result.worst ? options.out_path : "", options.loop.json_path});
  return result.accepted ? ExitStatus::kDone : ExitStatus::kOther;
}

}  // namespace

void AddDesignHinf(CLI::App& design, Action& action) {
  auto options = std::make_shared<HinfCommandOptions>();
  CLI::App* command = design.add_subcommand(
      "hinf", "A robust H-infinity law from 0 to the rated speed, judged before it is written");
  AddRigOption(*command, options->loop);
  AddControllerOption(*command, options->loop);
  AddPortOption(*command, options->loop);
  command->add_option("--out", options->out_path, "Controller file to write when accepted");
  command->add_option("--write-design", options->weights_path,
                      "Design file to write: the weights that the law was made with");
  command
      ->add_option("--evaluations", options->evaluations,
                   "Syntheses spent on a search for better weights; 0 takes the default weights")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("--mu-goal", options->mu_goal, "Of the search: mu counts as a ratio to this")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command
      ->add_option("--sensitivity-goal", options->sensitivity_goal,
                   "Of the search: |S| counts as a ratio to this")
      ->check(CLI::Range(1.0, 100.0))
      ->capture_default_str();
  command
      ->add_option(
          "--orbit-goal-um", options->orbit_goal_um,
          "Of the search: the orbit of unbalance and 0.8 N at three times the speed counts "
          "as a ratio to this")
      ->check(CLI::Range(0.1, 10000.0))
      ->capture_default_str();
  command
      ->add_option("--current-goal-a", options->current_goal_a,
                   "Of the search: the current that they need counts as a ratio to this")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  command->add_option("--states", options->states, "Most states of the law, all axes together")
      ->check(CLI::Range(std::size_t{4}, law::StateSpaceConfig::kMaxStates))
      ->capture_default_str();
  AddGateOptions(*command, options->gate);
  AddJsonOption(*command, options->loop);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

void AddDesignCheck(CLI::App& design, Action& action) {
  auto options = std::make_shared<HinfCommandOptions>();
  CLI::App* command = design.add_subcommand(
      "check", "Judges any controller file as a designed one: poles, |S|, mu, drawn rigs");
  AddRigOption(*command, options->loop);
  AddControllerOption(*command, options->loop);
  AddPortOption(*command, options->loop);
  command->add_option("--worst-rig", options->out_path, "Rig file to write: the worst one drawn");
  AddGateOptions(*command, options->gate);
  AddJsonOption(*command, options->loop);
  command->callback([options, &action] { action = [options] { return Check(*options); }; });
}

}  // namespace levitas::cli
