// amb bench full-spectrum: error study of the geared rotor's identification.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmark/accuracy/identification/geared_bound.hpp"
#include "cli/json_file.hpp"
#include "cli/study/identify/geared_commands.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kBenchFullSpectrumHelp =
    "Lines of the linear model with ideal PD control at each speed, with noise on every sample "
    "and errors in every number that is taken as known; each figure is the median over the seeds "
    "and, in brackets, the worst. The bound is the median of the best that could be made of the "
    "same lines (Cramer and Rao).\n"
    "Example: amb bench full-spectrum --seeds 50";

struct StudyOptions {
  std::uint64_t first{1000};
  int seeds{50};
  accuracy::GearedPlan plan;
  std::string json_path;
};

struct Case {
  const char* name;
  double noise, model_error;
};

using Member = double accuracy::GearedErrors::*;
struct Column {
  const char* name;
  Member member;
};
constexpr std::array<Column, 8> kColumns{{{"km", &accuracy::GearedErrors::mesh_stiffness},
                                          {"cm", &accuracy::GearedErrors::mesh_damping},
                                          {"ks", &accuracy::GearedErrors::ks},
                                          {"k-ks", &accuracy::GearedErrors::net_stiffness},
                                          {"ki", &accuracy::GearedErrors::ki},
                                          {"run-out", &accuracy::GearedErrors::run_out},
                                          {"mean TE", &accuracy::GearedErrors::mean_error},
                                          {"varying TE", &accuracy::GearedErrors::varying_error}}};

/// How many of the seeds found the number within what is asked: 2 % of exact lines, 10 % at 5 % of
/// noise and of error.
void PrintWithin(const std::vector<accuracy::GearedErrors>& errors, double asked,
                 nlohmann::ordered_json& json) {
  std::size_t all = 0;
  fmt::print("{:<11}", fmt::format("  in {:.0f} %", 100.0 * asked));
  for (const Column& column : kColumns) {
    const auto within = static_cast<std::size_t>(std::ranges::count_if(
        errors, [&](const accuracy::GearedErrors& e) { return e.*column.member < asked; }));
    all += within;
    fmt::print("{:>17}", fmt::format("{} of {}", within, errors.size()));
    json[column.name]["within"] = within;
    json[column.name]["asked_percent"] = 100.0 * asked;
  }
  fmt::print("   all {:.0f} %\n", 100.0 * static_cast<double>(all) /
                                      static_cast<double>(errors.size() * kColumns.size()));
}

/// Medians of the best that could be made of the same lines.
void PrintBound(const configuration::RigFile& rig, const Case& one, const StudyOptions& options,
                nlohmann::ordered_json& json) {
  accuracy::GearedPlan plan = options.plan;
  plan.noise = one.noise;
  plan.model_error = one.model_error;
  plan.seed = options.first;
  const accuracy::GearedErrors bound = accuracy::BoundOf(rig, plan);
  fmt::print("{:<11}", "  bound");
  for (const Column& column : kColumns) {
    const double percent = 100.0 * bound.*column.member;
    fmt::print("{:>8.2g}         ", percent);
    json[column.name]["bound_percent"] = percent;
  }
  fmt::print("\n");
}

std::vector<accuracy::GearedErrors> Study(const configuration::RigFile& rig, const Case& one,
                                          const StudyOptions& options) {
  std::vector<accuracy::GearedErrors> all;
  const int seeds = one.noise > 0.0 || one.model_error > 0.0 ? options.seeds : 1;
  for (int n = 0; n < seeds; ++n) {
    accuracy::GearedPlan plan = options.plan;
    plan.noise = one.noise;
    plan.model_error = one.model_error;
    plan.seed = options.first + static_cast<std::uint64_t>(n);
    const accuracy::GearedTrial trial = accuracy::MakeGearedTrial(rig, plan);
    all.push_back(accuracy::Compare(rig, identification::IdentifyGeared(trial.lines, trial.known)));
  }
  return all;
}

ExitStatus Run(const StudyOptions& options) {
  constexpr std::array<Case, 4> kCases{{{"exact", 0.0, 0.0},
                                        {"5 % noise", 0.05, 0.0},
                                        {"5 % model", 0.0, 0.05},
                                        {"both", 0.05, 0.05}}};
  nlohmann::ordered_json json;
  fmt::print("errors in %, of the worse shaft: median over {} seeds (worst)\n", options.seeds);
  for (const char* name : {"geared_rotor_4dof", "geared_rotor_8dof", "geared_rotor_12dof"}) {
    const configuration::RigFile rig =
        configuration::LoadRig(configuration::FindConfig(name, "rigs"));
    fmt::print("{}\n{:<11}", name, "");
    for (const Column& column : kColumns) fmt::print("{:>17}", column.name);
    fmt::print("\n");
    for (const Case& one : kCases) {
      const auto errors = Study(rig, one, options);
      fmt::print("{:<11}", one.name);
      for (const Column& column : kColumns) {
        std::vector<double> values;
        values.reserve(errors.size());
        for (const auto& e : errors) values.push_back(100.0 * e.*column.member);
        std::ranges::sort(values);
        const double median = values[values.size() / 2];
        fmt::print("{:>8.2g} ({:>6.2g})", median, values.back());
        json[name][one.name][column.name] = {{"median_percent", median},
                                             {"worst_percent", values.back()}};
      }
      fmt::print("\n");
      nlohmann::ordered_json& of_case = json[name][one.name];
      const bool exact = one.noise == 0.0 && one.model_error == 0.0;
      const bool both = one.noise > 0.0 && one.model_error > 0.0;
      if (one.noise > 0.0) PrintBound(rig, one, options, of_case);
      if (exact || both) PrintWithin(errors, exact ? 0.02 : 0.1, of_case);
    }
  }
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

}  // namespace

void AddBenchFullSpectrum(CLI::App& bench, Action& action) {
  auto options = std::make_shared<StudyOptions>();
  CLI::App* command =
      bench.add_subcommand("full-spectrum", "Geared rotors under noise and wrong numbers");
  command->footer(kBenchFullSpectrumHelp);
  command->add_option("--first", options->first, "Seed of the first draw")->capture_default_str();
  command->add_option("--seeds", options->seeds, "Draws of noise and errors")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--seconds", options->plan.seconds, "Recorded at each speed")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  command->add_option("--speeds-hz", options->plan.speeds_hz, "Of the pinion; two or more")
      ->delimiter(',')
      ->check(CLI::Range(1.0, 200.0))
      ->capture_default_str();
  command->add_option("--json", options->json_path, "The table");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
