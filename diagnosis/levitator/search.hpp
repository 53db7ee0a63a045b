#pragma once
// Model selection for a levitator: which causes explain its residual.
//
// Method     the steps of diagnosis/inference on the evidence of levitator_landscape.hpp: forward
//            selection (selection_steps.hpp), also from other first causes (first_cause.hpp);
//            backward check; what loses on validation data goes (refuted_causes.hpp); every effect
//            in the place of each cause (alternatives.hpp).
// Form       records are worth 1e5 nat here, and laws of coils are known better than those of a
//            rotor's magnets: a further cause must gain kForm of what is explained, and what comes
//            within kFormOfTie of a cause's evidence is its tie.
// Validation gain in likelihood on records that were not fitted, where there are any.
// Thread     blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/fit_gain.hpp"
#include "diagnosis/levitator/levitator_landscape.hpp"

namespace levitas::levitator {

inline constexpr double kForm = 0.001;

/// No law is known better than to this share of the evidence.
inline constexpr double kFormOfTie = 0.005;

struct Found {
  Causes causes;  ///< the weightiest first
  Fitted calibrated;
  Fitted extended;
  Filters filters;  ///< of what is left with everything free (Fitter::Noise)
  /// Of every cause: each effect at its best place instead of it, itself included; without a cause
  /// one list of what each would add.
  std::vector<std::vector<diagnosis::Candidate>> in_place;
  double evidence{};  ///< [nat] of all causes together
  // Without validation records there is no gain on them, and nothing is doubted.
  diagnosis::FitGain validation;  ///< of all causes together on the validation records
  diagnosis::Doubt doubt{diagnosis::Doubt::kNothing};  ///< that the validation records leave
  double probability{};  ///< that the causes are there all the same, where they are doubted
};

struct SearchSettings {
  std::size_t most_causes{10};
  double form_share{kForm};  ///< of what is explained, to be gained by a further cause
  /// Validation data are a part of the records themselves: what loses there is no cause at all.
  bool own_validation{false};
  Progress progress;
};

[[nodiscard]] Found Search(const Misfit& data, const Misfit* validation,
                           const SearchSettings& settings);

/// What `with` explains beyond `without` of records that neither was fitted to.
[[nodiscard]] diagnosis::FitGain GainOn(const Misfit& validation, const Filters& filters,
                                        const Theta& with, const Theta& without);

/// Parameters of a fit for validation records: of the per-record parameters, the mean.
[[nodiscard]] Theta SharedPart(const Theta& theta, std::size_t records);

}  // namespace levitas::levitator
