#include "cli/options/rig_of_records.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <sstream>

#include "common/problem.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "rt/say.hpp"
#include "session/exchange/rig_of_session.hpp"

namespace levitas::cli {
namespace {

/// A record that says of which rig it is.
struct OwnRig {
  std::string path;
  configuration::RigFile rig;
};

std::vector<OwnRig> RigsOf(const std::vector<std::string>& records) {
  std::vector<OwnRig> rigs;
  for (const std::string& path : records) {
    if (auto rig = session::RigOfSession(path)) rigs.push_back({path, std::move(*rig)});
  }
  return rigs;
}

/// Complete text of what an answer depends on, line by line.
std::vector<std::string> LinesOf(configuration::RigFile rig) {
  rig.numbers.name.clear();
  rig.run = {};
  rig.lines = {};
  rig.log = {};
  std::istringstream text(configuration::WriteRig(rig));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::string Trimmed(const std::string& line) {
  const auto first = line.find_first_not_of(" -");
  return first == std::string::npos ? std::string{} : line.substr(first);
}

/// The groups that line `index` is in, outermost first: "bearings, de, magnet, ".
std::string GroupsOf(const std::vector<std::string>& lines, std::size_t index) {
  std::string groups;
  std::size_t depth = lines[index].find_first_not_of(' ');
  for (std::size_t i = index; i-- > 0 && depth > 0;) {
    const std::size_t outer = lines[i].find_first_not_of(' ');
    if (outer >= depth) continue;
    depth = outer;
    std::string group = Trimmed(lines[i]);
    if (group.starts_with("name: ")) group.erase(0, std::string_view("name: ").size());
    while (group.ends_with(':')) group.pop_back();
    groups.insert(0, group + ", ");
  }
  return groups;
}

/// What the loader of records refuses needs no warning.
bool IsRefused(const configuration::RigFile& session, const configuration::RigFile& named) {
  return session.numbers.period_ns != named.numbers.period_ns ||
         session.numbers.channels != named.numbers.channels;
}

void TellOtherRig(const OwnRig& own, const configuration::RigFile& named, const std::string& path) {
  if (IsRefused(own.rig, named)) return;
  const std::string difference = RigDifference(own.rig, named);
  if (difference.empty()) return;
  const bool same_name = own.rig.numbers.name == named.numbers.name;
  rt::Say(fmt::format(
      "amb: warning: {} was recorded with rig {}, --rig names {} ({}), which is {} ({}): what "
      "follows is about {}. Without --rig it is about the session's own rig",
      rt::OneLine(own.path), own.rig.numbers.name,
      same_name ? "one of that name" : named.numbers.name, rt::OneLine(path),
      same_name ? "not the same" : "another one", difference, rt::OneLine(path)));
}

void TellEffects(const OwnRig& own) {
  std::vector<std::string> names;
  for (const auto& effect : own.rig.plant.effects) names.emplace_back(effect::At(effect.id).name);
  if (names.empty()) return;
  rt::Say(
      fmt::format("amb: note: the rig in {} has effects of its own ({}), and so has the model "
                  "here. --rig names a rig without them",
                  rt::OneLine(own.path), fmt::join(names, ", ")));
}

configuration::RigFile OnlyRig(std::vector<OwnRig>& rigs) {
  for (const OwnRig& other : rigs) {
    const std::string difference =
        RigDifference(rigs.front().rig, other.rig, {"of the one", "of the other"});
    if (difference.empty()) continue;
    throw BadInput(fmt::format(
        "{} was recorded with rig {}, {} with rig {}, which is another one ({}): name the rig that "
        "the model is to have with --rig",
        rigs.front().path, rigs.front().rig.numbers.name, other.path, other.rig.numbers.name,
        difference));
  }
  TellEffects(rigs.front());
  return std::move(rigs.front().rig);
}

}  // namespace

void AddRigOfRecordsOption(CLI::App& command, AnalysisOptions& options) {
  command.add_option("--rig", options.rig_named,
                     fmt::format("Rig file, or the name of a shipped rig; default: the one in the "
                                 "session, {} for records that hold none",
                                 options.rig_name));
}

std::string RigDifference(const configuration::RigFile& first_rig,
                          const configuration::RigFile& second_rig, const WhichRigs& which) {
  const auto one = LinesOf(first_rig);
  const auto other = LinesOf(second_rig);
  const auto [first, second] = std::ranges::mismatch(one, other);
  if (first == one.end() && second == other.end()) return {};
  const auto index = static_cast<std::size_t>(first - one.begin());
  const auto text = [index](const std::vector<std::string>& lines) {
    return index < lines.size() ? Trimmed(lines[index]) : std::string("nothing");
  };
  return fmt::format("first difference: {}{} {}, {} {}",
                     GroupsOf(index < one.size() ? one : other, index), text(one), which.first,
                     text(other), which.second);
}

configuration::RigFile LoadRigOfRecords(const AnalysisOptions& options,
                                        const std::vector<std::string>& records) {
  if (options.rig_named.empty()) {
    std::vector<OwnRig> rigs = RigsOf(records);
    return rigs.empty() ? LoadRig(options) : OnlyRig(rigs);
  }
  const std::string path = configuration::FindConfig(options.rig_named, "rigs");
  configuration::RigFile named = configuration::LoadRig(path);
  for (const std::string& record : records) {
    try {
      const auto own = session::RigOfSession(record);
      if (own) TellOtherRig({record, *own}, named, path);
    } catch (const BadInput&) {
      rt::Say(
          fmt::format("amb: note: the rig in {} cannot be read, so --rig is not compared with it",
                      rt::OneLine(record)));
    }
  }
  return named;
}

}  // namespace levitas::cli
