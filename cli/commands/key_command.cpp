// amb key: makes the key of those who may speak on a network that other machines reach.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "cli/commands/command.hpp"
#include "transport/network_key.hpp"

namespace levitas::cli {

void AddKeyCommand(CLI::App& app, Action& action) {
  auto path = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "key", "Make the key of those who may speak on a network that other machines reach");
  command->add_option("FILE", *path, "File to write; it must not exist yet")->required();
  command->callback([path, &action] {
    action = [path] {
      transport::NetworkKey::Make(*path);
      fmt::print(
          "{}: a new key, readable by this user only. Give the same file to each program with "
          "--key, on other machines a copy of it (scp -p).\n",
          *path);
      return ExitStatus::kDone;
    };
  });
  command->footer("What a key protects, and what not: docs/dashboard.md");
}

}  // namespace levitas::cli
