#include "diagnosis/search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <thread>

#include "analysis/recorded_rows.hpp"

namespace levitas::diagnosis {
namespace {

/// What every (re)start leaves behind and no parameter explains; the slow rest of it is small
/// beside what static loads do.
constexpr double kSettling = 0.3;  // [s]

}  // namespace

Search::Search(const RigView& rig, const std::vector<Term>& terms)
    : rig_(rig), terms_(terms), hypotheses_(MakeHypotheses(rig, terms)) {}

Gains Search::DesignGains(const std::vector<Record>& records, const ObserverSpeed& speed) const {
  const auto design = [this](const Record& record, const ObserverSpeed& at) {
    analysis::ObserverTuning tuning;
    tuning.speed_rad_per_s = record.mean_speed_rad_per_s;
    tuning.force_noise_share = at.force_noise_share;
    tuning.force_drift_share = at.force_drift_share;
    return analysis::DesignObserver(rig_.model->config(), tuning);
  };
  Gains gains;
  gains.reserve(records.size());
  for (const Record& record : records) {
    analysis::ObserverGain start = design(record, kFast);
    start.force_n_per_m.setZero();
    gains.push_back({std::make_shared<const analysis::ObserverGain>(design(record, speed)),
                     std::make_shared<const analysis::ObserverGain>(std::move(start))});
  }
  return gains;
}

std::vector<Trajectory> Search::Run(const std::vector<Record>& records, const Gains& gains,
                                    const std::vector<double>& theta) const {
  std::vector<Trajectory> runs(records.size());
  const auto work = [&](std::size_t first) {
    for (std::size_t i = first; i < records.size(); i += 2) {
      runs[i] = RunModel(rig_, records[i], gains[i], terms_, theta, kSettling);
    }
  };
  std::thread other(work, 1);
  work(0);
  other.join();
  return runs;
}

View Search::Linearise(const std::vector<Record>& records, const Gains& gains,
                       const std::vector<double>& theta, std::size_t whitening_order,
                       const std::vector<std::size_t>& chosen) const {
  View view;
  view.runs = Run(records, gains, theta);
  view.whitener = MakeWhitener(view.runs, rig_.axes, whitening_order);
  view.problem = Linearise(view.runs, theta, view.whitener, chosen);
  return view;
}

LinearProblem Search::Linearise(const std::vector<Trajectory>& runs,
                                const std::vector<double>& theta, const Whitener& whitener,
                                const std::vector<std::size_t>& chosen) const {
  const NormalEquations part = Accumulate(rig_, runs, terms_, theta, whitener, chosen);
  NormalEquations all;
  const auto size = static_cast<Eigen::Index>(terms_.size());
  all.jtj = Eigen::MatrixXd::Zero(size, size);
  all.jte = Eigen::VectorXd::Zero(size);
  all.ete = part.ete;
  all.values = part.values;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(chosen[i]);
    all.jte[row] = part.jte[static_cast<Eigen::Index>(i)];
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      all.jtj(row, static_cast<Eigen::Index>(chosen[k])) =
          part.jtj(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  }
  Eigen::VectorXd scaled(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Term& term = terms_[static_cast<std::size_t>(i)];
    scaled[i] = (theta[static_cast<std::size_t>(i)] - term.usual) / term.scale();
  }
  return AtOrigin(all, scaled);
}

std::vector<double> Search::Solve(const LinearProblem& problem,
                                  const std::vector<Hypothesis>& causes) const {
  const Fit fit = Evidence(problem, terms_, causes).Solve();
  std::vector<double> theta(terms_.size());
  for (std::size_t i = 0; i < theta.size(); ++i) {
    theta[i] = terms_[i].usual + fit.theta[static_cast<Eigen::Index>(i)] * terms_[i].scale();
    if (terms_[i].positive) theta[i] = std::max(theta[i], 0.0);
  }
  return theta;
}

std::vector<double> Search::Usual() const {
  std::vector<double> theta;
  theta.reserve(terms_.size());
  for (const Term& term : terms_) theta.push_back(term.usual);
  return theta;
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
    const bool moved = std::any_of(causes.begin(), causes.end(), [i](const Hypothesis& h) {
      return std::find(h.terms.begin(), h.terms.end(), i) != h.terms.end();
    });
    if (terms_[i].nuisance() || moved) chosen.push_back(i);
  }
  return chosen;
}

std::vector<Record> Spans(const std::vector<Record>& records, std::size_t rows) {
  constexpr std::size_t kSpan = 10'000;  // rows; a third of it settles
  std::size_t total = 0;
  for (const Record& record : records) total += record.rows.size();
  if (total <= rows) return records;
  std::vector<Record> out;
  out.reserve(records.size());
  for (const Record& record : records) {
    const std::size_t all = record.rows.size();
    const auto share = static_cast<std::size_t>(
        static_cast<double>(rows) * static_cast<double>(all) / static_cast<double>(total));
    const std::size_t spans = std::max<std::size_t>(1, share / kSpan);
    const std::size_t length = std::min(all, share / spans);
    Record part = record;
    part.rows.clear();
    for (std::size_t i = 0; i < spans; ++i) {
      // The first span begins and the last one ends with the record.
      const std::size_t from = spans == 1 ? (all - length) / 2 : i * (all - length) / (spans - 1);
      const auto first = record.rows.begin() + static_cast<std::ptrdiff_t>(from);
      part.rows.insert(part.rows.end(), first, first + static_cast<std::ptrdiff_t>(length));
    }
    part.mean_speed_rad_per_s = analysis::MeanSpeed(part.rows);
    out.push_back(std::move(part));
  }
  return out;
}

}  // namespace levitas::diagnosis
