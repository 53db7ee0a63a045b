// amb bench lives: does the rotor ever end in contact at speed that is not documented?

#include "cli/study/bench_lives.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmark/lives/campaign.hpp"
#include "cli/json_file.hpp"
#include "cli/study/progress_line.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kBenchLivesHelp =
    "Every seed is one life: the real control loop, command arbiter and protections with the "
    "nonlinear rig in virtual time; a profile of speed, and one of 26 kinds of trouble in turn: "
    "frames and currents lost, in bursts, late, out of order, twice, old; wrong speeds and "
    "positions; late, killed and restarted programs; stops, commands, test signals, an end; two "
    "at once. The plant itself is judged, not what the sensors say: contact at speed under "
    "current, amplifiers off at speed, a landing at speed, a rotor left turning, one that is not "
    "braked. What docs/safety.md allows is counted in the columns released and contacts. Exit "
    "status 1 when a life failed; each has a line with its seed.\n"
    "Example: amb bench lives --seeds 2000\n"
    "         amb bench lives --first 84 --seeds 1     (one life, with its story)";

struct LivesOptions {
  std::string rig_name{"flexible_rotor"};
  std::string controller_name;  ///< empty: the one that amb run takes
  std::string json_path;
  lives::CampaignOptions campaign{.first = 1, .seeds = 26, .seconds = 10.0, .jobs = 1};
};

nlohmann::ordered_json Json(const lives::LifeResult& life) {
  auto kinds = nlohmann::ordered_json::array();
  for (const lives::Kind kind : life.kinds) kinds.push_back(lives::Name(kind));
  auto harms = nlohmann::ordered_json::array();
  for (const lives::HarmFound& found : life.harms) {
    harms.push_back({{"harm", lives::Name(found.harm)},
                     {"at_s", found.at_s},
                     {"speed_rpm", found.speed_rpm},
                     {"how", found.how}});
  }
  return {{"seed", life.seed},
          {"kinds", kinds},
          {"story", life.story},
          {"harms", harms},
          {"fault", Name(life.fault)},
          {"releases", life.releases},
          {"released_rpm", life.released_rpm},
          {"documented_contact_periods", life.documented_contacts},
          {"highest_rpm", life.highest_rpm}};
}

ExitStatus Run(const LivesOptions& options) {
  const lives::LifeRig rig = lives::LoadLifeRig(options.rig_name, options.controller_name);
  const std::uint64_t seeds = options.campaign.seeds;
  std::uint64_t lived = 0;
  std::uint64_t failed = 0;
  ProgressLine progress(stderr, isatty(STDERR_FILENO) != 0);
  const auto all = lives::RunLives(rig, options.campaign, [&](const lives::LifeResult& life) {
    ++lived;
    if (!life.harms.empty()) ++failed;
    progress.Show(static_cast<double>(lived) / static_cast<double>(seeds),
                  fmt::format("{} of {} lives, {} failed", lived, seeds, failed));
  });
  progress.Close();
  nlohmann::ordered_json json{{"rig", rig.config.rig.name}, {"failed", failed}};
  json["lives"] = nlohmann::ordered_json::array();
  for (const lives::LifeResult& life : all) {
    fmt::print("{}", seeds == 1 ? lives::Story(life) : lives::Row(life));
    json["lives"].push_back(Json(life));
  }
  fmt::print("\n{}", lives::Table(all));
  WriteJsonFile(options.json_path, json);
  return failed == 0 ? ExitStatus::kDone : ExitStatus::kOther;
}

}  // namespace

void AddBenchLives(CLI::App& bench, Action& action) {
  auto options = std::make_shared<LivesOptions>();
  lives::CampaignOptions& campaign = options->campaign;
  CLI::App* command = bench.add_subcommand("lives", "Does a faulty life let a turning rotor fall?");
  command->footer(kBenchLivesHelp);
  command->add_option("--rig", options->rig_name, "Rig file, or the name of a shipped rig")
      ->capture_default_str();
  command->add_option("--controller", options->controller_name,
                      "Controller file or shipped name; default: the one that amb run takes");
  command->add_option("--seeds", campaign.seeds, "Lives")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->add_option("--first", campaign.first, "Seed of the first life")->capture_default_str();
  command->add_option("--seconds", campaign.seconds, "Length of a life")
      ->check(CLI::Range(4.0, 1000.0))
      ->capture_default_str();
  command->add_option("--jobs", campaign.jobs, "Lives at a time")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--json", options->json_path, "Every life");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
