#pragma once
// What the table of signatures asks of the plant: one quantity each, with one entry or without
// (an entry of no size: {}).

#include <complex>

#include "common/two_pi.hpp"
#include "tests/loop/effects/effect_rig.hpp"

namespace levitas::plant::test {

inline constexpr double kPeriod_s = 1e-4;
inline constexpr double kTone_hz = 100.0;  ///< a hundred samples
inline constexpr double kKi_n_per_a = 40.0;
inline constexpr double kKs_n_per_m = 40.0 / 0.381e-3;
inline constexpr double kSpeed = 180.0;  ///< [rad/s]
inline constexpr double kBent = 1e-5;    ///< coordinate of the first bending mode, the others zero

[[nodiscard]] inline int Sign(double value) { return value > 0.0 ? 1 : value < 0.0 ? -1 : 0; }

/// Deflection of the first bending mode at a plane.
[[nodiscard]] double ShapeOf(double z_m);

// Commands and coils of de_x, the rotor held in the centre.
/// Line of the coil current under a tone of 0.1 A, over the same without the entry.
[[nodiscard]] std::complex<double> ToneRatio(const effect::EffectConfig& entry);
/// The same of the magnet's force.
[[nodiscard]] std::complex<double> ForceToneRatio(const effect::EffectConfig& entry);
/// Third harmonic of the coil current over its first, in the first's phase.
[[nodiscard]] double ThirdHarmonic(const effect::EffectConfig& entry, double amplitude_a);
/// Share of periods in which a new command did not come.
[[nodiscard]] double HeldShare(const effect::EffectConfig& entry);
/// Force of de_x some time after the current went to 0.5 A and back.
[[nodiscard]] double ForceLeft(const effect::EffectConfig& entry);

// At rest: forces and readings of one instant.
[[nodiscard]] AxisArray ForceOf(const effect::EffectConfig& entry, double de_x_a, double de_x_m);
/// The rotor moved in x by `parallel_m`, and by `tilt_m` more at the nde magnet.
[[nodiscard]] AxisArray ReadingOf(const effect::EffectConfig& entry, double parallel_m,
                                  double tilt_m);

// Readings in time, the rotor floating without forces.
[[nodiscard]] double MovingReadingRms(const effect::EffectConfig& entry, double rate_m_per_s);
[[nodiscard]] double StandingReadingRms(const effect::EffectConfig& entry);
/// One period after a sudden shift, as a share of it.
[[nodiscard]] double StepReading(const effect::EffectConfig& entry);
/// Line of the de orbit x + jy at `order` x 100 Hz of rotation.
[[nodiscard]] std::complex<double> OrbitLine(const effect::EffectConfig& entry, int order);
/// Amplitude of cos(2 pi f t + phase) in what de_x reads.
[[nodiscard]] double ToneOfReading(const effect::EffectConfig& entry, double frequency_hz,
                                   double phase_rad);
/// 0 when motion and currents are bit for bit those without the entry, 1 otherwise.
[[nodiscard]] double RotorFeels(const effect::EffectConfig& entry);

// Forces on the first bending mode, the shaft bent towards `direction_rad` and at rest.
/// Their line at `order` x rotation, less that without the entry.
[[nodiscard]] std::complex<double> ForceLine(const effect::EffectConfig& entry, int order,
                                             double direction_rad = 0.0);
/// What half as much polar inertia again adds across the velocity of the tilting rotor.
[[nodiscard]] double GyroscopicForce(double speed_rad_per_s);
/// Radial force of a rub (clearance 20 um, 2e5 N/m, friction 0.1) on the rotor moved in x.
[[nodiscard]] double RubForce(double x_m);

// Models.
/// The pole of the free rotor at rest nearest to j w.
[[nodiscard]] std::complex<double> FreePole(const effect::EffectConfig& entry, double w);
/// Acceleration of a rigid rotor per newton at the de magnet.
[[nodiscard]] double RigidLine(const effect::EffectConfig& entry);

}  // namespace levitas::plant::test
