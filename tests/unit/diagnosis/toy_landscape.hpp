#pragma once
// A landscape of evidence that a test makes: one vector of readings, and effects that are vectors.
//
// Evidence   of a set: -|what is left of the readings|^2/2 - kOccam per cause; its fit is exact.
// Nonlinear  a test may say what the nonlinear model makes of a set instead (`fitted`), that it
//            cannot be fitted (`refused`), and what a better shape of an effect is worth (`shape`).
// Seen       which sets were fitted, in order, and how often it was linearised anew.
// Interface  Landscape: EvidenceLandscape, or one that asks for more (toy_observed.hpp).

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/evidence_landscape.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {

/// Effects by the part that they play in a test, whose landscape says what they do. In the order of
/// their names, so that what is equally good comes in the order of the words.
namespace role {
inline constexpr effect::Id kAll = effect::Id::kAmplifierBandwidth;
inline constexpr effect::Id kAlternative = effect::Id::kAmplifierSlew;
inline constexpr effect::Id kBetterInFact = effect::Id::kAxisRotation;
inline constexpr effect::Id kBetterOnTheScreen = effect::Id::kBacklash;
inline constexpr effect::Id kBoth = effect::Id::kBreathingCrack;
inline constexpr effect::Id kEffect = effect::Id::kCoilAsymmetry;
inline constexpr effect::Id kElsewhere = effect::Id::kCommandOffset;
inline constexpr effect::Id kFamily = effect::Id::kCouplingStiffness;
inline constexpr effect::Id kFarBehind = effect::Id::kCrossCoupledStiffness;
inline constexpr effect::Id kFirst = effect::Id::kCurrentGain;
inline constexpr effect::Id kGreater = effect::Id::kDisplacementStiffness;
inline constexpr effect::Id kImitation = effect::Id::kDroppedSamples;
inline constexpr effect::Id kLeader = effect::Id::kEddyCurrent;
inline constexpr effect::Id kLesser = effect::Id::kExtraDelay;
inline constexpr effect::Id kMode = effect::Id::kMeshFriction;
inline constexpr effect::Id kOnly = effect::Id::kSampleJitter;
inline constexpr effect::Id kOther = effect::Id::kSensorBandwidth;
inline constexpr effect::Id kSecond = effect::Id::kSensorGain;
inline constexpr effect::Id kStrong = effect::Id::kSensorNoise;
inline constexpr effect::Id kThird = effect::Id::kSensorNonlinearity;
inline constexpr effect::Id kTrueCause = effect::Id::kSensorOffset;
inline constexpr effect::Id kTrueSecond = effect::Id::kSensorPosition;
inline constexpr effect::Id kWeak = effect::Id::kSensorRunout;
inline constexpr effect::Id kX = effect::Id::kShaftAnisotropy;
inline constexpr effect::Id kY = effect::Id::kShaftBow;
inline constexpr effect::Id kZ = effect::Id::kStaticLoad;
inline constexpr std::array kOneMore{
    effect::Id::kMeshStiffness, effect::Id::kMeshStiffnessVariation, effect::Id::kMisalignment,
    effect::Id::kModalDamping,  effect::Id::kModalFrequency,         effect::Id::kRotorMass};
}  // namespace role

template <class Landscape>
class ToyEvidence : public Landscape {
 public:
  using Causes = EvidenceLandscape::Causes;
  using Effects = std::set<effect::Id>;
  static constexpr double kOccam = 3.0;  // [nat]
  static inline const Family::Shape kBest{2.0};

  explicit ToyEvidence(std::vector<double> readings) : readings_(std::move(readings)) {}

  /// Its direction has unit length afterwards.
  Hypothesis Add(effect::Id effect, const std::vector<double>& along,
                 const std::string& place = "here") {
    Hypothesis h;
    h.effect = effect;
    h.place = place;
    h.terms = {all_.size()};
    along_.push_back(Vector(along).normalized());
    at_.shapes.push_back({1.0});
    all_.push_back(h);
    return h;
  }

  [[nodiscard]] CauseSelection Found(const Causes& causes) const {
    CauseSelection found;
    found.calibrated = {std::vector<double>(all_.size(), 0.0), at_.shapes};
    found.causes = causes;
    found.point = SolutionOf(causes);
    return found;
  }

  std::map<Effects, double> fitted;    ///< [nat] evidence of the nonlinear fit
  std::set<Effects> refused;           ///< sets that no fit follows
  std::map<effect::Id, double> shape;  ///< [nat] gained by the best shape of the effect
  std::vector<ModeProbe> probes;
  bool stop{};                        ///< the search is to end
  std::map<double, double> from;      ///< [nat] where a fit begins with a theta of this value
  mutable std::vector<Effects> fits;  ///< in the order of time
  mutable std::vector<std::vector<double>> starts;     ///< of these fits
  std::vector<std::vector<Family::Shape>> linearised;  ///< the shapes at the time

  [[nodiscard]] const Causes& hypotheses() const override { return all_; }
  void LineariseAt(const Point& point) override {
    at_ = point;
    linearised.push_back(point.shapes);
  }
  [[nodiscard]] double GainOf(const Hypothesis& cause, const Causes& given) const override {
    Causes with = given;
    with.push_back(cause);
    return EvidenceOf(with) - EvidenceOf(given);
  }
  [[nodiscard]] double GainAt(const Refined&, const Hypothesis& cause,
                              const Causes& given) const override {
    return GainOf(cause, given);
  }
  [[nodiscard]] std::vector<Candidate> Screen(const Causes& given) const override {
    std::map<effect::Id, Candidate, effect::ByName> best;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const double gain = GainOf(all_[i], given);
      Candidate& at =
          best.try_emplace(all_[i].effect, Candidate{{}, {}, -1e9, 0, false}).first->second;
      if (gain > at.score) at = {all_[i].effect, all_[i].place, gain, i, false};
    }
    std::vector<Candidate> sorted;
    for (const auto& [effect, candidate] : best) sorted.push_back(candidate);
    SortByScore(sorted);
    return sorted;
  }
  [[nodiscard]] double EvidenceOf(const Causes& set) const override {
    const Eigen::VectorXd left = Vector(readings_) - Directions(set) * Amounts(set);
    return -0.5 * left.squaredNorm() - kOccam * static_cast<double>(set.size());
  }
  [[nodiscard]] Point SolutionOf(const Causes& set) const override {
    std::vector<double> theta(all_.size(), 0.0);
    const Eigen::VectorXd amounts = Amounts(set);
    for (std::size_t i = 0; i < set.size(); ++i) {
      theta[set[i].terms.front()] += amounts[static_cast<Eigen::Index>(i)];
    }
    return {theta, at_.shapes};
  }
  [[nodiscard]] Point SolutionAt(const Refined& fit, const Causes& set) const override {
    return {SolutionOf(set).theta, fit.point.shapes};
  }
  [[nodiscard]] Refined Fit(const Causes& set, const Point& start, int, double) const override {
    const Effects effects = EffectsOf(set);
    fits.push_back(effects);
    starts.push_back(start.theta);
    Refined fit;
    fit.ok = !refused.contains(effects);
    fit.point = {SolutionOf(set).theta, start.shapes};
    const auto known = fitted.find(effects);
    fit.evidence = known == fitted.end() ? EvidenceOf(set) : known->second;
    for (const double value : start.theta) {
      if (from.contains(value)) fit.evidence = from.at(value);
    }
    for (const Hypothesis& h : set) {
      if (HasShape(h) && start.shapes[h.terms.front()] == kBest) fit.evidence += shape.at(h.effect);
    }
    return fit;
  }
  [[nodiscard]] Refined Refit(const Causes& set, double worth) const override {
    return Fit(set, SolutionOf(set), 1, worth);
  }
  [[nodiscard]] Refined RefineShapeOf(const Causes& set, std::size_t at, Refined fit,
                                      double) const override {
    Family::Shape& present = fit.point.shapes[set[at].terms.front()];
    if (!HasShape(set[at]) || present == kBest) return fit;
    present = kBest;
    fit.evidence += shape.at(set[at].effect);
    return fit;
  }
  [[nodiscard]] bool HasShape(const Hypothesis& cause) const override {
    return shape.contains(cause.effect);
  }
  [[nodiscard]] std::string PlaceAt(const Point& point, const Hypothesis& cause) const override {
    const bool moved = HasShape(cause) && point.shapes[cause.terms.front()] == kBest;
    return moved ? "at its shape" : cause.place;
  }
  [[nodiscard]] std::vector<ModeProbe> Probes() const override { return probes; }
  [[nodiscard]] bool StopAsked() const override { return stop; }
  void ReportProgress(double, const std::string&) const override {}

  [[nodiscard]] static Effects EffectsOf(const Causes& set) {
    Effects effects;
    for (const Hypothesis& h : set) effects.insert(h.effect);
    return effects;
  }

 private:
  [[nodiscard]] static Eigen::VectorXd Vector(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  }
  [[nodiscard]] Eigen::MatrixXd Directions(const Causes& set) const {
    Eigen::MatrixXd columns(static_cast<Eigen::Index>(readings_.size()),
                            static_cast<Eigen::Index>(set.size()));
    for (std::size_t i = 0; i < set.size(); ++i) {
      columns.col(static_cast<Eigen::Index>(i)) = along_[set[i].terms.front()];
    }
    return columns;
  }
  /// Least squares; of two that are the same each takes a half.
  [[nodiscard]] Eigen::VectorXd Amounts(const Causes& set) const {
    if (set.empty()) return Eigen::VectorXd::Zero(0);
    return Directions(set).completeOrthogonalDecomposition().solve(Vector(readings_));
  }

  std::vector<Eigen::VectorXd> along_;

 protected:
  std::vector<double> readings_;
  Causes all_;
  Point at_;  ///< where it is linearised
};

using ToyLandscape = ToyEvidence<EvidenceLandscape>;

/// What a thorough search goes by.
inline SelectionRules ThoroughRules() {
  SelectionRules rules;
  rules.effort = {40, 6, 8, 5, 1000, false};
  return rules;
}

/// True when the nonlinear model was asked for exactly these.
inline bool WasFitted(const ToyLandscape& toy, const ToyLandscape::Effects& set) {
  return std::find(toy.fits.begin(), toy.fits.end(), set) != toy.fits.end();
}

}  // namespace levitas::diagnosis
