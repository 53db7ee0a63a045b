#include "cli/output_clash.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "cli/json_file.hpp"
#include "common/output_file.hpp"
#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "session/log/output_path.hpp"
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
    return configuration::FindConfig(value, folder);
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

/// A command that computes for minutes would fail at its end. Not the folders that are made when
/// they are needed, nor the beginnings of names.
void RefuseUnwritable(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() == 0 || option->get_lnames().empty()) continue;
    const std::string name = "--" + option->get_lnames().front();
    if (std::ranges::find(kWrites, name) == kWrites.end()) continue;
    if (option->get_description().starts_with("Folder ")) continue;
    const bool prefix = option->get_description().find("names begin with") != std::string::npos;
    for (const std::string& path : option->results()) {
      if (path == kJsonToStandardOutput || IsWrittenAsItIs(path)) continue;
      prefix ? session::CheckOutputFolder(path) : session::CheckOutputPath(path, {});
    }
  }
  for (const CLI::App* below : command.get_subcommands()) RefuseUnwritable(*below);
}

/// The earlier file would be kept under a name that is read.
void RefuseKeptOverRead(const std::vector<NamedPath>& written, const std::vector<NamedPath>& read) {
  for (const NamedPath& out : written) {
    std::error_code none;
    if (out.name == "--json" || !std::filesystem::is_regular_file(out.path, none)) continue;
    session::RefuseClash(
        {{fmt::format("what stands under {} is kept as", out.name), out.path + ".old"}}, read);
  }
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
  RefuseKeptOverRead(written, read);
  RefuseUnwritable(app);
}

}  // namespace levitas::cli
