#pragma once
// A PID of each channel in coordinates that are not the axes: translation and tilt of a rotor.
//
// Equation   e' = M e, u' = C(z) e' channel by channel, u = R u': the law between the axes is
//            R diag(C) M. For a rotor in two bearings, a and b the distances of the drive end's and
//            the other plane from its centre of mass,
//              translation t = (b x_de + a x_nde)/(a + b)        [m], of the centre of mass
//              tilt        p = (x_nde - x_de)/2                  [m] at the sensors
//            of the sensor planes, and currents of the actuator planes that make a force through
//            the centre of mass without a moment, and a moment without a force, whatever the ki.
//            Each may so have its own stiffness and damping (Schweitzer & Maslen, Magnetic
//            Bearings, 2009, chapter 8: decoupled control of the rigid body).
// Channels   translation x, translation y, tilt x, tilt y, where bearings' axes stand else.
// Empty      no matrices: axis by axis.
// Failure    Problem for a rig that does not have one rotor in two bearings of two axes each, or
//            whose centre of mass does not lie between them.
// Thread     any; pure.

#include <Eigen/Core>

#include "configuration/rig_file.hpp"
#include "controller/law/law_config.hpp"

namespace levitas::design {

struct Coordinates {
  Eigen::MatrixXd measure;  ///< M, channels x sensors
  Eigen::MatrixXd drive;    ///< R, coils x channels
  [[nodiscard]] bool empty() const noexcept { return measure.size() == 0; }
};

[[nodiscard]] Coordinates TranslationAndTilt(const configuration::RigFile& rig);

/// The same law between the axes, in blocks of poles in z: what the loop runs and a file holds.
/// Throws std::invalid_argument where poles of one channel repeat and cannot be told apart.
[[nodiscard]] law::LawConfig BetweenAxes(const law::LawConfig& channels,
                                         const Coordinates& coordinates);

}  // namespace levitas::design
