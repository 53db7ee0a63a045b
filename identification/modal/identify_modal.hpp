#pragma once
// The whole modal identification: proposes modes, fits, assesses, validates.
//
// Speeds    the slowest response must be at standstill (BadInput else); with it the fastest is
//           fitted, all others only judge.
// Modes     those bending modes of the rig file that lie in the band; modes of the data without
//           one within 25 % are listed as unmatched.
// Thread    any.

#include <string>
#include <vector>

#include "config/rig_file.hpp"
#include "identification/modal/modal_fit.hpp"
#include "identification/modal/uncertainty.hpp"

namespace levitas::identification {

struct SpeedQuality {
  double speed_rad_per_s{};
  double misfit{};  ///< modal_quality.hpp
  bool fitted{};
};

struct ModalResult {
  std::vector<std::string> channels;
  ModalFitOptions options;  ///< with the band that was used
  ModalStart start;
  Stabilisation stabilisation;
  std::vector<ProposedMode> unmatched;
  ModalFit fit;
  Physical rig;
  Uncertainty uncertainty;
  std::vector<SpeedQuality> quality;  ///< in the order of the responses
  double time_s{};
};

[[nodiscard]] ModalResult IdentifyModal(const config::RigFile& rig,
                                        const std::vector<FrequencyResponse>& responses,
                                        const ModalFitOptions& options);

}  // namespace levitas::identification
