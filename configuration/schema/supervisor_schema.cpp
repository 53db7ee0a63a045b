// Table of the sequence and the protections of a controller file.
#include <fmt/format.h>

#include "configuration/schema/schema.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

void Describe(Visitor& v, supervisor::SequenceConfig& sequence) {
  v.Number(
      {"self_test", kSecond, 0.001, 60, 0.2, "sensors must be plausible this long before lift"},
      sequence.self_test_s);
  v.Number({"lift_ramp", kSecond, 0.001, 60, 0.5, "from the resting place to the centre"},
           sequence.lift_ramp_s);
  v.Number(
      {"lift_settle", kSecond, 0.001, 60, 0.2, "the rotor must stay near the centre this long"},
      sequence.lift_settle_s);
  v.Number({"lift_timeout", kSecond, 0.01, 600, 3, "lift fails after this"},
           sequence.lift_timeout_s);
  v.RefuseIf(sequence.lift_timeout_s <= sequence.lift_ramp_s + sequence.lift_settle_s,
             "lift_timeout_s",
             fmt::format("found {:.6g} s, but ramp and settling alone take {:.6g} s",
                         sequence.lift_timeout_s, sequence.lift_ramp_s + sequence.lift_settle_s));
  v.Number({"settle_radius", kMicrometre, 0.1, 5000, 30, "what near the centre means, per bearing"},
           sequence.settle_radius_m);
  v.Number({"landing_ramp", kSecond, 0.001, 60, 0.5, "from the centre to the resting place"},
           sequence.landing_ramp_s);
  v.Number({"standstill", kRpm, 0.01, 1000, 5, "below this speed the rotor counts as standing"},
           sequence.standstill_rad_per_s);
  v.Number({"standstill", kSecond, 0.001, 60, 0.2,
            "for so long below it without interruption, and reachable by what the drive can do"},
           sequence.standstill_s);
  v.Number({"trip_deceleration", kRpmPerSecond, 1, 1e6, 1000,
            "the drive brakes at this rate after a trip that leaves the rotor levitated"},
           sequence.trip_acceleration_rad_per_s2);
}

void Describe(Visitor& v, supervisor::ProtectionConfig& protection) {
  v.Number({"orbit_fraction", kOne, 0.05, 0.99, 0.5, "of the clearance; trips beyond it"},
           protection.orbit_fraction);
  v.Integer({"orbit_cycles", 1, 100000, 10, "cycles beyond it, those inside counted back"},
            protection.orbit_cycles);
  v.Number({"sensor_range_fraction", kOne, 0.1, 1, 0.95, "of the converter's range; trips beyond"},
           protection.sensor_range_fraction);
  v.Integer({"sensor_range_cycles", 1, 100000, 3, "consecutive cycles beyond it"},
            protection.sensor_range_cycles);
  v.Integer({"sensor_frozen_cycles", 2, 1000000, 50,
             "identical readings of one axis in a row while levitated"},
            protection.sensor_frozen_cycles);
  v.Integer({"frame_missing_cycles", 1, 100000, 5, "consecutive cycles without a sensor frame"},
            protection.frame_missing_cycles);
  v.Integer({"frames_lost_cycles", 1, 100000, 30, "cycles without a sensor frame in the window"},
            protection.frames_lost_cycles);
  v.Integer({"frames_lost_window_cycles", 1, 10000000, 100, "length of that window"},
            protection.frames_lost_window_cycles);
  v.RefuseIf(protection.frames_lost_cycles > protection.frames_lost_window_cycles,
             "frames_lost_cycles", "more than the window holds: it could never trip");
  v.Integer({"currents_late_cycles", 1, 100000, 18,
             "periods in the window in which the rig held an old current"},
            protection.currents_late_cycles);
  v.Integer({"currents_late_window_cycles", 1, 10000000, 100, "length of that window"},
            protection.currents_late_window_cycles);
  v.RefuseIf(protection.currents_late_cycles > protection.currents_late_window_cycles,
             "currents_late_cycles", "more than the window holds: it could never trip");
  v.Integer({"deadline_missed_cycles", 1, 100000, 20, "missed periods within the window"},
            protection.deadline_missed_cycles);
  v.Integer({"deadline_window_cycles", 1, 10000000, 1000, "length of that window"},
            protection.deadline_window_cycles);
  v.RefuseIf(protection.deadline_missed_cycles > protection.deadline_window_cycles,
             "deadline_missed_cycles", "more than the window holds: it could never trip");
  v.Number({"coil_saturated", kMillisecond, 0.1, 60000, 50,
            "an axis at its current limit without interruption"},
           protection.coil_saturated_s);
  v.Number({"over_speed_fraction", kOne, 1, 2, 1.1, "of the rated speed; trips beyond it"},
           protection.over_speed_fraction);
}

}  // namespace

void Describe(Visitor& v, supervisor::SupervisorConfig& supervisor) {
  v.Group("sequence", "lifting, landing and braking", [&] { Describe(v, supervisor.sequence); });
  v.Group("protection", "what trips the rig, and when",
          [&] { Describe(v, supervisor.protection); });
}

}  // namespace levitas::configuration
