#pragma once
// Recorded and other currents side by side, one line per compared cycle:
// time_s, recorded_<channel>_a ..., other_<channel>_a ...
//
// Failure  BadInput when the file cannot be written. Without a path nothing is done. The file
//          appears under its name when Finish is called; what was not finished is removed.

#include <cstdint>
#include <optional>
#include <string>

#include "common/output_file.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/log/session_header.hpp"

namespace levitas::cli {

class WhatIfCsv {
 public:
  WhatIfCsv(const std::string& path, const session::SessionHeader& header);

  void Add(const cycle::CycleRecord& record, const cycle::CycleOutputs& other);
  void Finish();

 private:
  std::string path_;
  std::optional<OutputFile> file_;  ///< none without a path
  std::size_t axes_;
  std::int64_t period_ns_;
};

}  // namespace levitas::cli
