#pragma once
// Recorded and other currents side by side, one line per compared cycle:
// time_s, recorded_<channel>_a ..., other_<channel>_a ...
//
// Failure  BadInput when the file cannot be written. Without a path nothing is done.

#include <cstdint>
#include <fstream>
#include <string>

#include "controller/cycle/cycle_io.hpp"
#include "session/session_header.hpp"

namespace levitas::cli {

class WhatIfCsv {
 public:
  WhatIfCsv(const std::string& path, const session::SessionHeader& header);
  void Add(const cycle::CycleRecord& record, const cycle::CycleOutputs& other);
  void Finish();

 private:
  std::string path_;
  std::ofstream file_;
  std::size_t axes_;
  std::int64_t period_ns_;
};

}  // namespace levitas::cli
