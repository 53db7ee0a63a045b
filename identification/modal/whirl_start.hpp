#pragma once
// The gyroscopic matrix begins where the whirl frequencies of the data are: a resonance that starts
// beside its peak does not find it.
//
// Equation  det(l^2 + l W J + K) = 0 with J = [0 G; -G 0] and K of the rotor in its magnets; a
//           bending mode splits into backward and forward whirl by about W G_ii. The diagonal of G
//           moves until the splits are those of the data, or one of the two frequencies where the
//           data show only that one. The rest of G stays: it acts to the second order only.
// Pairing   in ascending order, as standing modes are (mode_support.hpp).
// Units     rad/s in and out of the vector. Thread any. Nothing is thrown.

#include <vector>

#include "identification/modal/mode_support.hpp"

namespace levitas::identification {

/// Backward and forward whirl of each bending mode in the magnets [Hz]; 0 where they are not told
/// apart from other modes.
struct Whirl {
  double backward_hz{}, forward_hz{};
};
[[nodiscard]] std::vector<Whirl> WhirlsInMagnets(const Physical& rig, double speed_rad_per_s);

/// Moves the diagonal of the gyroscopic matrix in `vector`; `shown` at that speed, ascending.
void MeetWhirls(const ModalFrame& frame, double speed_rad_per_s,
                const std::vector<ProposedMode>& shown, Eigen::VectorXd& vector);

}  // namespace levitas::identification
