#pragma once
// Options of the commands that repeat a modal fit from random starts.

#include <CLI/App.hpp>

#include "identification/modal/modal_starts.hpp"

namespace levitas::cli {

/// --spread and --spread-gains; `spread` holds the defaults and must outlive the parsing.
void AddSpreadOptions(CLI::App& command, identification::StartSpread& spread);

}  // namespace levitas::cli
