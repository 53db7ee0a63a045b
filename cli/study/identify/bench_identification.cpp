// amb bench identification: rigs of unknown numbers, identified from what they would record.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmark/accuracy/identification/modal_trial.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/study/identify/geared_commands.hpp"
#include "cli/study/identify/start_options.hpp"
#include "common/rotational_speed.hpp"
#include "identification/modal/modal_starts.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

constexpr const char* kBenchIdentificationHelp =
    "Every seed draws a flexible_rotor with all its numbers off, simulates the campaign of PRBS "
    "(noise, converters, nonlinear magnets, gravity on), fits standing and 3000 rpm from the "
    "shipped rig file, validates at 1600 rpm, and compares with the truth. With --starts the fit "
    "of the first seed is repeated from random starts.\n"
    "Example: amb bench identification --seeds 3 --starts 20";

struct IdentificationBenchOptions {
  std::uint64_t first{1};
  int seeds{3};
  int starts{0};
  StartSpread spread;
  double amplitude_a{0.15};
  accuracy::RigidBodyOff rigid;
  ModalFitOptions fit;
  std::string json_path;
};

/// One seed's figures, all relative.
struct Row {
  std::uint64_t seed{};
  accuracy::ModalErrors errors;
  accuracy::ModalScores scores;
  std::vector<SpeedQuality> quality;
  std::vector<ModeSupport> support;
  double time_s{};
};

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void Append(std::vector<double>& to, const Eigen::VectorXd& values) {
  to.insert(to.end(), values.data(), values.data() + values.size());
}

void PrintPercent(const char* name, const Eigen::VectorXd& values) {
  fmt::print("    {:<12}", name);
  for (const double value : values) fmt::print("{:>9.3f}", 100.0 * value);
  fmt::print(" %\n");
}

void PrintRow(const Row& row) {
  fmt::print("seed {}: fitted in {:.2f} s; misfit", row.seed, row.time_s);
  for (const SpeedQuality& q : row.quality) {
    fmt::print(" {:.0f} rpm {:.2f}, fit {:.2f} % of {:.2f} %{};", RadPerSToRpm(q.speed_rad_per_s),
               q.misfit, q.percent.fit, q.percent.ceiling, q.fitted ? "" : " (validation)");
  }
  fmt::print(" errors by mode and axis:\n");
  PrintPercent("frequency", row.errors.frequency);
  PrintPercent("damping", row.errors.damping);
  PrintPercent("ki g/m", row.errors.ki_product);
  PrintPercent("ks/m", row.errors.ks_product);
  PrintPercent("ki g/ks", row.errors.deflection_per_ampere);
  for (std::size_t i = 0; i < row.support.size(); ++i) {
    if (row.support[i].support == Support::kShown) continue;
    fmt::print("    mode {} is flagged: not shown by the data\n", i + 1);
  }
  static_cast<void>(std::fflush(stdout));
}

nlohmann::ordered_json RowJson(const Row& row) {
  const auto list = [](const Eigen::VectorXd& v) {
    return std::vector<double>(v.data(), v.data() + v.size());
  };
  nlohmann::ordered_json json{{"seed", row.seed},
                              {"time_s", row.time_s},
                              {"frequency_error", list(row.errors.frequency)},
                              {"damping_error", list(row.errors.damping)},
                              {"ki_product_error", list(row.errors.ki_product)},
                              {"ks_product_error", list(row.errors.ks_product)},
                              {"ki_over_ks_error", list(row.errors.deflection_per_ampere)}};
  for (const SpeedQuality& q : row.quality) {
    json["misfit"].push_back({{"speed_rpm", RadPerSToRpm(q.speed_rad_per_s)},
                              {"misfit", q.misfit},
                              {"fitted", q.fitted},
                              {"fit_percent", q.percent.fit},
                              {"ceiling_percent", q.percent.ceiling}});
  }
  for (const ModeSupport& s : row.support) json["shown"].push_back(s.support == Support::kShown);
  return json;
}

/// Medians over seeds and entries; modes that are flagged do not count.
void PrintMedians(const std::vector<Row>& rows, nlohmann::ordered_json& json) {
  std::vector<double> frequency, damping, ki, ks, ratio;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.support.size(); ++i) {
      if (row.support[i].support != Support::kShown) continue;
      frequency.push_back(row.errors.frequency[static_cast<Eigen::Index>(i)]);
      damping.push_back(row.errors.damping[static_cast<Eigen::Index>(i)]);
    }
    Append(ki, row.errors.ki_product);
    Append(ks, row.errors.ks_product);
    Append(ratio, row.errors.deflection_per_ampere);
  }
  fmt::print("\nmedian errors of {} rigs\n", rows.size());
  const auto print = [&json](const char* name, const std::vector<double>& values) {
    const double median = Median(values);
    const double worst = values.empty() ? 0.0 : *std::ranges::max_element(values);
    fmt::print("  {:<12}{:>9.3f} %   (worst {:.3f} %)\n", name, 100.0 * median, 100.0 * worst);
    json["median"][name] = median;
    json["worst"][name] = worst;
  };
  print("frequency", frequency);
  print("damping", damping);
  print("ki g/m", ki);
  print("ks/m", ks);
  print("ki g/ks", ratio);
}

