#pragma once
// The evidence of causes in the records of a ball between two magnets.
//
// Linearised the laws of coils bend too much for one linearisation to serve all sets: each is asked
//            about its own fit. So GainOf and EvidenceOf are those of the nonlinear model, and
//            Screen is linearised at the fit of `given`.
// Kept       the best fit of every set, for good. Refit begins once more after LineariseAt has gone
//            elsewhere; what that ends with is kept if it is better.
// Steps      a fit of `passes` up to four makes so many; of more, four, and unless that has shown
//            it to be hopeless for its `worth`, `passes` further ones.
// Whitened   once, with everything free (Fitter::Noise): all fits can be compared.
// Shapes     none, and no starts elsewhere. Hypotheses are those of causes.hpp, in their order.
// Lifetime   refers to the records of the caller.
// Units      nat. Thread: blocks the caller, every processor inside. Failure: BadInput for records
//            that the rig file's own numbers cannot be driven with.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/inference/evidence_landscape.hpp"
#include "diagnosis/levitator/fit.hpp"

namespace levitas::levitator {

/// Steps of a fit that is not given up.
inline constexpr int kAllSteps = 8;

using Progress = std::function<void(double, const std::string&)>;

class LevitatorLandscape final : public diagnosis::EvidenceLandscape {
 public:
  using Candidate = diagnosis::Candidate;
  using Hypothesis = diagnosis::Hypothesis;
  using Point = diagnosis::Point;
  using Refined = diagnosis::Refined;

  /// Calibrates, which is where it stands at first. `progress` may be empty.
  LevitatorLandscape(const Misfit& data, Progress progress);

  /// The best fit of the set so far; made where there is none. A later fit of the same set replaces
  /// what the reference shows.
  [[nodiscard]] const Fitted& FitOf(const Causes& set) const;
  [[nodiscard]] const Filters& filters() const { return filters_; }

  [[nodiscard]] const Causes& hypotheses() const override { return levitator::AllCauses(); }
  void LineariseAt(const Point& point) override;
  [[nodiscard]] double GainOf(const Hypothesis& cause, const Causes& given) const override;
  [[nodiscard]] double GainAt(const Refined& fit, const Hypothesis& cause,
                              const Causes& given) const override;
  /// Of effects that `given` has not.
  [[nodiscard]] std::vector<Candidate> Screen(const Causes& given) const override;
  [[nodiscard]] double EvidenceOf(const Causes& set) const override;
  [[nodiscard]] Point SolutionOf(const Causes& set) const override;
  [[nodiscard]] Point SolutionAt(const Refined& fit, const Causes& set) const override;
  [[nodiscard]] Refined Fit(const Causes& set, const Point& start, int passes,
                            double worth = diagnosis::kAnyEvidence) const override;
  [[nodiscard]] Refined Refit(const Causes& set,
                              double worth = diagnosis::kAnyEvidence) const override;
  [[nodiscard]] Refined RefineShapeOf(const Causes& set, std::size_t at, Refined fit,
                                      double worth = diagnosis::kAnyEvidence) const override;
  [[nodiscard]] bool HasShape(const Hypothesis& cause) const override;
  [[nodiscard]] std::string PlaceAt(const Point& point, const Hypothesis& cause) const override;
  [[nodiscard]] std::vector<diagnosis::ModeProbe> Probes() const override;
  void ReportProgress(double share, const std::string& what) const override;

 private:
  struct Kept {
    Fitted best;
    bool settled{};       ///< by all steps that a fit may have
    int linearisation{};  ///< of the last one that began where the search stood
  };
  /// Keeps the better one.
  void Keep(const Causes& set, Fitted fitted, bool settled) const;
  /// Fits and keeps. True where the fit made all steps that it may; false where it was given up.
  bool Settle(const Causes& set, const Point& start, int passes, double worth) const;
  [[nodiscard]] const Kept* Find(const Causes& set) const;

  Fitter fitter_;
  Filters filters_;
  Progress progress_;
  Point at_;
  int linearisation_{1};
  mutable std::map<std::vector<std::size_t>, Kept> kept_;  ///< by hypotheses, in order
  mutable double share_{};
};

}  // namespace levitas::levitator
