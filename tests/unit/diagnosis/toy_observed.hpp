#pragma once
// A landscape of evidence with observers and one calibrated number, all of which a test makes.
//
// Number      of tolerance 1, healthy at 0, known to a thousandth: what a test says beyond 3 is
//             surely far (Judging::moved_tolerances). It stays where a fit begins, unless a test
//             says where it ends.
// Observers   a test says under which speed, with which causes, the model or its sensitivities
//             diverge, no fit follows, or how much is left of the readings (elsewhere 1).
// Filter      behind it is left what `behind_filter` says; a test may say what the readings are
//             without one.
// File        what fits from the file's numbers end with is the test's, too (FileScript).

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/inference/observed_landscape.hpp"
#include "diagnosis/model/observer_speed.hpp"
#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {

inline constexpr double kFarNumber = 6.0;  // [tolerances]

// Of kSpeeds.
inline constexpr std::size_t kSlowestObserver = 0;
inline constexpr std::size_t kMiddleObserver = 1;
inline constexpr std::size_t kFastestObserver = 2;

using EffectSet = std::set<effect::Id>;

inline EffectSet Named(const CauseSelection& found) {
  return ToyLandscape::EffectsOf(found.causes);
}

/// Where a fit from the file's numbers on ends.
struct Ending {
  double cost{std::numeric_limits<double>::infinity()};  ///< [nat]; infinite: no fit
  double number{};                                       ///< [tolerances]
};

/// How fits from the file end, which a test says, and which of them were asked for.
struct FileScript {
  std::map<EffectSet, Ending> free;                     ///< on from what was found
  Ending anew;                                          ///< without a cause, from the file on
  std::map<EffectSet, Ending> with;                     ///< from the file on
  std::vector<std::pair<effect::Id, double>> screened;  ///< about the file [nat], best first
  std::map<EffectSet, double> begun;                    ///< [nat] else as `with` ends
  std::vector<EffectSet> tried;                         ///< with a cause more, in order
  std::vector<EffectSet> finished;                      ///< of these
  std::vector<Point> linearised;                        ///< about the file
  int made{};                                           ///< how often these fits were asked for
};

class ToyObserved : public ToyEvidence<ObservedLandscape> {
 public:
  using Base = ToyEvidence<ObservedLandscape>;
  using Direction = std::pair<effect::Id, std::vector<double>>;
  using Under = std::pair<std::size_t, EffectSet>;  ///< the speed of observers, and causes

  ToyObserved(std::vector<double> readings, const std::vector<Direction>& effects)
      : Base(std::move(readings)) {
    for (const auto& [effect, along] : effects) Add(effect, along);
    at_.shapes.emplace_back();
    terms_.resize(all_.size() + 1);
    for (Hypothesis& h : all_) h.directions = Eigen::MatrixXd::Zero(Size(), 0);
    terms_.back().tolerance = 1.0;
  }

  [[nodiscard]] const Hypothesis& Of(effect::Id effect) const {
    return *std::find_if(all_.begin(), all_.end(),
                         [effect](const Hypothesis& h) { return h.effect == effect; });
  }
  [[nodiscard]] Causes CausesOf(const EffectSet& effects) const {
    Causes causes;
    for (const effect::Id effect : effects) causes.push_back(Of(effect));
    return causes;
  }
  /// As a search begins.
  [[nodiscard]] CauseSelection Calibrated() const {
    CauseSelection found;
    found.point = found.calibrated = SolutionOf({});
    return found;
  }
  /// As it goes on.
  [[nodiscard]] CauseSelection With(const EffectSet& effects) const {
    CauseSelection found = Calibrated();
    found.causes = CausesOf(effects);
    found.point = SolutionOf(found.causes);
    return found;
  }
  [[nodiscard]] static double NumberAt(const Point& point) { return point.theta.back(); }
  [[nodiscard]] Point PointWith(const Causes& causes, double at_number) const {
    Point point = SolutionOf(causes);
    point.theta.back() = at_number;
    return point;
  }