/// How many truths lie within two of the standard deviations that the fit states.
void PrintCoverage(const std::vector<Row>& rows, nlohmann::ordered_json& json) {
  std::vector<double> frequency, damping, ki, ks;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.support.size(); ++i) {
      if (row.support[i].support != Support::kShown) continue;
      frequency.push_back(row.scores.frequency[static_cast<Eigen::Index>(i)]);
      damping.push_back(row.scores.damping[static_cast<Eigen::Index>(i)]);
    }
    Append(ki, row.scores.ki_product);
    Append(ks, row.scores.ks_product);
  }
  fmt::print("truths within two standard deviations, as the fit states them (95 % are expected)\n");
  const auto print = [&json](const char* name, const std::vector<double>& scores) {
    const auto within =
        std::ranges::count_if(scores, [](double score) { return std::abs(score) < 2.0; });
    double worst = 0.0;
    for (const double score : scores) worst = std::max(worst, std::abs(score));
    fmt::print("  {:<12}{:>4} of {:<4} (worst at {:.1f})\n", name, within, scores.size(), worst);
    json["within_two_sigma"][name] = {within, scores.size()};
  };
  print("frequency", frequency);
  print("damping", damping);
  print("ki g/m", ki);
  print("ks/m", ks);
}

void PrintRandomStarts(const StartsOutcome& starts, const StartSpread& spread,
                       nlohmann::ordered_json& json) {
  fmt::print(
      "  {} of {} random starts (+-{:.0f} % on everything, +-{:.0f} % on gains) reach the same "
      "optimum; median {:.2f} s each\n",
      starts.same, starts.starts, 100.0 * spread.everything, 100.0 * spread.gains,
      starts.median_time_s);
  json["starts"] = {{"tried", starts.starts}, {"same", starts.same}, {"apart", starts.apart}};
}

ExitStatus Run(const IdentificationBenchOptions& options) {
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  const double delay_s = rig.plant.delay_samples * rig.numbers.period_s();
  std::vector<Row> rows;
  nlohmann::ordered_json json;
  for (int n = 0; n < options.seeds; ++n) {
    accuracy::ExcitationPlan plan;
    plan.speeds_rpm = {0.0, 1600.0, 3000.0};
    plan.amplitude_a = options.amplitude_a;
    plan.seed = options.first + static_cast<std::uint64_t>(n);
    accuracy::ModalTrial trial;
    std::vector<FrequencyResponse> responses;
    try {
      trial = accuracy::MakeModalTrial(rig, plan, options.rigid);
      responses = EstimateResponses(trial.record, delay_s, {}, ModalResponseOptions(rig));
    } catch (const std::exception& problem) {
      // Off by so much that the shipped controller does not hold it: nothing to identify.
      fmt::print("seed {} left out: {}\n", plan.seed, problem.what());
      continue;
    }
    const auto began = std::chrono::steady_clock::now();
    const ModalResult result = IdentifyModal(rig, responses, options.fit);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    rows.push_back({plan.seed, accuracy::Compare(trial.truth, result.rig),
                    accuracy::Score(trial.truth, result), result.quality, result.support,
                    took.count()});
    PrintRow(rows.back());
    json["rigs"].push_back(RowJson(rows.back()));
    if (rows.size() > 1 || options.starts == 0) continue;
    const StartsOutcome starts =
        TryStarts(result, responses, options.starts, options.spread, plan.seed);
    PrintRandomStarts(starts, options.spread, json);
  }
  PrintMedians(rows, json);
  PrintCoverage(rows, json);
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

}  // namespace

void AddBenchIdentification(CLI::App& bench, Action& action) {
  auto options = std::make_shared<IdentificationBenchOptions>();
  CLI::App* command = bench.add_subcommand("identification", "Rigs of unknown numbers, identified");
  command->footer(kBenchIdentificationHelp);
  command->add_option("--first", options->first, "Seed of the first rig")->capture_default_str();
  command->add_option("--seeds", options->seeds, "Rigs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--starts", options->starts, "Random starts with the first rig")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  AddSpreadOptions(*command, options->spread);
  command->add_option("--amplitude-a", options->amplitude_a, "Of the excitation")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  command
      ->add_option("--mass-off", options->rigid.mass,
                   "Standard deviation of the rig file's mass; 0: weighed")
      ->check(CLI::Range(0.0, 0.2))
      ->capture_default_str();
  command
      ->add_option("--inertia-off", options->rigid.inertia,
                   "The same of the inertia, beside what the mass takes along; 0: as drawn")
      ->check(CLI::Range(0.0, 0.2))
      ->capture_default_str();
  command->add_option("--highest-hz", options->fit.highest_hz, "Lines beyond it are not fitted")
      ->check(CLI::Range(50.0, 1e5))
      ->capture_default_str();
  command->add_option("--json", options->json_path, "Every rig");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
