#pragma once
// The rig that fuzzed measurements are imported for, and where their sessions go.

#include "session/exchange/csv_import.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace levitas::fuzz {

inline session::ImportOptions ImportInto(const std::string& data_path) {
  session::ImportOptions options;
  options.data_path = data_path;
  options.out_path = ScratchFolder() + "/out.lcm";
  options.rig.name = "bench";
  options.rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  options.rig.bearings = {"de", "nde"};
  options.rig.bias_current_a = 1.0;
  options.rig.max_coil_current_a = 2.0;
  options.rig.sensor_range_m = 400e-6;
  options.rig.max_speed_rad_per_s = 600.0;
  options.rig_yaml = "name: bench\n";
  options.program_version = "1";
  options.start_utc_ns = 5;
  return options;
}

}  // namespace levitas::fuzz
