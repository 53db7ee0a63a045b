#pragma once
// T of a block from what the bearings are alone: law, amplifier, sensor, delay. No rotor in it.
//
// Equation  h = amplifier, sensor, delay and hold of an axis, C the law, at z = e^{j n w T_s}:
//             kCurrent    T = -j W C e^{j arg h}      [1],   W = 1/|row of C|
//             kVibration  T =  j e^{-j arg h} |row of C|      [A/m]
//           (docs/derivations.md eq. (N6)-(N8)). Sizes of ki, h and ks are no part of it.
// Holds     every amplitude decays for a slow block, on any rotor that is passive (masses, springs,
//           gyroscopes, dampers to ground, negative springs; any number of modes) and whose sensors
//           are where the magnets are, at any speed at which the law damps: -j C h + its conjugate
//           transpose positive definite. How fast they decay is the rotor's and the law's business.
// Not so    sensors beside the magnets, internal damping above a critical speed, cross-coupled
//           springs: then it is a choice like another, and JudgeNotch judges it.
// Frame     bearing frame; units SI. Thread any; pure.
// Failure   BadInput for coils on a voltage: their current answers to the rotor's motion; for a law
//           that gives an axis nothing at this frequency: it has no phase to follow.

#include <Eigen/Core>
#include <complex>

#include "analysis/sampled_loop.hpp"
#include "controller/synchronous/synchronous_config.hpp"

namespace levitas::design {

/// C(z) of the law of `loop`, coupled or axis by axis.
[[nodiscard]] Eigen::MatrixXcd LawAt(const analysis::SampledLoop& loop, std::complex<double> z);

/// `loop`: of this rig at this speed; only its law is read.
[[nodiscard]] Eigen::MatrixXcd PhaseAlignedT(const plant::PlantConfig& rig,
                                             const analysis::SampledLoop& loop,
                                             const synchronous::BlockConfig& block,
                                             double speed_rad_per_s);

}  // namespace levitas::design
