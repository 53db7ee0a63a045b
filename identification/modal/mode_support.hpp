#pragma once
// Which bending modes of a model the data show, and which they do not: a mode without a stable pole
// in the stabilisation diagram is the rig file's, whatever a fit makes of it.
//
// Before    PairModes pairs the model's modes with those of the diagram in ascending order: every
//           way that leaves out only what has no counterpart by number, nearest first by the sum of
//           |ln(f_model/f_data)|, and the one that leaves out pairs too far apart (0.25 for each
//           side). Which is right is for the fit to say.
// After     SupportOf compares the poles of the fitted plant (magnets' negative stiffness included,
//           as in the diagram) with the diagram: a mode is shown when one lies within 1 %.
// Thread    any.

#include <optional>
#include <vector>

#include "identification/modal/modal_parameters.hpp"
#include "identification/modal/stabilisation.hpp"

namespace levitas::identification {

/// Per model mode, the mode of the diagram that it is; none where the data show none.
using Assigned = std::vector<std::optional<ProposedMode>>;

/// The nearest pairing, which leaves out what is too far apart.
[[nodiscard]] Assigned AssignModes(const std::vector<double>& model_hz,
                                   const std::vector<ProposedMode>& shown);
/// At least one, at most `most`.
[[nodiscard]] std::vector<Assigned> PairModes(const std::vector<double>& model_hz,
                                              const std::vector<ProposedMode>& shown,
                                              std::size_t most = 8);

/// Frequencies of the standing rotor in its magnets, in one plane, ascending; unstable ones left
/// out.
[[nodiscard]] std::vector<double> PlantFrequenciesHz(const Physical& rig, bool y_plane);

enum class Support { kShown, kNotShown, kMoved };

struct ModeSupport {
  Support support{};
  double plant_hz{};  ///< of the fitted plant
  double shown_hz{};  ///< of the diagram; 0 when there is none
};

/// Per bending mode of the fit. `assigned` as before the fit; kMoved: the fit left the pole that it
/// started from, so its number explains something else.
[[nodiscard]] std::vector<ModeSupport> SupportOf(const Physical& rig, const Assigned& assigned);

}  // namespace levitas::identification
