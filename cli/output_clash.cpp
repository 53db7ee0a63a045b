#include "cli/output_clash.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "session/output_path.hpp"
#include "session_index/catalogue_path.hpp"

namespace levitas::cli {
namespace {

using session::NamedPath;

constexpr std::array<std::string_view, 17> kWrites{
    "--record",    "--json",         "--csv",     "--mat",       "--mcap",     "--out",
    "--svg",       "--plan",         "--picture", "--write",     "--document", "--html",
    "--worst-rig", "--write-design", "--page",    "--write-rig", "--lcm"};

/// Words, not files, although there may be a file of that name.
constexpr std::array<std::string_view, 5> kWords{"--tag", "TAG", "--text", "--outcome", "--port"};

/// Where a value of --rig and the like is looked for; empty where it is a path.
std::string ConfigFolderOf(const std::string& option) {
  if (option == "--rig" || option == "--bus") return "rigs";
  if (option == "--controller") return "controllers";
  if (option == "--scenario") return "scenarios";
  return {};
}

std::string PathGiven(const std::string& value, const std::string& folder) {
  if (folder.empty()) return value;
  try {
    return config::FindConfig(value, folder);
  } catch (const BadInput&) {
    return {};  // the command says it better
  }
}

std::vector<std::string> GivenOrDefault(const CLI::Option& option) {
  if (!option.results().empty()) return option.results();
  if (option.get_default_str().empty()) return {};
  return {option.get_default_str()};
}

void CollectPaths(const CLI::App& command, std::vector<NamedPath>& written,
                  std::vector<NamedPath>& read) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // a flag
    const bool named = !option->get_lnames().empty();
    const std::string name =
        named ? "--" + option->get_lnames().front() : option->get_name(true, false);
    if (std::ranges::find(kWords, name) != kWords.end()) continue;
    const bool writes = std::ranges::find(kWrites, name) != kWrites.end();
    for (const std::string& value : GivenOrDefault(*option)) {
      const std::string path = PathGiven(value, ConfigFolderOf(name));
      if (!path.empty()) (writes ? written : read).push_back({name, path});
    }
  }
  for (const CLI::App* below : command.get_subcommands()) CollectPaths(*below, written, read);
}

}  // namespace

void RefuseClashes(const CLI::App& app) {
  std::vector<NamedPath> written;
  std::vector<NamedPath> read;
  CollectPaths(app, written, read);
  if (written.empty()) return;
  if (const auto path = session_index::CataloguePath()) {
    read.push_back({"the catalogue of sessions", *path});
  }
  session::RefuseClash(written, read);
}

}  // namespace levitas::cli
