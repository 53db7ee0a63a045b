#pragma once
// A rig of unknown numbers for the modal identification: its campaign, and the truth apart from it.
//
// Rig       flexible_rotor with every number off (perturbed_rig.hpp): ki, ks 8 % per axis, sensor
//           gain 3 %, modal frequencies 3 %, dampings by e^+-0.4, deflections 4 %, delay, loads,
//           unbalance, and the rigid body's mass and inertia (RigidBodyOff); what the method takes
//           as known (amplifier, sensor bandwidth and place, centre of mass) is as in the file.
//           Noise, converters, nonlinear magnets and gravity are on.
// Truth     ki and ks of a small signal about the static working point: the magnet's slopes where
//           load and a probe's offset put the rotor; at the magnets, between which and the probes
//           the rotor sags.
// Products  identifiable from a response from current to reading: ki g/m and ks/m.
// Units     SI. Thread any.

#include "benchmark/accuracy/identification/simulated_campaign.hpp"
#include "identification/modal/identify_modal.hpp"

namespace levitas::accuracy {

struct ModalTruth {
  Eigen::VectorXd frequency_hz, damping_ratio;  ///< bending modes of the free rotor
  Eigen::VectorXd ki_product;                   ///< per axis: ki g/m [N/(A kg)]
  Eigen::VectorXd ks_product;                   ///< per axis: ks/m [N/(m kg)]
};

struct ModalTrial {
  session::Recording record;
  ModalTruth truth;  ///< never handed to the fit
};

/// Standard deviations of what a rig file is off by. A rotor that was weighed and drawn: 0.
struct RigidBodyOff {
  double mass{0.03};
  double inertia{0.03};  ///< beside what the mass takes along
};

[[nodiscard]] ModalTrial MakeModalTrial(const configuration::RigFile& nominal,
                                        const ExcitationPlan& plan, const RigidBodyOff& rigid = {});

/// Relative errors, entry by entry; only the modes that the fit has.
struct ModalErrors {
  Eigen::VectorXd frequency, damping, ki_product, ks_product;
  Eigen::VectorXd deflection_per_ampere;  ///< of ki g/ks, what a slow current moves a reading by
};

[[nodiscard]] ModalErrors Compare(const ModalTruth& truth, const identification::Physical& found);

/// ln(found/true) in stated standard deviations, entry by entry: within +-2 in 95 of 100 cases when
/// the intervals are right.
struct ModalScores {
  Eigen::VectorXd frequency, damping, ki_product, ks_product;
};

[[nodiscard]] ModalScores Score(const ModalTruth& truth, const identification::ModalResult& found);

}  // namespace levitas::accuracy
