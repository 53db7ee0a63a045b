#pragma once
// What the search for causes asks of the records: the evidence of any set of causes, and its fit.
//
// Why         merging, exchanging, dropping, ranking and refitting causes are decisions about
//             numbers. Behind this interface they need no rig and no record, and a test can give
//             them numbers of its own (tests/unit/diagnosis/toy_landscape.hpp). Rotors and a ball
//             between two magnets (diagnosis/levitator/levitator_landscape.hpp) share them so.
// Linearised  a rotor's GainOf, Screen, EvidenceOf and SolutionOf see the model linearised where
//             LineariseAt was called last; they cost next to nothing. A landscape whose laws bend
//             more may fit the sets that it is asked about instead.
// Fitted      Fit, Refit and RefineShapeOf run the nonlinear model: seconds.
// Shapes      of families of laws (Family::shape) are part of a point, as theta is. A fit keeps
//             those that it begins with; RefineShapeOf alone returns others.
// Comparable  are fits between two calls of LineariseAt, which whitens anew.
// Refined     has a point, its evidence, and whether there is one. The rest is of RecordLandscape.
// Units       evidence and gains in nats; theta in the terms' own units. Thread: blocks the caller,
//             every processor inside. Failure: a Refined that is not `ok`.

#include <string>
#include <vector>

#include "diagnosis/inference/diagnose.hpp"
#include "diagnosis/inference/mode_probe.hpp"
#include "diagnosis/inference/refine.hpp"

namespace levitas::diagnosis {

class EvidenceLandscape {
 public:
  using Causes = std::vector<Hypothesis>;

  EvidenceLandscape() = default;
  EvidenceLandscape(const EvidenceLandscape&) = delete;
  EvidenceLandscape& operator=(const EvidenceLandscape&) = delete;
  virtual ~EvidenceLandscape() = default;

  [[nodiscard]] virtual const Causes& hypotheses() const = 0;
  virtual void LineariseAt(const Point& point) = 0;

  /// What `cause` explains beyond `given`.
  [[nodiscard]] virtual double GainOf(const Hypothesis& cause, const Causes& given) const = 0;
  /// The same on the linearisation that a fit ended with.
  [[nodiscard]] virtual double GainAt(const Refined& fit, const Hypothesis& cause,
                                      const Causes& given) const = 0;
  /// Every effect at its best place beyond `given`, best first.
  [[nodiscard]] virtual std::vector<Candidate> Screen(const Causes& given) const = 0;
  [[nodiscard]] virtual double EvidenceOf(const Causes& set) const = 0;
  /// The best fit of the linearised model, with the shapes that it has.
  [[nodiscard]] virtual Point SolutionOf(const Causes& set) const = 0;
  [[nodiscard]] virtual Point SolutionAt(const Refined& fit, const Causes& set) const = 0;

  /// From `start` on. May end early where the evidence `worth` is out of reach.
  [[nodiscard]] virtual Refined Fit(const Causes& set, const Point& start, int passes,
                                    double worth = kAnyEvidence) const = 0;
  /// From the linearised solution on, with all passes that a fit may have.
  [[nodiscard]] virtual Refined Refit(const Causes& set, double worth = kAnyEvidence) const = 0;
  /// `fit` of `set` with the best shape of the family of set[at]; as it is without a family.
  [[nodiscard]] virtual Refined RefineShapeOf(const Causes& set, std::size_t at, Refined fit,
                                              double worth = kAnyEvidence) const = 0;
  [[nodiscard]] virtual bool HasShape(const Hypothesis& cause) const = 0;
  /// What a report calls the place of the cause: of a member of a family, after its shape there.
  [[nodiscard]] virtual std::string PlaceAt(const Point& point, const Hypothesis& cause) const = 0;
  /// Starts for frequencies of modes that the linearisation does not reach.
  [[nodiscard]] virtual std::vector<ModeProbe> Probes() const = 0;

  /// Whether the search is to end with what it has found so far.
  [[nodiscard]] virtual bool StopAsked() const { return false; }
  /// Share of the whole diagnosis that is done, and what is being done.
  virtual void ReportProgress(double share, const std::string& what) const = 0;
};

}  // namespace levitas::diagnosis
