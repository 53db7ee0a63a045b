#pragma once
// Hypotheses of a diagnosis: which terms change together, and at which place.
//
// Made from  the list of terms: every place of an effect by itself, the axes of a bearing together,
//            all axes by the same amount, all of them freely. Terms of an effect at one place
//            (cosine and sine, both powers) always move together.
// No effect  a term without one (mode shapes) is calibrated, and makes no hypothesis.
// Prior      each effect counts the same, whatever the number of its places: the evidence of a
//            place is reduced by the logarithm of their number.
// Thread     any; pure.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/model/term.hpp"
#include "plant_sim/effect/effect_config.hpp"

namespace levitas::diagnosis {

struct Hypothesis {
  effect::Id effect{};
  std::string place;
  /// Columns: directions in the space of all terms, in units of Term::scale(), prior variance 1.
  Eigen::MatrixXd directions;
  std::vector<std::size_t> terms;  ///< that it moves
  bool positive{};
  double log_prior{};
};

/// True when the term is one of those that it moves.
[[nodiscard]] bool Moves(const Hypothesis& hypothesis, std::size_t term) noexcept;

/// True when any of them moves it.
[[nodiscard]] bool Moves(const std::vector<Hypothesis>& causes, std::size_t term) noexcept;

/// True when both say the same of the rig: the effect, its place and the terms that it moves.
[[nodiscard]] bool AreSame(const Hypothesis& a, const Hypothesis& b) noexcept;

/// True when one of the causes says the same.
[[nodiscard]] bool IsAmong(const std::vector<Hypothesis>& causes, const Hypothesis& cause) noexcept;

/// True when one of the causes is of the effect, at whatever place.
[[nodiscard]] bool HasEffect(const std::vector<Hypothesis>& causes, effect::Id effect) noexcept;

/// Which of all hypotheses the cause is; their number where it is none of them.
[[nodiscard]] std::size_t IndexOf(const std::vector<Hypothesis>& all,
                                  const Hypothesis& cause) noexcept;

[[nodiscard]] std::vector<Hypothesis> MakeHypotheses(const RigView& rig,
                                                     const std::vector<Term>& terms);

}  // namespace levitas::diagnosis
