// amb doctor: is this machine fit for real time, LCM, CAN, GPIO, recording; what to do where not.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.hpp"
#include "cli/json_file.hpp"
#include "configuration/rig_file.hpp"
#include "doctor/checks.hpp"
#include "doctor/system_probe.hpp"
#include "hil/can/budget.hpp"
#include "transport/network_key.hpp"

namespace levitas::cli {
namespace {

using doctor::Area;
using doctor::Finding;
using doctor::State;

struct DoctorOptions {
  std::string json_path;
  std::string key_path;  ///< key of a network to be looked at; empty: none
  std::string bus_rig;   ///< rig file or shipped name: judge its buses instead of this machine
};

constexpr std::array kAreas{Area::kRealTime, Area::kLcm, Area::kCan, Area::kGpio, Area::kStorage};

void PrintFindings(const std::vector<Finding>& findings) {
  for (const Area area : kAreas) {
    fmt::print("{}\n", Name(area));
    for (const Finding& finding : findings) {
      if (finding.area != area) continue;
      fmt::print("  {:<9} {:<14} {}\n", Name(finding.state), finding.check, finding.found);
      if (!finding.remedy.empty()) fmt::print("  {:<9} {:<14} -> {}\n", "", "", finding.remedy);
    }
  }
}

/// "fit", "fit, with limits: a, b" or "not fit: c".
std::string Verdict(const std::vector<Finding>& findings, Area area) {
  switch (Worst(findings, area)) {
    case State::kOk:
      return "fit";
    case State::kDegraded:
      return fmt::format("fit, with limits: {}",
                         fmt::join(ChecksIn(findings, area, State::kDegraded), ", "));
    case State::kMissing:
      return fmt::format("not fit: {}", fmt::join(ChecksIn(findings, area, State::kMissing), ", "));
  }
  return "";
}

std::string LockstepVerdict(const std::vector<Finding>& findings) {
  if (FitForLockstep(findings)) return "fit";
  auto names = ChecksIn(findings, Area::kLcm, State::kMissing);
  for (auto& name : ChecksIn(findings, Area::kStorage, State::kMissing)) names.push_back(name);
  return fmt::format("not fit: {}", fmt::join(names, ", "));
}

void PrintVerdicts(const std::vector<Finding>& findings) {
  fmt::print("\nThis machine\n");
  fmt::print("  simulated rig in lockstep (amb run)       {}\n", LockstepVerdict(findings));
  fmt::print("  real time at 10 kHz (--pace realtime)     {}\n",
             Verdict(findings, Area::kRealTime));
  fmt::print("  LCM between programs                      {}\n", Verdict(findings, Area::kLcm));
  fmt::print("  rig on a CAN bus                          {}\n", Verdict(findings, Area::kCan));
  fmt::print("  GPIO lines                                {}\n", Verdict(findings, Area::kGpio));
}

nlohmann::ordered_json Json(const std::vector<Finding>& findings) {
  nlohmann::ordered_json json;
  const auto possible = [&](Area area) { return Worst(findings, area) != State::kMissing; };
  json["fit"] = {{"lockstep", FitForLockstep(findings)},
                 {"realtime", possible(Area::kRealTime) && FitForLockstep(findings)},
                 {"can", possible(Area::kCan)},
                 {"gpio", possible(Area::kGpio)}};
  for (const Area area : kAreas) json["state"][Name(area)] = Name(Worst(findings, area));
  for (const Finding& finding : findings) {
    json["findings"].push_back({{"area", Name(finding.area)},
                                {"check", finding.check},
                                {"state", Name(finding.state)},
                                {"found", finding.found},
                                {"remedy", finding.remedy}});
  }
  return json;
}

nlohmann::ordered_json Json(const can::Budget& budget) {
  nlohmann::ordered_json json{{"fits", budget.fits()},
                              {"rate_hz", budget.rate_hz},
                              {"highest_rate_hz", budget.highest_rate_hz},
                              {"from_rig_us", budget.from_rig_s * 1e6},
                              {"to_rig_us", budget.to_rig_s * 1e6},
                              {"blocking_us", budget.blocking_s * 1e6}};
  for (const can::BusLoad& bus : budget.buses) {
    nlohmann::ordered_json entry{{"name", bus.bus.name},
                                 {"interface", bus.bus.interface},
                                 {"load", bus.load},
                                 {"load_limit", bus.bus.load_limit},
                                 {"highest_rate_hz", bus.highest_rate_hz}};
    for (const can::MessageLoad& message : bus.messages) {
      entry["messages"].push_back({{"name", message.name},
                                   {"bytes", message.bytes},
                                   {"every_periods", message.every},
                                   {"worst_frame_us", message.frame_time_s * 1e6},
                                   {"load", message.load}});
    }
    json["buses"].push_back(entry);
  }
  return json;
}

Finding LookAtKey(const std::string& path) {
  try {
    static_cast<void>(transport::NetworkKey::Load(path));
    return {Area::kLcm, "key", State::kOk, path + ": whoever has a copy may speak", ""};
  } catch (const Problem& problem) {
    return {Area::kLcm, "key", State::kDegraded, problem.what(),
            fmt::format("chmod 600 {0}, or amb key {0} for a new one", path)};
  }
}

ExitStatus JudgeBuses(const DoctorOptions& options) {
  const std::string path = configuration::FindConfig(options.bus_rig, "rigs");
  const configuration::RigFile rig = configuration::LoadRig(path);
  if (rig.buses.empty())
    throw BadInput(path + ": names no CAN buses (section buses, docs/real_rig.md)");
  const can::Layout layout = can::MakeLayout(rig.numbers, can::FormatOf(rig.buses));
  const can::Budget budget = can::MakeBudget(layout, rig.buses);
  fmt::print("{}{}", can::BudgetText(budget), can::RefusalText(budget));
  WriteJsonFile(options.json_path, Json(budget));
  return budget.fits() ? ExitStatus::kDone : ExitStatus::kOther;
}

}  // namespace

void AddDoctorCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command = app.add_subcommand(
      "doctor", "Is this machine fit for real time, LCM, CAN and GPIO, and what to do where not");
  command->add_option(
      "--bus", options->bus_rig,
      "Judge the CAN buses of this rig file (or shipped rig) instead: worst frame "
      "times, load, the highest rate that fits; exit status 1 when they do not fit");
  command->add_option("--key", options->key_path,
                      "Look also at this key file of a network: owner, permissions, content");
  command->add_option("--json", options->json_path, "Write the findings to this file");
  command->callback([options, &action] {
    action = [options] {
      if (!options->bus_rig.empty()) return JudgeBuses(*options);
      auto findings =
          doctor::CheckMachine(doctor::SystemProbe{}, std::filesystem::current_path().string());
      if (!options->key_path.empty()) findings.push_back(LookAtKey(options->key_path));
      PrintFindings(findings);
      PrintVerdicts(findings);
      WriteJsonFile(options->json_path, Json(findings));
      return FitForLockstep(findings) ? ExitStatus::kDone : ExitStatus::kOther;
    };
  });
}

}  // namespace levitas::cli
