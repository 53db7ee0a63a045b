// amb diagnose --plan: which faults given or simulated records can tell apart, and what would help.

#include "cli/study/diagnose_plan.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/json_file.hpp"
#include "cli/study/isolability_text.hpp"
#include "cli/study/progress_line.hpp"
#include "cli/study/written_files.hpp"
#include "cli/text_file.hpp"
#include "configuration/run_files.hpp"
#include "diagnosis/isolability/simulated_record.hpp"
#include "diagnosis/levitator/levitator_result.hpp"
#include "diagnosis/records/levitated_interval.hpp"
#include "diagnosis/records/load.hpp"

namespace levitas::cli {
namespace {

using diagnosis::Record;

configuration::ControllerFile ControllerOf(const PlanOptions& options,
                                           const configuration::RigFile& rig) {
  return configuration::LoadFound(
      configuration::FindController(rig.run, options.controller_name, "flexible_rotor"), rig,
      options.controller_name);
}

std::vector<Record> RecordsOf(const PlanOptions& options, const configuration::RigFile& rig,
                              const configuration::ControllerFile& controller) {
  const diagnosis::RigView view(rig.numbers, rig.plant);
  std::vector<Record> records;
  for (const std::string& path : options.data) {
    records.push_back(diagnosis::LoadRecord(path, rig));
  }
  std::uint64_t seed = 1;
  for (const std::string& name : options.scenarios) {
    const auto scenario =
        configuration::LoadScenario(configuration::FindConfig(name, "scenarios"), rig.numbers);
    records.push_back(diagnosis::SimulatedRecord(rig, controller, scenario, seed++));
  }
  for (Record& record : records) {
    diagnosis::LeaveOutContactAndWays(view, record);
    const double seconds = static_cast<double>(record.rows.size()) * view.period_s;
    if (seconds >= diagnosis::kShortest) continue;
    throw BadInput(fmt::format("{}: {:.2f} s of free flight, --plan needs {} s", record.name,
                               seconds, diagnosis::kShortest));
  }
  return records;
}

}  // namespace

ExitStatus Plan(const PlanOptions& options, const configuration::RigFile& rig) {
  if (levitator::IsLevitator(rig.plant)) {
    throw BadInput(fmt::format(
        "--plan without --out knows rotors on radial bearings, and {} is a levitator: diagnose a "
        "record of it with --out, then --plan FILE writes what separates what is left",
        rig.numbers.name));
  }
  const diagnosis::Judging judging;
  const configuration::ControllerFile controller = ControllerOf(options, rig);
  ProgressLine progress(stderr, isatty(STDERR_FILENO) == 1);
  progress.Show(0.01, "reading");
  const diagnosis::HealthyModel model(rig, RecordsOf(options, rig, controller),
                                      !options.data.empty(), judging);
  const auto shown = [&progress](double from, double to) {
    return [&progress, from, to](double share, const std::string& what) {
      progress.Show(from + (to - from) * share, what);
    };
  };
  const auto all = ForetellAll(model, nullptr, StatedFaults(model.rig(), options.size), judging,
                               shown(0.1, 0.4));
  const auto tried = TryExperiments(rig, controller, model, all, judging, shown(0.4, 1.0));
  progress.Close();
  fmt::print("What {} can tell apart on rig {}, foretold from sensitivities:\n\n{}{}",
             options.data.empty() ? "simulated records" : "these records", rig.numbers.name,
             IsolabilityText(all), SplitsText(all, tried));
  std::vector<std::string> written{options.json_path};
  if (!options.scenario_path.empty()) {
    if (const auto best = BestScenario(all, tried)) {
      WriteTextFile(options.scenario_path, tried[*best].scenario);
      written.push_back(options.scenario_path);
    } else {
      fmt::print("--plan: no scenario of these helps, {} is not written\n", options.scenario_path);
    }
  }
  WriteJsonFile(options.json_path, IsolabilityJson(all, tried));
  TellWritten(written);
  return ExitStatus::kDone;
}

}  // namespace levitas::cli