  std::map<EffectSet, double> number;  ///< [tolerances] where causes leave it; 0 without an entry
  std::map<double, double> ends;       ///< [tolerances] the number, by where a fit begins
  std::set<Under> loses;               ///< the model loses the rotor
  std::set<Under> wild;                ///< sensitivities diverge
  std::set<Under> unfollowed;          ///< no fit follows
  std::map<Under, double> left;        ///< rms of what the model leaves
  double behind_filter{1.0};           ///< rms
  std::set<EffectSet> loud;
  std::vector<double> unfiltered_readings;    ///< where a filter hides something; else empty
  std::size_t sees_shapes{kFastestObserver};  ///< the fastest observer under which shapes are found
  std::function<double(const EffectSet&, double at_number)> misfit = [](const EffectSet&, double) {
    return 0.0;
  };
  std::size_t at_speed{};
  std::shared_ptr<FileScript> file = std::make_shared<FileScript>();

  std::vector<std::size_t> observed;     ///< speeds, in order
  std::vector<Point> unfiltered_at;      ///< where it was linearised without a filter
  mutable int asked_loud{};              ///< whether it is loud
  mutable std::vector<std::string> did;  ///< progress, in order

  [[nodiscard]] int TimesDid(const std::string& what) const {
    return static_cast<int>(std::count(did.begin(), did.end(), what));
  }

  [[nodiscard]] const std::vector<Term>& terms() const override { return terms_; }
  [[nodiscard]] std::size_t speed() const override { return at_speed; }
  void Observe(std::size_t speed) override {
    at_speed = speed;
    observed.push_back(speed);
  }
  [[nodiscard]] const View& view() const override { return view_; }
  void LineariseAt(const Point& point) override {
    Base::LineariseAt(point);
    readings_ = filtered_readings_;
    Linearise(point, behind_filter);
  }
  void LineariseUnfiltered(const Point& point) override {
    at_ = point;
    unfiltered_at.push_back(point);
    if (!unfiltered_readings.empty()) readings_ = unfiltered_readings;
    Linearise(point, LeftAt(point));
  }
  [[nodiscard]] Runs RunsAt(const Point& point) const override {
    std::vector<Trajectory> runs(1);
    runs.front().moments.resize(1);
    runs.front().moments.front().innovation_m[0] = static_cast<float>(LeftAt(point));
    return std::make_shared<const std::vector<Trajectory>>(std::move(runs));
  }
  [[nodiscard]] bool ModelDivergesAt(const Point& point) const override {
    return loses.contains({at_speed, EffectsAt(point)});
  }
  [[nodiscard]] bool IsLoudAt(const Point& point) const override {
    ++asked_loud;
    return loud.contains(EffectsAt(point));
  }
  [[nodiscard]] Whitener PlainFilterOf(const std::vector<Trajectory>& runs) const override {
    return {0, {{1.0 / static_cast<double>(runs.front().moments.front().innovation_m[0])}}};
  }
  [[nodiscard]] double MisfitOf(const Causes& causes, const Point& point) const override {
    return misfit(EffectsOf(causes), NumberAt(point));
  }
  [[nodiscard]] Point FileNumbers() const override {
    return {std::vector<double>(terms_.size(), 0.0), at_.shapes};
  }
  [[nodiscard]] std::unique_ptr<FileFits> FitsFromFile() const override;

  [[nodiscard]] Point SolutionOf(const Causes& set) const override {
    Point point = Base::SolutionOf(set);
    const auto known = number.find(EffectsOf(set));
    point.theta.push_back(known == number.end() ? 0.0 : known->second);
    return point;
  }
  [[nodiscard]] Refined Fit(const Causes& set, const Point& start, int passes,
                            double worth) const override {
    Refined fit = Base::Fit(set, start, passes, worth);
    const auto end = ends.find(NumberAt(start));
    fit.point.theta.back() = end == ends.end() ? NumberAt(start) : end->second;
    fit.problem = Known();
    if (unfollowed.contains({at_speed, EffectsOf(set)})) fit.ok = false;
    return fit;
  }
  [[nodiscard]] Refined RefineShapeOf(const Causes& set, std::size_t at, Refined fit,
                                      double worth) const override {
    if (at_speed > sees_shapes) return fit;
    return Base::RefineShapeOf(set, at, std::move(fit), worth);
  }
  void ReportProgress(double, const std::string& what) const override { did.push_back(what); }

