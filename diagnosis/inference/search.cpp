#include "diagnosis/inference/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "analysis/records/recorded_rows.hpp"
#include "diagnosis/inference/excited_windows.hpp"
#include "diagnosis/model/longest_first.hpp"

namespace levitas::diagnosis {
namespace {

/// What every (re)start leaves behind and no parameter explains; the slow rest of it is small
/// beside what static loads do.
constexpr double kSettling = 0.3;  // [s]

}  // namespace

double LeastPossible(const Term& term) {
  constexpr double kAlmostUndamped = -0.95;  // of the damping that the rig file says
  constexpr double kAlmostNoLag = -0.95;
  if (term.effect == effect::Id::kModalDamping) return kAlmostUndamped;
  if (term.effect == effect::Id::kSensorBandwidth) return kAlmostNoLag;
  return term.positive ? 0.0 : -std::numeric_limits<double>::infinity();
}

Search::Search(const RigView& rig, const std::vector<Term>& terms, std::optional<effect::Id> only,
               double model_error_share)
    : rig_(rig),
      terms_(terms),
      hypotheses_(MakeHypotheses(rig, terms)),
      model_error_share_(model_error_share) {
  if (!only) return;
  std::erase_if(hypotheses_, [only](const Hypothesis& h) { return h.effect != only; });
}

Gains Search::DesignGains(const std::vector<Record>& records, const ObserverSpeed& speed) const {
  const auto tuning = [](const Record& record, const ObserverSpeed& at) {
    return analysis::ObserverTuning{record.mean_speed_rad_per_s, at.force_noise_share,
                                    at.force_drift_share};
  };
  const plant::PlantConfig& plant = rig_.model->config();
  Gains gains(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const analysis::ObserverTuning fast = tuning(records[i], kFast);
    analysis::ObserverGain start = analysis::DesignObserver(plant, fast);
    start.force_n_per_m.setZero();
    gains[i].start = std::make_shared<const analysis::ObserverGain>(std::move(start));
    for (auto& stage : analysis::DesignSettling(plant, fast, tuning(records[i], speed))) {
      gains[i].stages.push_back({stage.from_sample, std::make_shared<const analysis::ObserverGain>(
                                                        std::move(stage.gain))});
    }
  }
  return gains;
}

std::vector<Trajectory> Search::Run(const std::vector<Record>& records, const Gains& gains,
                                    const Point& point) const {
  const TermsAt at(terms_, point);
  std::vector<Trajectory> runs(records.size());
  std::vector<std::size_t> rows;
  rows.reserve(records.size());
  for (const Record& record : records) rows.push_back(record.rows.size());
  LongestFirst(rows, [&](std::size_t i) {
    runs[i] = RunModel(rig_, records[i], gains[i], at.terms(), point.theta, kSettling);
  });
  return runs;
}

std::vector<Trajectory> Search::RunAlone(const std::vector<Record>& records, const Gains& gains,
                                         const Point& point) const {
  const TermsAt at(terms_, point);
  std::vector<Trajectory> runs;
  runs.reserve(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    runs.push_back(RunModel(rig_, records[i], gains[i], at.terms(), point.theta, kSettling));
  }
  return runs;
}

std::shared_ptr<const Slopes> Search::SlopesOf(const std::vector<Trajectory>& runs,
                                               const Point& point,
                                               const std::vector<std::size_t>& chosen) const {
  return std::make_shared<const Slopes>(rig_, runs, TermsAt(terms_, point).terms(), point.theta,
                                        chosen);
}

View Search::Linearise(const std::vector<Record>& records, const Gains& gains, const Point& point,
                       std::size_t whitening_order, const std::vector<std::size_t>& chosen) const {
  auto runs = std::make_shared<const std::vector<Trajectory>>(Run(records, gains, point));
  const Whitener whitener = WhitenerOf(*runs, whitening_order);
  return Linearise(std::move(runs), point, whitener, chosen);
}

View Search::Linearise(Runs runs, const Point& point, const Whitener& whitener,
                       const std::vector<std::size_t>& chosen) const {
  View view;
  view.point = point;
  view.runs = std::move(runs);
  view.whitener = whitener;
  view.slopes = SlopesOf(*view.runs, point, chosen);
  view.sum = view.slopes->Sum(*view.runs, whitener);
  view.problem = About(view.sum, point.theta);
  return view;
}

Eigen::VectorXd Search::Scaled(const std::vector<double>& theta) const {
  Eigen::VectorXd scaled(static_cast<Eigen::Index>(terms_.size()));
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    scaled[static_cast<Eigen::Index>(i)] = (theta[i] - terms_[i].healthy_mean) / terms_[i].scale();
  }
  return scaled;
}

std::vector<double> Search::Unscaled(const Eigen::VectorXd& scaled) const {
  std::vector<double> theta(terms_.size());
  for (std::size_t i = 0; i < theta.size(); ++i) {
    theta[i] = terms_[i].healthy_mean + scaled[static_cast<Eigen::Index>(i)] * terms_[i].scale();
    theta[i] = std::max(theta[i], LeastPossible(terms_[i]));
  }
  return theta;
}

