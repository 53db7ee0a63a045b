#pragma once
// Experiments that a person could do next, as scenarios for `amb run`, to see which of them would
// split a tie.
//
// List     at rest with a test signal on every axis in turn; the same with three times the signal;
//          led slowly about the centre; the test signal at a twelfth, a half and nearly all of the
//          top speed; a run-up without signal. A rig that does not turn has the first three.
// Signal   0.1 A (a tenth of the current limit where that is less), maximum length sequence of
//          order 11, cut back where an orbit passes half the touchdown clearance.
// Not in it  another bias current, a weight hung on the shaft: no scenario can do that.
// Thread   any; pure.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"

namespace levitas::diagnosis {

struct Experiment {
  std::string what;      ///< "run-up from 480 to 5700 rpm"
  std::string scenario;  ///< text of a scenario file
};

[[nodiscard]] std::vector<Experiment> Experiments(const configuration::RigFile& rig,
                                                  double current_limit_a);

}  // namespace levitas::diagnosis
