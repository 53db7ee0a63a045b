#pragma once
// A measured point of a probe's static characteristic. Units m. Thread: any; plain data.

namespace levitas::sensor {

/// `reading_m` stands where the rotor is at `displacement_m`, along the axis before its polarity.
struct ProbePoint {
  double displacement_m{};
  double reading_m{};
};

}  // namespace levitas::sensor
