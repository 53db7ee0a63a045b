// amb dash: the live page of a run that is under way, or of the next one.

#include <fmt/core.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.hpp"
#include "cli/json_file.hpp"
#include "cli/options/network_options.hpp"
#include "cli/run/interrupt.hpp"
#include "dashboard/access.hpp"
#include "dashboard/dashboard.hpp"
#include "rt/say.hpp"

namespace levitas::cli {
namespace {

struct DashOptions {
  std::string port{"lcm"};
  dashboard::WebOptions web;
  bool allow_network{false};
  std::string token_path;
  double answer_within_s{1.5};
  std::string key;  ///< file with the key of those who may speak; empty: none
  std::string json_path;
};

/// The one given, checked; empty when none was.
std::string GivenToken(const DashOptions& options) {
  if (!options.token_path.empty()) return dashboard::ReadToken(options.token_path);
  if (options.web.token.empty()) return {};
  dashboard::CheckToken(options.web.token, "--token");
  rt::Say(
      "warning: every user of this machine can see --token in the list of processes; "
      "--token-file keeps it out of sight\n");
  return options.web.token;
}

/// A token that was in a file stays out of terminals and their logs.
std::string AddressForPeople(const dashboard::Dashboard& page, const DashOptions& options) {
  const std::string url = page.Url();
  return options.token_path.empty() ? url : url.substr(0, url.find('?'));
}

std::string Completion(const DashOptions& options) {
  return options.token_path.empty()
             ? ""
             : fmt::format("behind it goes ?token= and the first line of {}; ",
                           rt::Quoted(options.token_path));
}

ExitStatus Serve(DashOptions options) {
  options.web.token = GivenToken(options);
  if (!dashboard::IsLoopback(options.web.address)) {
    if (!options.allow_network) {
      throw Problem(ExitStatus::kUsage,
                    fmt::format("--listen {}: whoever reaches this address could command the rig; "
                                "say --allow-network if that is meant (a token is then needed, "
                                "and printed)",
                                options.web.address));
    }
    if (options.web.token.empty()) options.web.token = dashboard::NewToken();
  }
  const InterruptGuard interrupts;
  const std::chrono::milliseconds patience(
      static_cast<std::int64_t>(options.answer_within_s * 1e3));
  transport::LcmNetwork network = transport::ParseLcmNetwork(options.port);
  transport::TakeKey(network, options.key, "pretend to be the controller");
  const dashboard::Dashboard page(network, options.web, patience);
  fmt::print(
      "page: {}   ({}Ctrl-C ends)\nThe page stays empty until a controller sends: ./amb run "
      "--no-dash "
      "beside it, or a controller with the same --port\n",
      AddressForPeople(page, options), Completion(options));
  // With a token in it the address is a secret: this user's alone, whatever stood there before.
  if (!options.web.token.empty()) (void)::umask(S_IRWXG | S_IRWXO);
  WriteJsonFile(options.json_path, {{"page", page.Url()}});
  std::fflush(stdout);
  interrupts.Await();
  return ExitStatus::kDone;
}

}  // namespace

void AddDashCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<DashOptions>();
  CLI::App* command = app.add_subcommand(
      "dash", "Live page of a run in the browser: orbits, spectra, currents, timing, commands");
  AddNetworkOptions(*command, options->port, options->key);
  auto* http = command
                   ->add_option("--http-port", options->web.port,
                                "TCP port of the page; default: 8970, or the next free one")
                   ->check(CLI::Range(0, 65535));
  command
      ->add_option("--listen", options->web.address,
                   "Address to serve; others than loopback need --allow-network")
      ->capture_default_str();
  command->add_flag("--allow-network", options->allow_network,
                    "Let other machines in, with a token that is part of the printed address");
  auto* token = command->add_option(
      "--token", options->web.token,
      "Token to ask for, 16 characters or more, which every user of this machine can see; "
      "default: a random one");
  command
      ->add_option("--token-file", options->token_path,
                   "Token to ask for: the first line of a file that only its owner may read")
      ->excludes(token);
  command
      ->add_option("--answer-within", options->answer_within_s,
                   "How long a command waits for the controller's word before it counts as "
                   "unanswered [s]")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  command->add_option("--json", options->json_path,
                      "Write the page's address, with its token, to this file; it is then this "
                      "user's alone");
  command->callback([options, http, &action] {
    options->web.any_port = http->count() == 0;
    action = [options] { return Serve(*options); };
  });
  command->footer(
      "The page talks to whatever controller is on that port; commands are confirmed by it.\n"
      "  amb-controller without --scenario   a run that waits for the page's commands\n"
      "  Esc                                 emergency stop, wherever the cursor is\n"
      "More: docs/dashboard.md");
}

}  // namespace levitas::cli
