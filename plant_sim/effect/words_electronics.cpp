// Words of the workshop: timing, amplifiers, magnets, sensors.
#include <array>

#include "plant_sim/effect/workshop.hpp"

namespace levitas::effect {
namespace {

using enum SizeForm;
using enum Yardstick;
using enum Stop;

constexpr std::array kElectronics{
    Words{"extra_delay", "Currents act too late", "Currents act earlier than the rig file says",
          "delay", kPlain, "", kNone, kRunOn,
          "Delay costs phase: high modes lose damping, and the design is for another delay.",
          "Measure the time from sample to current (filters of the amplifier, bus cycle, load of "
          "the controller), enter it as delay_samples, and check the law with amb margins."},
    Words{"dropped_samples", "Frames of readings are lost", "", "probability", kPercent,
          "of all frames", kNone, kIfSevere,
          "The last current is held meanwhile, which shakes the rotor; long bursts trip.",
          "Check cable, plugs and load of the bus, and the controller's priority (amb doctor)."},
    Words{"sample_jitter", "Readings are taken at uneven instants", "", "deviation", kPlain, "rms",
          kNone, kRunOn, "Fast motion is read with noise that grows with its speed.",
          "Check clock and trigger of the converters, and what else runs on that machine."},
    Words{"amplifier_bandwidth", "Amplifier is not as fast as the rig file says", "", "bandwidth",
          kPlain, "of bandwidth", kNone, kRunOn,
          "A slower loop costs phase: bending modes lose damping, and may go unstable.",
          "Measure the step of the current; check gains of the amplifier's current loop, its "
          "supply, and the inductance of the coils."},
    Words{
        "amplifier_slew", "Amplifier runs out of supply voltage", "", "slew", kPlain, "", kNone,
        kIfSevere, "Large fast motion is damped less than small motion: a shock may not be held.",
        "Check the supply under load (fuse, cable, one phase missing) and the coils' inductance."},
    Words{"current_gain", "Bearing pulls too strongly for its current",
          "Bearing pulls too weakly for its current", "ratio", kOff, "", kLoopGain, kIfSevere,
          "The loop has another gain and stiffness than it was designed with.",
          "Compare commanded and measured current of both coils (current probe, amplifier scale, "
          "shorted turns, a coil open); then the air gap."},
    Words{"command_offset", "Amplifier's zero is off", "", "offset", kPlain, "of current", kNone,
          kRunOn, "A constant force stands in the bearing; it uses up force and heats a coil.",
          "Measure the current at a command of zero and trim the amplifier's zero."},
    Words{"displacement_stiffness", "Magnet's negative stiffness is too large",
          "Magnet's negative stiffness is too small", "ratio", kOff, "", kNone, kRunOn,
          "The rotor is held more softly, or more stiffly, than designed, most at low frequency.",
          "Measure the air gap and the bias current of both coils; compare with the rig file."},
    Words{"coil_asymmetry", "Two opposed coils pull unequally", "", "ratio", kOff, "", kNone,
          kRunOn, "The rotor is drawn to one side, and force is no longer straight over current.",
          "Measure resistance and inductance of both coils (shorted turns) and both air gaps."},
    Words{"magnetic_saturation", "Magnet's iron saturates", "", "knee", kPlain, "of coil current",
          kNone, kIfSevere,
          "Force falls short at large current: a shock may throw the rotor into the touchdown "
          "bearings.",
          "Lower the static load or the bias current; check the yoke for a wrong sheet or a gap."},
    Words{"hysteresis", "Magnet's force lags behind its current", "", "width", kPlain,
          "half width of the loop", kNone, kRunOn,
          "Small motion is damped less, and the resting position depends on what was before.",
          "Check the iron (solid where sheets belong, heat treatment); demagnetise the yoke."},
    Words{"eddy_current", "Eddy currents slow the magnet's force", "", "tau", kPlain,
          "of diffusion time", kNone, kRunOn,
          "Force is smaller and later at high frequency: bending modes lose damping.",
          "Check that yoke and sleeve are laminated and their sheets not bridged by burrs; else "
          "design the law with it in the rig file."},
    Words{"axis_rotation", "Axes of magnets or sensors are turned", "", "angle", kPlain, "", kNone,
          kIfSevere, "x pushes y: one whirl is damped, the other driven.",
          "Check how the housing and the probes are turned against the drawing, and the wiring of "
          "the coils."},
    Words{"force_constant", "Magnet pulls too strongly", "Magnet is weak", "ratio", kOff, "",
          kLoopGain, kIfSevere,
          "The loop has another gain and stiffness than it was designed with.",
          "Measure the air gap and each coil's resistance (shorted turns); check that the yoke "
          "is closed."},
    Words{"magnetic_coupling", "Current of one axis pulls in the other", "", "ratio", kPercent,
          "of the force across", kNone, kRunOn,
          "x and y disturb each other: damping is spread unevenly.",
          "Check the order of the poles (N S S N) and the wiring of the coils at this bearing."},
    Words{"sensor_gain", "Sensor reads too much", "Sensor reads too little", "ratio", kOff, "",
          kLoopGain, kIfSevere,
          "The loop has another gain, and the true orbit is not the one that is shown.",
          "Calibrate this probe (feeler gauge, clearance of the touchdown bearing); check target "
          "material, supply and scale of its channel."},
    Words{"sensor_offset", "Sensor's zero is not the magnetic centre", "", "offset", kPlain, "",
          kClearance, kIfSevere,
          "The rotor floats off the centre: less clearance, more current on one side.",
          "Centre the probe by the two ends of the clearance, or enter the offset."},
    Words{"sensor_nonlinearity", "Sensor's characteristic is bent", "", "a3", kPlain, "", kNone,
          kRunOn, "Large orbits are read wrongly, with harmonics that are not there.",
          "Calibrate this probe over its whole range; check its distance and the target."},
    Words{
        "sensor_bandwidth", "Sensor is not as fast as the file says", "", "bandwidth", kPlain,
        "of bandwidth", kNone, kRunOn, "A slower sensor costs phase: high modes lose damping.",
        "Check the filter of this channel and its settings, length and capacitance of the cable."},
    Words{
        "sensor_position", "Sensor plane is not where the drawing says", "", "shift", kPlain, "",
        kNone, kIfSevere,
        "Bending modes are read otherwise than designed, a node between probe and magnet included.",
        "Measure where the probes stand along the shaft and correct the rig file."},
    Words{"sensor_runout", "Probe's track is out of round", "", "amplitude", kPlain, "", kNone,
          kRunOn,
          "The controller follows motion that is not there: current and heat at every turn.",
          "Clean and polish the track, demagnetise it, check its fit; or compensate the run-out."},
    Words{"mains_pickup", "Mains hum in the sensor", "", "amplitude", kPlain, "", kNone, kRunOn,
          "The controller answers hum with current: heat, noise, a shaken rotor.",
          "Check shield and earth of the probe's cable (one end, no loop), its distance from power "
          "cables, and the supply of the channel."},
    Words{"sensor_noise", "Sensor's noise is not as the file says", "", "rms", kPlain, "rms", kNone,
          kRunOn, "More noise is more current noise, heat and sound; less is no fault.",
          "Check plug, cable, supply and distance of the probe; else enter the level in the file."},
};

}  // namespace

std::span<const Words> WordsOfElectronics() { return kElectronics; }

}  // namespace levitas::effect
