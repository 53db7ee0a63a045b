#include "design/pid/pid_search.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <future>
#include <mutex>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "numerics/minimum/evolution_strategy.hpp"

namespace levitas::design {
namespace {

using Eigen::VectorXd;

struct Candidate {
  VectorXd x;
  double cost{1e9};
};

std::vector<PlantToHold> EveryPlant(const configuration::RigFile& rig,
                                    const std::vector<uncertainty::Parameter>& parameters,
                                    const PidSearchOptions& options) {
  constexpr int kSpeeds = 12;
  const double low = options.least_speed_rad_per_s;
  const double top = options.most_speed_rad_per_s > 0.0 ? options.most_speed_rad_per_s
                                                        : 1.1 * rig.numbers.max_speed_rad_per_s;
  const bool turns = rig.numbers.axes() > 1 && !options.first_levitation;
  const Known known = options.first_levitation ? Known::kRigidBody : Known::kAll;
  std::vector<PlantToHold> out;
  for (int i = 0; i <= (turns ? kSpeeds : 0); ++i)
    out.push_back({std::make_shared<SampledPlant>(rig, low + (top - low) * i / kSpeeds, known,
                                                  options.coordinates),
                   true});
  std::vector<uncertainty::Parameter> moved;
  for (const auto& parameter : parameters)
    if (!options.first_levitation || parameter.kind == uncertainty::Kind::kCurrentGain ||
        parameter.kind == uncertainty::Kind::kStiffness)
      moved.push_back(parameter);
  Random draw(options.seed + 500);
  for (std::size_t c = 0; c < options.corners; ++c) {
    auto place = uncertainty::DrawPlace(draw, moved.size());
    for (double& p : place) p = p < 0.0 ? -1.0 : 1.0;
    const auto corner = uncertainty::At(rig, moved, place);
    for (const double speed : {low, top})
      if (speed == low || turns)
        out.push_back(
            {std::make_shared<SampledPlant>(corner, speed, known, options.coordinates), false});
  }
  return out;
}

/// Plain PIDs on a grid, the two best.
std::vector<Candidate> Starts(const LawShape& shape, const SampledPlant& plant,
                              const std::function<double(const VectorXd&)>& cost) {
  std::vector<Candidate> found;
  PlainGains gains;
  const double nyquist_hz = 0.5 / shape.period_s;
  gains.derivative_hz = std::min(1500.0, 0.5 * nyquist_hz);
  for (std::size_t i = 0; i < shape.notches; ++i)
    gains.notch_hz.push_back(
        std::min(0.04 * nyquist_hz * std::pow(2.2, double(i) + 1.0), 0.8 * nyquist_hz));
  const auto slope = [&](std::size_t b, const std::vector<double>& of) {
    return of.at(std::min(2 * b, of.size() - 1));
  };
  for (const double stiff : {1.15, 1.3, 1.6, 2.2, 3.5, 7.0, 14.0})
    for (const double damping_s : {3e-4, 8e-4, 2e-3, 5e-3, 1.5e-2})
      for (const double uneven : {0.5, 1.0, 2.0}) {
        if (shape.bearings == 1 && uneven != 1.0) continue;
        gains.kp_a_per_m.clear();
        gains.kd_a_s_per_m.clear();
        for (std::size_t b = 0; b < shape.bearings; ++b) {
          const double even =
              slope(b, plant.displacement_n_per_m()) / slope(b, plant.current_n_per_a());
          const double kp = even * (1.0 + (stiff - 1.0) * (b == 0 ? 1.0 : uneven));
          gains.kp_a_per_m.push_back(kp);
          gains.kd_a_s_per_m.push_back(kp * damping_s);
        }
        const VectorXd x = StartAt(shape, gains);
        found.push_back({x, cost(x)});
      }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  found.resize(std::min<std::size_t>(found.size(), 2));
  return found;
}

/// Both searches tell their best here; either may be asked to end.
class Watch {
 public:
  explicit Watch(const std::function<bool(double, const std::string&)>& seen) : seen_(seen) {}
  bool Note(std::size_t island, double cost, double share) {
    const std::lock_guard lock(mutex_);
    best_[island] = cost;
    if (!going_) return false;
    going_ = seen_(share, fmt::format("gains: cost {:.3f}; Ctrl-C: best so far",
                                      std::min(best_[0], best_[1])));
    return going_;
  }
  [[nodiscard]] bool going() const { return going_; }

