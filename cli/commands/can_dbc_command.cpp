// amb can-dbc: the messages on a rig's CAN buses, for other CAN tools or for people.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.hpp"
#include "cli/json_file.hpp"
#include "common/output_file.hpp"
#include "configuration/rig_file.hpp"
#include "hil/can/dbc.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

struct DbcOptions {
  std::string rig;
  std::string out_path;
  std::string json_path;
  bool table{};
};

nlohmann::ordered_json Json(const DbcOptions& options, const can::Layout& layout) {
  auto messages = nlohmann::ordered_json::array();
  for (const can::Message& message : layout.messages) {
    auto signals = nlohmann::ordered_json::array();
    for (const can::Signal& signal : message.signals) signals.push_back(signal.name);
    messages.push_back({{"name", message.name},
                        {"id", message.id},
                        {"size_byte", message.bytes},
                        {"every_periods", message.every},
                        {"signals", signals}});
  }
  return {{"rig", options.rig},
          {"out", options.out_path},
          {"period_s", 1e-9 * static_cast<double>(layout.period_ns)},
          {"messages", messages}};
}

ExitStatus Write(const DbcOptions& options) {
  const std::string path = configuration::FindConfig(options.rig, "rigs");
  const configuration::RigFile rig = configuration::LoadRig(path);
  if (rig.buses.empty())
    throw BadInput(path + ": names no CAN buses (section buses, docs/real_rig.md)");
  const can::Layout layout = can::MakeLayout(rig.numbers, can::FormatOf(rig.buses));
  session::CheckOutputPath(options.json_path, path);
  const std::string text = options.table ? can::LayoutMarkdown(layout) : can::DbcText(layout);
  if (options.out_path.empty()) {
    fmt::print("{}", text);
    WriteJsonFile(options.json_path, Json(options, layout));
    return ExitStatus::kDone;
  }
  session::CheckOutputPath(options.out_path, path);
  WriteWholeFile(options.out_path, text);
  WriteJsonFile(options.json_path, Json(options, layout));
  return ExitStatus::kDone;
}

}  // namespace

void AddCanDbcCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<DbcOptions>();
  CLI::App* command = app.add_subcommand(
      "can-dbc",
      "The messages on a rig's CAN buses as a DBC file, for cantools, SavvyCAN and others");
  command->add_option("--rig", options->rig, "Rig file, or name of a shipped one")->required();
  command->add_option("--out", options->out_path, "File to write; default: standard output");
  command->add_flag("--table", options->table, "A Markdown table for people instead");
  command->add_option("--json", options->json_path, "Write the messages' names and sizes as JSON");
  command->callback([options, &action] { action = [options] { return Write(*options); }; });
}

}  // namespace levitas::cli
