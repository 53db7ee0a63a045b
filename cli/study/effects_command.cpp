// amb effects: the catalogue of what a rig may do beyond its nominal model, and what each looks
// like.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.hpp"
#include "cli/commands/study_commands.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "common/nearest.hpp"
#include "common/output_file.hpp"
#include "configuration/schema/unit.hpp"
#include "plant_sim/plant/applied_effects/clear_entry.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "report/signature/signature.hpp"

namespace levitas::cli {
namespace {

struct EffectsOptions : AnalysisOptions {
  std::string id;
  std::string picture_path;
  std::string pictures_folder;
  std::string document_path;
};

const effect::Row& RowOf(const std::string& id) {
  if (const effect::Row* row = effect::Find(id)) return *row;
  std::vector<std::string> names;
  for (const effect::Row& row : effect::Catalogue()) names.emplace_back(row.name);
  throw Problem(
      ExitStatus::kUsage,
      fmt::format("no effect '{}'; nearest: {}. `amb effects` lists all", id, Nearest(id, names)));
}

void PrintAll() {
  for (const effect::Row& row : effect::Catalogue()) {
    std::string keys;
    for (const effect::Parameter& p : row.parameters)
      keys += (keys.empty() ? "" : ", ") + effect::FileKey(p);
    fmt::print("{:<10} {:<24} {:<9} {}\n", effect::Name(row.place), row.name,
               effect::Name(row.scope), keys);
  }
  fmt::print(
      "\n`amb effects ID` explains one, --picture FILE draws it, docs/effects.md has them all.\n");
}

void PrintOne(const effect::Row& row) {
  fmt::print("{} ({}, per {}): {}\n  equation   {}\n  signature  {}\n  source     {}\n", row.name,
             effect::Name(row.place), effect::Name(row.scope), row.meaning, row.equation,
             row.signature, row.source);
  for (const effect::Parameter& p : row.parameters) {
    const configuration::Unit& unit = signature::FileUnit(p);
    const auto text = [&unit](double si) { return configuration::FromSi(si, unit); };
    fmt::print("  {:<22} {} ({} to {}{})\n", effect::FileKey(p), p.meaning, text(p.low),
               text(p.high), p.fallback ? ", default " + text(*p.fallback) : "");
  }
  if (!effect::IsEntry(row))
    fmt::print("  in a rig file          {}\n", effect::InPlaceOfAnEntry(row));
}

/// A JSON number, or a word for the two values that are none.
nlohmann::ordered_json Value(double value) {
  if (std::isnan(value)) return "own";
  if (std::isinf(value)) return "infinite";
  return value;
}

nlohmann::ordered_json RowJson(const effect::Row& row) {
  nlohmann::ordered_json json{{"id", row.name},
                              {"place", effect::Name(row.place)},
                              {"per", effect::Name(row.scope)},
                              {"meaning", row.meaning},
                              {"equation", row.equation},
                              {"signature", row.signature},
                              {"source", row.source},
                              {"entry", effect::IsEntry(row)}};
  for (const effect::Parameter& p : row.parameters) {
    json["parameters"].push_back({{"name", p.stem},
                                  {"unit", p.si_suffix},
                                  {"key", effect::FileKey(p)},
                                  {"low", p.low},
                                  {"high", p.high},
                                  {"neutral", Value(p.neutral)},
                                  {"clear", p.clear},
                                  {"meaning", p.meaning}});
  }
  return json;
}

void WriteDocument(const std::string& path) {
  if (!path.empty()) WriteWholeFile(path, signature::EffectsDocument());
}

/// The rig asked for; for effects of teeth one that has them.
plant::PlantParameters RigFor(const effect::Row& row, const EffectsOptions& options) {
  const auto asked = LoadRig(options).plant;
  if (row.place != effect::Place::kGear || !asked.gears.empty()) return plant::Reduce(asked);
  EffectsOptions geared = options;
  geared.rig_name = "geared_rotor_4dof";
  return plant::Reduce(LoadRig(geared).plant);
}

void DrawOne(const effect::Row& row, const EffectsOptions& options, const std::string& path) {
  if (!effect::IsEntry(row)) {
    throw Problem(ExitStatus::kUsage,
                  fmt::format("--picture: {} has none, since it is no entry of a rig file: {}",
                              row.name, effect::InPlaceOfAnEntry(row)));
  }
  const plant::PlantParameters rig = RigFor(row, options);
  svg::Write(path, signature::Picture(rig, plant::ClearOn(rig, row.id)));
}

void Draw(const EffectsOptions& options) {
  if (!options.picture_path.empty()) DrawOne(RowOf(options.id), options, options.picture_path);
  if (options.pictures_folder.empty()) return;
  for (const effect::Row& row : effect::EntryRows()) {
    DrawOne(row, options, fmt::format("{}/{}.svg", options.pictures_folder, row.name));
  }
}

ExitStatus Run(const EffectsOptions& options) {
  if (!options.picture_path.empty() && options.id.empty()) {
    throw Problem(ExitStatus::kUsage,
                  "--picture needs the id of an effect; `amb effects` lists all");
  }
  auto json = nlohmann::ordered_json::array();
  if (options.id.empty()) {
    PrintAll();
    for (const effect::Row& row : effect::Catalogue()) json.push_back(RowJson(row));
  } else {
    PrintOne(RowOf(options.id));
    json.push_back(RowJson(RowOf(options.id)));
  }
  Draw(options);
  WriteDocument(options.document_path);
  WriteJsonFile(options.json_path, nlohmann::ordered_json{{"effects", json}});
  return ExitStatus::kDone;
}

}  // namespace

void AddEffectsCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<EffectsOptions>();
  CLI::App* command = AddStudyCommand(app, "effects");
  command->add_option("id", options->id, "One effect; without it, all are listed");
  AddRigOption(*command, *options);
  command->add_option("--picture", options->picture_path,
                      "Draw the effect at clear size beside the nominal rig (SVG)");
  command->add_option("--pictures", options->pictures_folder, "Draw all into a folder");
  command->add_option("--document", options->document_path, "Write docs/effects.md anew");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