 private:
  const std::function<bool(double, const std::string&)>& seen_;
  std::mutex mutex_;
  std::array<double, 2> best_{1e9, 1e9};
  std::atomic<bool> going_{true};
};

}  // namespace

double CostOf(const PidFigures& figures) {
  const double damping = figures[Limit::kDamping].found;
  if (figures.growing > 0)
    return 100.0 + 10.0 * figures.growing + std::clamp(-100.0 * damping, 0.0, 9.0);
  constexpr double kSafe = 0.995;  // a peak between the points of a search is not beyond its limit
  constexpr double kAllMet = 0.1;  // what the mean of the ratios counts beside the largest peak
  double excess = 0.0;
  double sum = 0.0;
  for (const Met& met : figures.met) {
    sum += std::min(met.ratio, 1.0);
    excess += std::max(0.0, met.ratio - kSafe);
  }
  return figures.margin + 5.0 * excess + kAllMet * sum / kLimits;
}

namespace {

/// One search: what is held grows round by round.
class Rounds {
 public:
  Rounds(const PidPoint* start, const configuration::RigFile& rig, const PidLimits& limits,
         const std::vector<uncertainty::Parameter>& parameters, const PidSearchOptions& options)
      : options_(options),
        near_(start != nullptr),
        judge_(rig, limits, options.third_n, options.coordinates),
        every_(EveryPlant(rig, parameters, options)) {
    if (const std::string& failure = every_.front().plant->failure(); !failure.empty())
      throw Problem(ExitStatus::kOther, "no law holds this rig: " + failure);
    shape_.bearings = rig.plant.bearings.size();
    shape_.axes = rig.numbers.axes();
    shape_.lead_lags = options.lead_lags;
    shape_.notches = options.notches;
    shape_.lead_lags_at_hz = options.lead_lags_at_hz;
    shape_.notches_at_hz = options.notches_at_hz;
    shape_.period_s = rig.numbers.period_s();
    shape_.current_limit_a = options.current_limit_a;
    Hold(0);
    const auto last =
        std::find_if(every_.begin(), every_.end(), [](const PlantToHold& p) { return !p.nominal; });
    Hold(static_cast<std::size_t>(last - every_.begin()) - 1);
    if (start != nullptr) {
      shape_ = start->shape;
      best_.assign(2, {start->x, Cost(start->x)});
      return;
    }
    best_ = Starts(shape_, *every_.front().plant, [this](const VectorXd& x) { return Cost(x); });
    while (best_.size() < 2) best_.push_back(best_.front());
  }

  PidSearchResult Run(const std::function<bool(double, const std::string&)>& seen) {
    Watch watch(seen);
    for (std::size_t round = 0; round < kRounds; ++round) {
      SearchTwice(round, watch);
      Keep();
      if (!watch.going()) break;
      if (!near_ && round == 0 && options_.own_filters && shape_.bearings > 1) {
        for (auto& candidate : best_) candidate.x = Untied(shape_, candidate.x);
        shape_.own_filters = true;
      } else if (round > 0) {
        best_[1] = best_[0];
      }
    }
    out_.plants_met = every_.size();
    out_.plants_held = held_.size();
    out_.interrupted = !watch.going();
    return out_;
  }

 private:
  static constexpr std::size_t kRounds = 6;
  static constexpr std::size_t kMostHeld = 7;
  static constexpr double kNearStep = 0.5;  // of a search's from afar

