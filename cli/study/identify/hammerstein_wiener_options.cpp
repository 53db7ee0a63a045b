#include "cli/study/identify/hammerstein_wiener_options.hpp"

#include <CLI/CLI.hpp>

namespace levitas::cli {

void AddMemoryOptions(CLI::App& command, identification::HammersteinWienerOptions& model) {
  command.add_option("--order", model.order, "Of every signal's memory")
      ->check(CLI::Range(1, 60))
      ->capture_default_str();
  command.add_option("--noise-order", model.noise_order, "Of the coloured noise; 0 = white")
      ->check(CLI::Range(0, 20))
      ->capture_default_str();
  command.add_option("--degree", model.degree, "Of the input curves; 1 = linear")
      ->check(CLI::Range(1, 7))
      ->capture_default_str();
  command.add_option("--bandwidth-hz", model.bandwidth_hz, "Of the memory; 0 = plain lags")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_flag("--products", model.products,
                   "Terms of current and position together; inputs and outputs of the same axes");
}

}  // namespace levitas::cli