  /// The number is known to a thousandth of its tolerance, and nothing else is.
  [[nodiscard]] LinearProblem Known() const {
    LinearProblem problem;
    problem.jtj = Eigen::MatrixXd::Zero(Size(), Size());
    problem.jtj(Size() - 1, Size() - 1) = 1e6;
    problem.jte = Eigen::VectorXd::Zero(Size());
    return problem;
  }

 private:
  [[nodiscard]] Eigen::Index Size() const { return static_cast<Eigen::Index>(terms_.size()); }
  /// Causes that act at the point.
  [[nodiscard]] EffectSet EffectsAt(const Point& point) const {
    EffectSet effects;
    for (const Hypothesis& h : all_) {
      if (point.theta[h.terms.front()] != 0.0) effects.insert(h.effect);
    }
    return effects;
  }
  [[nodiscard]] double LeftAt(const Point& point) const {
    const auto known = left.find({at_speed, EffectsAt(point)});
    return known == left.end() ? 1.0 : known->second;
  }
  void Linearise(const Point& point, double behind) {
    view_.point = point;
    view_.runs = RunsAt(point);
    view_.whitener = {0, {{1.0 / behind}}};
    view_.problem = Known();
    view_.sum.values = 1;
    const bool diverges = wild.contains({at_speed, EffectsAt(point)});
    view_.sum.jtj =
        Eigen::MatrixXd::Constant(1, 1, diverges ? std::numeric_limits<double>::infinity() : 1.0);
  }

  std::vector<Term> terms_;
  View view_;
  std::vector<double> filtered_readings_{readings_};
};

/// Fits as the script says; the model of a fit is the toy's.
class ToyFileFits final : public FileFits {
 public:
  ToyFileFits(const ToyObserved& toy, std::shared_ptr<FileScript> script)
      : toy_(toy), script_(std::move(script)) {}

  [[nodiscard]] JointFit Free(const Point& held,
                              const std::vector<Hypothesis>& causes) const override {
    return Made(script_->free, held, causes);
  }
  [[nodiscard]] JointFit Anew() const override {
    return Made({{EffectSet{}, script_->anew}}, toy_.FileNumbers(), {});
  }
  [[nodiscard]] View LineariseAt(const Point& held) const override {
    script_->linearised.push_back(held);
    View view;
    view.point = held;
    return view;
  }
  [[nodiscard]] std::vector<Candidate> Screened(const View&, const JointFit& base) const override {
    std::vector<Candidate> candidates;
    for (const auto& [effect, score] : script_->screened) {
      if (ToyObserved::EffectsOf(base.causes).contains(effect)) continue;
      candidates.push_back({effect, "here", score, toy_.Of(effect).terms.front(), false});
    }
    return candidates;
  }
  [[nodiscard]] JointStart Begin(const View& view, const JointFit& base,
                                 const Hypothesis& cause) const override {
    JointStart start{base.causes, view.point};
    start.causes.push_back(cause);
    const EffectSet effects = ToyObserved::EffectsOf(start.causes);
    script_->tried.push_back(effects);
    const auto known = script_->begun.find(effects);
    start.cost = known == script_->begun.end() ? Made(script_->with, start.held, start.causes).cost
                                               : known->second;
    return start;
  }
  [[nodiscard]] JointFit Finish(const JointStart& begun) const override {
    script_->finished.push_back(ToyObserved::EffectsOf(begun.causes));
    return Made(script_->with, begun.held, begun.causes);
  }

 private:
  [[nodiscard]] JointFit Made(const std::map<EffectSet, Ending>& endings, const Point& held,
                              const std::vector<Hypothesis>& causes) const {
    const auto known = endings.find(ToyObserved::EffectsOf(causes));
    if (known == endings.end() || !std::isfinite(known->second.cost)) return {};
    JointFit made{causes, held, {}, known->second.cost};
    made.free.ok = true;
    made.free.point = toy_.PointWith(causes, known->second.number);
    made.free.problem = toy_.Known();
    return made;
  }

  const ToyObserved& toy_;
  std::shared_ptr<FileScript> script_;
};

inline std::unique_ptr<FileFits> ToyObserved::FitsFromFile() const {
  ++file->made;
  return std::make_unique<ToyFileFits>(*this, file);
}

}  // namespace levitas::diagnosis