LinearProblem Search::About(const NormalEquations& sum, const std::vector<double>& theta) const {
  return AtOrigin(sum, Scaled(theta));
}

std::vector<double> Search::Solve(const LinearProblem& problem,
                                  const std::vector<Hypothesis>& causes) const {
  return Unscaled(Evidence(problem, terms_, causes).Solve().theta);
}

std::vector<double> Search::Step(const LinearProblem& problem,
                                 const std::vector<Hypothesis>& causes,
                                 const std::vector<double>& theta, double damping) const {
  return Unscaled(Evidence(problem, terms_, causes).Step(Scaled(theta), damping));
}

Search::ShapeStep Search::StepAlong(const std::vector<Hypothesis>& causes,
                                    const std::vector<double>& theta, const NormalEquations& sum,
                                    const NormalEquations& below, const NormalEquations& above,
                                    double apart, double most) const {
  const Eigen::VectorXd cross = (above.jte - below.jte) / (2.0 * apart);
  const double gradient = (above.ete - below.ete) / (4.0 * apart);
  const double curvature = (above.ete + below.ete - 2.0 * sum.ete) / (2.0 * apart * apart);
  const LinearProblem problem = About(sum, theta);
  const auto beside =
      Evidence(problem, terms_, causes).StepBeside(Scaled(theta), cross, gradient, curvature, most);
  return {beside.step, Unscaled(beside.theta)};
}

Point Search::HealthyPoint() const {
  std::vector<double> theta;
  theta.reserve(terms_.size());
  for (const Term& term : terms_) theta.push_back(term.healthy_mean);
  return PointAt(terms_, std::move(theta));
}

std::vector<std::size_t> Search::Nuisances() const { return NuisancesAnd({}); }

std::vector<std::size_t> Search::Everything() const {
  std::vector<std::size_t> all(terms_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::vector<std::size_t> Search::NuisancesAnd(const std::vector<Hypothesis>& causes) const {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    if (terms_[i].nuisance() || Moves(causes, i)) chosen.push_back(i);
  }
  return chosen;
}

namespace {

/// The first span begins and the last one ends with the record.
std::vector<Window> EvenWindows(std::size_t rows, std::size_t spans, std::size_t length) {
  std::vector<Window> windows;
  for (std::size_t i = 0; i < spans; ++i) {
    const std::size_t from = spans == 1 ? (rows - length) / 2 : i * (rows - length) / (spans - 1);
    windows.push_back({from, length});
  }
  return windows;
}

std::size_t SettlingRows(double period_s) {
  return static_cast<std::size_t>(std::ceil(kSettling / period_s));
}

/// `choose` makes of the rows of a record and even windows those that are kept.
template <class Choose>
std::vector<Record> Parts(const std::vector<Record>& records, std::size_t rows, double period_s,
                          const Choose& choose) {
  constexpr std::size_t kSpan = 10'000;
  const std::size_t span = std::max(kSpan, 3 * SettlingRows(period_s));
  std::size_t total = 0;
  for (const Record& record : records) total += record.rows.size();
  if (total <= rows) return records;
  std::vector<Record> out;
  out.reserve(records.size());
  for (const Record& record : records) {
    const std::size_t all = record.rows.size();
    const auto share = static_cast<std::size_t>(
        static_cast<double>(rows) * static_cast<double>(all) / static_cast<double>(total));
    const std::size_t spans = std::max<std::size_t>(1, share / span);
    const std::size_t length = std::min(all, share / spans);
    Record part = record;
    part.rows.clear();
    for (const Window& window : choose(record.rows, EvenWindows(all, spans, length))) {
      const auto first = record.rows.begin() + static_cast<std::ptrdiff_t>(window.first);
      part.rows.insert(part.rows.end(), first, first + static_cast<std::ptrdiff_t>(window.length));
    }
    part.mean_speed_rad_per_s = analysis::MeanSpeed(part.rows);
    out.push_back(std::move(part));
  }
  return out;
}

}  // namespace

std::vector<Record> Spans(const std::vector<Record>& records, std::size_t rows, double period_s) {
  return Parts(records, rows, period_s, [](const auto&, std::vector<Window> even) { return even; });
}

std::vector<Record> QuickSpans(const std::vector<Record>& records, double period_s) {
  constexpr std::size_t kShortest = 6'000;  // rows of a window; up to half of it settles
  constexpr std::size_t kWindows = 5;       // one for each of four axes and one while it turns
  const std::size_t shortest = std::max(kShortest, SettlingRows(period_s) + kShortest / 2);
  return Parts(records, std::max(kQuickRows, kWindows * shortest), period_s,
               [shortest](const auto& rows, std::vector<Window> even) {
                 return TellingWindows(rows, std::move(even), shortest);
               });
}

}  // namespace levitas::diagnosis
