#pragma once
// Weights and uncertainty of the signal-based H-infinity problem of a rig.
//
// Problem    w = (disturbance at the control current, sensor noise), z = (control current,
//            position), each divided by what is expected or allowed: all gains below one means all
//            limits kept. The choice of signals and the numbers are those published for the
//            flexible rotor by A. Sahinkaya & J. T. Sawicki, unless said otherwise.
// Wd         disturbance_a up to disturbance_hz, then falling in first order to floor_a. The source
//            stops at the top speed (100 Hz). A controller made for that cancels the flexible modes
//            above it instead of damping them, and loses them when they move by a hertz: the
//            default holds the level to 1000 Hz, beyond the fourth mode, and never falls.
// Wn         noise_m, constant.
// Wu         1/control_a up to control_hz (the amplifier's reach), rising above in first order to
//            ten times that.
// Wp         1/position_rest_m at rest, 1/position_m above: first order, corner position_rest_hz.
// Modes      each flexible mode of each plane may move by mode_hz, as a complex perturbation of
//            norm one: it stands for frequency (measured to +-2 Hz), damping, and for the
//            gyroscopic splitting over the speed range about the design speed.
// Units      SI, in the names. Thread: plain data.

namespace levitas::hinf {

struct HinfWeights {
  double disturbance_a{
      0.3};  ///< 1.05 x the largest control current of the published runs, 0.2786 A
  double disturbance_floor_a{0.3};
  double disturbance_hz{1000.0};
  double noise_m{1e-6};  ///< published sensor noise
  double control_a{1.0};
  double control_hz{720.0};  ///< published bandwidth of the actuators
  double position_rest_m{0.7e-6};
  double position_rest_hz{0.1};
  double position_m{36e-6};  ///< published limit of the orbit
  double mode_hz{4.0};
};

}  // namespace levitas::hinf
