#pragma once
// Which effects records can tell apart, foretold from the signature that each would leave in them.
//
// Signature  what a fault adds to the innovations of the model that does not know it, noise left
//            out; here as normal equations (healthy_model.hpp), whitened as a diagnosis whitens.
// Visible    detectable = half the squared norm of what calibration within the tolerances leaves of
//            the signature, penalties of the calibrated numbers included [nat].
// Directed   left(i, j) = the same of i's signature after the parameters of j, at the place that
//            suits best, have been fitted too: 0 where j does all that i does. It is not symmetric.
// Answer     evidence of every effect for the signature of i, Occam factor and priors of places as
//            in evidence.hpp: what the ranking of a diagnosis would have with the mean of the
//            noise. i's own effect takes all that calibration left, since a diagnosis fits it on
//            the nonlinear model. From there as ranking.hpp judges: not visible below decisive_nat;
//            tied with what comes within decisive_nat, or form_share of its evidence.
// Chance     of real noise a gain of g nat scatters by about sqrt(2 g) (the signature against unit
//            noise): `probability` that it exceeds decisive_nat.
// Limits     the alternatives are linear: one that could do more with a large step is taken for
//            separable. One effect at a time.
// Thread     any; pure.

#include <string>
#include <vector>

#include "diagnosis/inference/evidence.hpp"
#include "diagnosis/inference/judging.hpp"

namespace levitas::diagnosis {

enum class Isolation : std::uint8_t {
  kFound,      ///< named alone
  kTied,       ///< named together with others
  kTakenFor,   ///< another effect would be named
  kNotVisible  ///< calibration takes it, or the noise hides it
};

/// "found", "tied", "taken_for", "not_visible".
[[nodiscard]] const char* Word(Isolation isolation) noexcept;

/// Another effect against the signature of the one in question.
struct Alternative {
  effect::Id effect{};
  std::string place;      ///< that suits best
  double evidence_nat{};  ///< -infinity: it would have to be negative
  double left_nat{};      ///< of the signature, with its parameters fitted
};

struct Prediction {
  effect::Id effect{};
  Isolation isolation{Isolation::kNotVisible};
  double detectable_nat{};
  double evidence_nat{};  ///< of its own effect
  /// Share of the size at which it would be decisive, signature and size in proportion.
  double visible_from{};
  double probability{};                   ///< that noise leaves it decisive
  bool by_moved_number{};                 ///< visible by where calibration went alone
  std::vector<effect::Id> ties;           ///< best first; of kTakenFor: what would be named
  std::vector<Alternative> alternatives;  ///< every effect of the hypotheses but itself, best first
};

/// `signature` has `ete` of the signature alone, about the healthy rig.
[[nodiscard]] Prediction Predict(effect::Id effect, const LinearProblem& signature,
                                 const std::vector<Term>& terms,
                                 const std::vector<Hypothesis>& hypotheses, const Judging& judging);

/// Of what shows in single samples (events.hpp): evidence alone, nothing is mistaken for it.
[[nodiscard]] Prediction PredictEvent(effect::Id effect, double evidence_nat,
                                      const Judging& judging);

}  // namespace levitas::diagnosis
