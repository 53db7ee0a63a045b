// Table of the bias saving of a controller file.
#include <fmt/format.h>

#include "configuration/schema/schema.hpp"

namespace levitas::configuration {

using namespace unit;

void Describe(Visitor& v, bias::BiasConfig& bias, const RigNumbers& rig) {
  v.Number({"lowest_current", kAmpere, 0.001, 100, kRequired,
            "the bias falls no further, however little force is asked for"},
           bias.lowest_current_a);
  v.RefuseIf(rig.bias_current_a > 0.0 && bias.lowest_current_a >= rig.bias_current_a,
             "lowest_current_a",
             fmt::format("found {:.6g} A, allowed below the rig's bias current, {:.6g} A",
                         bias.lowest_current_a, rig.bias_current_a));
  v.RefuseIf(!rig.bearings.empty() && rig.magnet_gaps_m.empty(), "lowest_current_a",
             "the rig has a magnet whose force is not that of the gap squared; leave bias_saving "
             "out");
  v.Number({"largest_share", kOne, 0.05, 0.95, 0.5,
            "of the bias that a control current takes; the rest is for a shock"},
           bias.largest_share);
  v.Number({"largest_orbit_fraction", kOne, 0.01, 0.9, 0.2,
            "of the clearance; beyond it the bias is the rig's"},
           bias.largest_orbit_fraction);
  v.Number({"lowering_time", kSecond, 0.05, 600, 2,
            "in which the bias would fall from the rig's to nothing; a peak counts as long"},
           bias.lowering_time_s);
  v.Number({"raising_time", kMillisecond, 0.1, 1000, 5,
            "in which it would rise from nothing to the rig's; not below what the amplifiers need"},
           bias.raising_time_s);
}

}  // namespace levitas::configuration
