#include "cli/study/identify/start_options.hpp"

#include <CLI/CLI.hpp>

namespace levitas::cli {

void AddSpreadOptions(CLI::App& command, identification::StartSpread& spread) {
  command.add_option("--spread", spread.everything, "Of the starts, on everything")
      ->check(CLI::Range(0.0, 0.9))
      ->capture_default_str();
  command.add_option("--spread-gains", spread.gains, "On ki, ks and sensor gains")
      ->check(CLI::Range(0.0, 0.9))
      ->capture_default_str();
}

}  // namespace levitas::cli
