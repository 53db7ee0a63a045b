// amb sessions: the catalogue of recorded sessions; finds them, tags them, forgets them.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "cli/commands/command.hpp"
#include "cli/commands/compress_sessions.hpp"
#include "cli/json_file.hpp"
#include "cli/utc_text.hpp"
#include "common/rotational_speed.hpp"
#include "rt/say.hpp"
#include "session_index/catalogue.hpp"
#include "session_index/catalogue_path.hpp"
#include "session_index/describe_session.hpp"
#include "verdict/session_statistics.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;
using session_index::Catalogue;
using session_index::Entry;

struct SessionsOptions {
  std::string catalogue_path;
  session_index::Filter filter;
  std::string from, to;
  std::string json_path;
  std::vector<std::string> paths;
  std::string tagged_path;
  std::vector<std::string> tags;
  bool remove{};
  bool gone{};
  bool keep{};
};

std::string PathOfCatalogue(const SessionsOptions& options) {
  if (!options.catalogue_path.empty()) return options.catalogue_path;
  if (const auto path = session_index::CataloguePath()) return *path;
  throw Problem(ExitStatus::kUsage,
                "no catalogue of sessions: LEVITAS_CATALOGUE is empty, or there is no home folder; "
                "name a file with --catalogue");
}

/// As the catalogue knows a file, whether or not it is still there.
std::string Known(const std::string& path) {
  return fs::absolute(path).lexically_normal().string();
}

bool IsThere(const Entry& entry) {
  std::error_code none;
  return fs::is_regular_file(entry.path, none);
}

nlohmann::ordered_json Json(const Entry& entry) {
  return {{"session", entry.path},
          {"there", IsThere(entry)},
          {"start_utc", UtcText(entry.start_utc_ns)},
          {"duration_s", entry.duration_s},
          {"cycles", entry.cycles},
          {"size_byte", entry.size_byte},
          {"rig", entry.rig},
          {"controller", entry.controller},
          {"scenario", entry.scenario},
          {"pace", entry.pace},
          {"port", entry.port},
          {"top_speed_rpm", RadPerSToRpm(entry.top_speed_rad_per_s)},
          {"outcome", entry.outcome},
          {"sentence", entry.sentence},
          {"damage", entry.damage},
          {"tags", entry.tags},
          {"program_version", entry.program_version}};
}

void Print(const Entry& entry) {
  using rt::OneLine;  // what a session or the catalogue says makes no row of its own
  const std::string what = entry.scenario.empty() ? entry.pace : entry.scenario;
  fmt::print("{:<21}{:>8.1f} s{:>8.1f} MB  {:<22}{:<16}{:<13}{}{}\n", UtcText(entry.start_utc_ns),
             entry.duration_s, static_cast<double>(entry.size_byte) * 1e-6, OneLine(entry.rig),
             OneLine(what), OneLine(entry.outcome), OneLine(entry.path),
             IsThere(entry) ? "" : "   (gone)");
  std::string more;
  for (const std::string& tag : entry.tags) more += (more.empty() ? "tags " : ", ") + OneLine(tag);
  if (!entry.damage.empty()) more += (more.empty() ? "" : "; ") + OneLine(entry.damage);
  if (!more.empty()) fmt::print("{:23}{}\n", "", more);
}

/// After a search that found nothing: which rigs there are sessions of.
std::string WhatIsThere(const SessionsOptions& options) {
  const std::vector<Entry> all = Catalogue(PathOfCatalogue(options)).Find({});
  if (all.empty()) return ": nothing is recorded yet; amb run and amb sessions add enter sessions";
  std::set<std::string> rigs;
  for (const Entry& entry : all) rigs.insert(rt::OneLine(entry.rig));
  return fmt::format(" of the {} recorded ones match; their rigs: {}", all.size(),
                     fmt::join(rigs, ", "));
}

ExitStatus List(const SessionsOptions& options) {
  session_index::Filter filter = options.filter;
  if (!options.from.empty()) filter.from_utc_ns = ParseUtc(options.from, "--from").begin_ns;
  if (!options.to.empty()) filter.before_utc_ns = ParseUtc(options.to, "--to").end_ns;
  const std::vector<Entry> found = Catalogue(PathOfCatalogue(options)).Find(filter);
  auto sessions = nlohmann::ordered_json::array();
  for (const Entry& entry : found) {
    Print(entry);
    sessions.push_back(Json(entry));
  }
  fmt::print("{} session{}{}\n", found.size(), found.size() == 1 ? "" : "s",
             found.empty() ? WhatIsThere(options) : "");
  WriteJsonFile(options.json_path, {{"sessions", sessions}});
  return ExitStatus::kDone;
}

