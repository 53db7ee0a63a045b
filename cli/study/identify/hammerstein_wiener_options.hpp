#pragma once
// Options of a Hammerstein-Wiener model that its commands share: --order, --noise-order, --degree,
// --bandwidth-hz, --products.

#include <CLI/App.hpp>

#include "identification/nonlinear/hammerstein_wiener.hpp"

namespace levitas::cli {

void AddMemoryOptions(CLI::App& command, identification::HammersteinWienerOptions& model);

}  // namespace levitas::cli
