#pragma once
// The whole modal identification: proposes modes, fits, assesses, validates.
//
// Speeds    the slowest response must be at standstill (BadInput else); with it the fastest is
//           fitted, all others only judge.
// Modes     those bending modes of the rig file that lie in the band; which of them the data show,
//           and which modes of the data no one claims: mode_support.hpp.
// Thread    any.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "identification/modal/modal_fit.hpp"
#include "identification/modal/modal_quality.hpp"
#include "identification/modal/uncertainty.hpp"

namespace levitas::identification {

struct SpeedQuality {
  double speed_rad_per_s{};
  double misfit{};  ///< modal_quality.hpp
  bool fitted{};
  FitShare percent;
  Eigen::VectorXd before, after;  ///< misfit per channel: of the rig file, of what was identified
};

struct ModalResult {
  std::vector<std::string> channels;
  ModalFitOptions options;  ///< with the band that was used
  ModalStart start;
  Stabilisation stabilisation;
  std::vector<ProposedMode> unmatched;  ///< of the data, without one of the rig's
  ModalFit fit;
  std::vector<ModeSupport> support;  ///< per bending mode
  Physical rig;
  Uncertainty uncertainty;
  std::vector<SpeedQuality> quality;  ///< in the order of the responses
  double time_s{};
};

/// What EstimateResponses has to know of the rig for a modal fit.
[[nodiscard]] ResponseOptions ModalResponseOptions(const configuration::RigFile& rig);

[[nodiscard]] ModalResult IdentifyModal(const configuration::RigFile& rig,
                                        const std::vector<FrequencyResponse>& responses,
                                        const ModalFitOptions& options);
/// The same with the search beginning elsewhere: see modal_starts.hpp.
[[nodiscard]] ModalResult IdentifyModal(const ModalStart& start, const Eigen::VectorXd& begin,
                                        const Stabilisation& stabilisation,
                                        const std::vector<FrequencyResponse>& responses,
                                        const ModalFitOptions& options);

}  // namespace levitas::identification