  [[nodiscard]] double Cost(const VectorXd& x) const {
    return CostOf(judge_.Of(LawAt(shape_, x), held_));
  }

  void Hold(std::size_t plant) {
    if (std::find(indices_.begin(), indices_.end(), plant) != indices_.end()) return;
    if (indices_.size() == kMostHeld) return;
    indices_.push_back(plant);
    held_.push_back(every_[plant]);
  }

  void SearchTwice(std::size_t round, Watch& watch) {
    constexpr std::array<double, kRounds> kSteps{0.3, 0.15, 0.1, 0.08, 0.05, 0.03};
    const std::size_t each = options_.evaluations / (2 * kRounds);
    const auto search = [&](std::size_t island) {
      numerics::EvolutionOptions evolution;
      evolution.evaluations = each;
      evolution.first_step = near_ ? kNearStep * kSteps[round] : kSteps[round];
      evolution.seed = options_.seed + 17 * round + island;
      return numerics::Evolve(
          best_[island].x, [this](const VectorXd& x) { return Cost(x); }, evolution,
          [&](std::size_t n, double value) {
            const double of_round = static_cast<double>(n) / static_cast<double>(each);
            return watch.Note(island, value, (static_cast<double>(round) + of_round) / kRounds);
          });
    };
    auto other = std::async(std::launch::async, [&] { return search(1); });
    const auto first = search(0);
    const auto second = other.get();
    best_[0] = {first.best, first.cost};
    best_[1] = {second.best, second.cost};
    if (second.cost < first.cost) std::swap(best_[0], best_[1]);
    out_.evaluations += first.evaluations + second.evaluations;
  }

  /// The best law meets every plant: it is kept when none before was better there, and the plants
  /// that are worst by one of its figures are held from now on.
  void Keep() {
    const law::LawConfig law = LawAt(shape_, best_[0].x);
    const PidFigures all = judge_.Of(law, every_);
    const double cost = CostOf(all);
    if (out_.law.axes.empty() || cost < out_.cost) {
      out_.law = law;
      out_.point = {shape_, best_[0].x};
      out_.figures = all;
      out_.cost = cost;
    }
    std::array<std::pair<double, std::size_t>, kLimits + 1> worst{};
    for (std::size_t i = 0; i < every_.size(); ++i) {
      const PidFigures one = judge_.Of(law, {every_[i]});
      const auto note = [&](std::size_t figure, double value) {
        if (value > worst[figure].first) worst[figure] = {value, i};
      };
      note(kLimits, one.growing);
      for (const Limit limit : {Limit::kSensitivity, Limit::kComplementary, Limit::kSingular,
                                Limit::kDamping, Limit::kCornerSensitivity})
        note(static_cast<std::size_t>(limit), one[limit].ratio);
    }
    constexpr double kNear = 0.9;  // of the limit: nothing that matters joins
    for (const auto& [value, plant] : worst)
      if (value > kNear) Hold(plant);
  }

  PidSearchOptions options_;
  bool near_{};
  PidJudge judge_;
  std::vector<PlantToHold> every_, held_;
  std::vector<std::size_t> indices_;
  LawShape shape_;
  std::vector<Candidate> best_;
  PidSearchResult out_;
};

}  // namespace

PidSearchResult SearchPid(const configuration::RigFile& rig, const PidLimits& limits,
                          const std::vector<uncertainty::Parameter>& parameters,
                          const PidSearchOptions& options,
                          const std::function<bool(double, const std::string&)>& seen) {
  return Rounds(nullptr, rig, limits, parameters, options).Run(seen);
}

PidSearchResult SearchPidFrom(const PidPoint& start, const configuration::RigFile& rig,
                              const PidLimits& limits,
                              const std::vector<uncertainty::Parameter>& parameters,
                              const PidSearchOptions& options,
                              const std::function<bool(double, const std::string&)>& seen) {
  return Rounds(&start, rig, limits, parameters, options).Run(seen);
}

}  // namespace levitas::design
