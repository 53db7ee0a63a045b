// amb doctor: is this machine fit for real time, LCM, CAN, GPIO, recording; what to do where not.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "hil/machine/checks.hpp"
#include "hil/machine/system_probe.hpp"

namespace levitas::cli {
namespace {

using machine::Area;
using machine::Finding;
using machine::State;

struct DoctorOptions {
  std::string json_path;
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

}  // namespace

void AddDoctorCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command = app.add_subcommand(
      "doctor", "Is this machine fit for real time, LCM, CAN and GPIO, and what to do where not");
  command->add_option("--json", options->json_path, "Write the findings to this file");
  command->callback([options, &action] {
    action = [options] {
      const auto findings =
          machine::CheckMachine(machine::SystemProbe{}, std::filesystem::current_path().string());
      PrintFindings(findings);
      PrintVerdicts(findings);
      WriteJsonFile(options->json_path, Json(findings));
      return FitForLockstep(findings) ? ExitStatus::kDone : ExitStatus::kOther;
    };
  });
}

}  // namespace levitas::cli