/// The files named and, of folders, what is inside and may be a session.
std::vector<std::string> Files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const auto& inside : fs::recursive_directory_iterator(path)) {
      fs::path plain = inside.path();
      if (plain.extension() == ".zst") plain.replace_extension();
      const auto extension = plain.extension();
      if (inside.is_regular_file() && (extension == ".lcm" || extension == ".lcmlog")) {
        files.push_back(inside.path().string());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// What the file is; nothing, and a line more in `refused`, whatever is wrong with it.
std::optional<Entry> Described(const std::string& file, std::string& refused) {
  const auto refuse = [&refused](const std::string& why) {
    refused += (refused.empty() ? "" : "\n") + why;
    return std::nullopt;
  };
  try {
    return session_index::DescribeSession(file);
  } catch (const BadInput& problem) {
    return refuse(problem.what());
  } catch (const std::exception& problem) {
    return refuse(file + ": " + problem.what());
  }
}

ExitStatus Add(const SessionsOptions& options) {
  Catalogue catalogue(PathOfCatalogue(options));
  std::string refused;
  auto entered = nlohmann::ordered_json::array();
  for (const std::string& file : Files(options.paths)) {
    std::optional<Entry> entry = Described(file, refused);
    if (!entry) continue;  // the others are still entered
    entry->tags = options.tags;
    catalogue.Put(*entry);
    Print(*entry);
    entered.push_back(Json(*entry));
  }
  WriteJsonFile(options.json_path, {{"sessions", entered}, {"refused", refused}});
  if (!refused.empty()) throw BadInput(refused);
  return ExitStatus::kDone;
}

[[noreturn]] void RefuseUnknown(const std::string& path) {
  throw BadInput(path + ": not in the catalogue; enter it with: amb sessions add " + path);
}

ExitStatus Tag(const SessionsOptions& options) {
  Catalogue catalogue(PathOfCatalogue(options));
  const std::string path = Known(options.tagged_path);
  for (const std::string& tag : options.tags) {
    const bool known =
        options.remove ? catalogue.RemoveTag(path, tag) : catalogue.AddTag(path, tag);
    if (known) continue;
    if (options.remove) {
      throw BadInput(fmt::format("{}: has no tag '{}' in the catalogue", path, tag));
    }
    RefuseUnknown(path);
  }
  WriteJsonFile(options.json_path,
                {{"session", path}, {options.remove ? "removed" : "added", options.tags}});
  return ExitStatus::kDone;
}

ExitStatus Forget(const SessionsOptions& options) {
  if (options.paths.empty() && !options.gone) {
    throw Problem(ExitStatus::kUsage, "nothing to forget: name sessions, or --gone");
  }
  Catalogue catalogue(PathOfCatalogue(options));
  auto forgotten = nlohmann::ordered_json::array();
  for (const std::string& path : options.paths) {
    if (!catalogue.Forget(Known(path))) RefuseUnknown(path);
    forgotten.push_back(Known(path));
  }
  if (options.gone) {
    for (const Entry& entry : catalogue.Find({})) {
      if (IsThere(entry)) continue;
      catalogue.Forget(entry.path);
      forgotten.push_back(entry.path);
      fmt::print("forgotten: {}\n", rt::OneLine(entry.path));
    }
  }
  WriteJsonFile(options.json_path, {{"forgotten", forgotten}});
  return ExitStatus::kDone;
}

ExitStatus Compress(const SessionsOptions& options) {
  CompressOptions wish{.files = Files(options.paths), .keep = options.keep, .catalogue = {}};
  wish.catalogue = options.catalogue_path.empty() ? session_index::CataloguePath()
                                                  : std::optional(options.catalogue_path);
  std::string refused;
  auto packed = nlohmann::ordered_json::array();
  for (const Compressed& done : CompressSessions(wish, refused)) {
    packed.push_back({{"session", done.session},
                      {"from", done.from},
                      {"before_byte", done.before_byte},
                      {"after_byte", done.after_byte}});
  }
  WriteJsonFile(options.json_path, {{"sessions", packed}, {"refused", refused}});
  if (!refused.empty()) throw BadInput(refused);
  return ExitStatus::kDone;
}

using Options = std::shared_ptr<SessionsOptions>;

void AddJson(CLI::App& command, const Options& options) {
  command.add_option("--json", options->json_path, "Write what was done to this file");
}

void AddSessionsAdd(CLI::App& sessions, const Options& options, Action& action) {
  CLI::App* add = sessions.add_subcommand("add", "Enter sessions, or renew what is known of them");
  add->fallthrough();  // --catalogue is known behind it, too
  add->add_option("PATH", options->paths,
                  "Sessions, or folders with .lcm and .lcmlog files in them, packed ones too")
      ->required()
      ->check(CLI::ExistingPath);
  add->add_option("--tag", options->tags, "Tag them all; may be repeated");
  AddJson(*add, options);
  add->callback([options, &action] { action = [options] { return Add(*options); }; });
}

void AddSessionsTag(CLI::App& sessions, const Options& options, Action& action) {
  CLI::App* tag = sessions.add_subcommand("tag", "Tag a session of the catalogue");
  tag->fallthrough();
  tag->add_option("SESSION", options->tagged_path, "The session")->required();
  tag->add_option("TAG", options->tags, "Tags to add, or to take away")->required();
  tag->add_flag("--remove", options->remove, "Take the tags away");
  AddJson(*tag, options);
  tag->callback([options, &action] { action = [options] { return Tag(*options); }; });
}

void AddSessionsForget(CLI::App& sessions, const Options& options, Action& action) {
  CLI::App* forget =
      sessions.add_subcommand("forget", "Drop entries of the catalogue; the files stay");
  forget->fallthrough();
  forget->add_option("SESSION", options->paths, "Sessions to forget");
  forget->add_flag("--gone", options->gone, "Forget every session whose file is no longer there");
  AddJson(*forget, options);
  forget->callback([options, &action] { action = [options] { return Forget(*options); }; });
}

void AddSessionsCompress(CLI::App& sessions, const Options& options, Action& action) {
  CLI::App* compress = sessions.add_subcommand(
      "compress",
      "Pack recorded sessions by zstd: x.lcm becomes x.lcm.zst, which all commands read");
  compress->fallthrough();
  compress
      ->add_option("PATH", options->paths,
                   "Sessions, or folders with .lcm and .lcmlog files in them")
      ->required()
      ->check(CLI::ExistingPath);
  compress->add_flag("--keep", options->keep, "Keep the plain sessions beside the packed ones");
  AddJson(*compress, options);
  compress->callback([options, &action] { action = [options] { return Compress(*options); }; });
}

}  // namespace

void AddSessionsCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<SessionsOptions>();
  CLI::App* command = app.add_subcommand(
      "sessions", "Recorded sessions: what was run, when, with which outcome; finds and tags them");
  command->add_option("--rig", options->filter.rig, "Only of this rig");
  command->add_option("--outcome", options->filter.outcome, "Only with this outcome")
      ->check(CLI::IsMember(
          {"accepted", "not_accepted", "tripped", "incomplete", session_index::kNotJudged}));
  command->add_option("--tag", options->filter.tags, "Only with this tag; may be repeated");
  command->add_option("--text", options->filter.text,
                      "Only with this text in path, controller, scenario or port");
  command->add_option("--from", options->from, "Only from this day or minute on (UTC)");
  command->add_option("--to", options->to, "Only up to the end of this day or minute (UTC)");
  command->add_option("--catalogue", options->catalogue_path,
                      "SQLite file; default: $LEVITAS_CATALOGUE, else "
                      "~/.local/share/levitas/sessions.db");
  command->add_option("--json", options->json_path, "Write what was found to this file");
  AddSessionsAdd(*command, options, action);
  AddSessionsTag(*command, options, action);
  AddSessionsForget(*command, options, action);
  AddSessionsCompress(*command, options, action);
  command->require_subcommand(0, 1);
  command->callback([command, options, &action] {
    if (command->get_subcommands().empty()) action = [options] { return List(*options); };
  });
  command->footer(
      "What amb run --record and amb import write is entered by itself.\n"
      "  amb sessions --rig flexible_rotor --outcome tripped --from 2026-11-01\n"
      "  amb sessions tag run.lcm baseline\n"
      "  amb sessions add ~/measurements\n"
      "  amb sessions compress ~/measurements");
}

}  // namespace levitas::cli
