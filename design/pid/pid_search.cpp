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
#include "numerics/evolution_strategy.hpp"

namespace levitas::design {
namespace {

using Eigen::VectorXd;

bool IsMargin(Limit limit) {
  return limit == Limit::kSensitivity || limit == Limit::kComplementary ||
         limit == Limit::kSingular || limit == Limit::kCompliance;
}

struct Candidate {
  VectorXd x;
  double cost{1e9};
};

std::vector<PlantToHold> EveryPlant(const config::RigFile& rig,
                                    const std::vector<uncertainty::Parameter>& parameters,
                                    const PidSearchOptions& options) {
  constexpr int kSpeeds = 12;
  const double top = 1.1 * rig.numbers.max_speed_rad_per_s;
  const bool turns = rig.numbers.axes() > 1 && !options.first_levitation;
  const Known known = options.first_levitation ? Known::kRigidBody : Known::kAll;
  std::vector<PlantToHold> out;
  for (int i = 0; i <= (turns ? kSpeeds : 0); ++i)
    out.push_back({std::make_shared<SampledPlant>(rig, top * i / kSpeeds, known), true});
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
    for (const double speed : {0.0, top})
      if (speed == 0.0 || turns)
        out.push_back({std::make_shared<SampledPlant>(corner, speed, known), false});
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
  bool Note(std::size_t island, std::size_t evaluations, double cost, double share) {
    const std::lock_guard lock(mutex_);
    best_[island] = cost;
    done_[island] = evaluations;
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
  std::array<std::size_t, 2> done_{};
  std::atomic<bool> going_{true};
};

}  // namespace

double CostOf(const PidFigures& figures) {
  const double damping = figures[Limit::kDamping].found;
  if (figures.growing > 0)
    return 100.0 + 10.0 * figures.growing + std::clamp(-100.0 * damping, 0.0, 9.0);
  constexpr double kAllMet = 0.1;  // what the mean of the ratios counts beside the largest peak
  double margin = 0.0;
  double excess = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < kLimits; ++i) {
    const double ratio = figures.met[i].ratio;
    sum += std::min(ratio, 1.0);
    if (IsMargin(static_cast<Limit>(i)))
      margin = std::max(margin, ratio);
    else
      excess += std::max(0.0, ratio - 0.995);
  }
  return margin + 5.0 * excess + kAllMet * sum / kLimits;
}

PidSearchResult SearchPid(const config::RigFile& rig, const PidLimits& limits,
                          const std::vector<uncertainty::Parameter>& parameters,
                          const PidSearchOptions& options,
                          const std::function<bool(double, const std::string&)>& seen) {
  constexpr std::size_t kRounds = 4;
  const PidJudge judge(rig, limits, options.third_n);
  const auto every = EveryPlant(rig, parameters, options);
  if (const std::string& failure = every.front().plant->failure(); !failure.empty())
    throw Problem(ExitStatus::kOther, "no law holds this rig: " + failure);
  LawShape shape;
  shape.bearings = rig.plant.bearings.size();
  shape.axes = rig.numbers.axes();
  shape.lead_lags = options.lead_lags;
  shape.notches = options.notches;
  shape.period_s = rig.numbers.period_s();
  shape.current_limit_a = options.current_limit_a;
  std::vector<std::size_t> held{0};
  for (std::size_t i = 1; i < every.size() && every[i].nominal; ++i)
    if (i == 11) held.push_back(i);
  const auto plants = [&] {
    std::vector<PlantToHold> out;
    for (const std::size_t i : held) out.push_back(every[i]);
    return out;
  };
  auto now = plants();
  const auto cost = [&](const VectorXd& x) { return CostOf(judge.Of(LawAt(shape, x), now)); };
  PidSearchResult out;
  auto best = Starts(shape, *every.front().plant, cost);
  while (best.size() < 2) best.push_back(best.front());
  Watch watch(seen);
  const std::size_t each = options.evaluations / (2 * kRounds);
  double step = 0.3;
  for (std::size_t round = 0; round < kRounds && watch.going(); ++round) {
    const auto search = [&](std::size_t island) {
      numerics::EvolutionOptions evolution;
      evolution.evaluations = each;
      evolution.first_step = step;
      evolution.seed = options.seed + 17 * round + island;
      return numerics::Evolve(best[island].x, cost, evolution, [&](std::size_t n, double value) {
        const double share =
            (static_cast<double>(round) + static_cast<double>(n) / static_cast<double>(each)) /
            kRounds;
        return watch.Note(island, n, value, share);
      });
    };
    auto other = std::async(std::launch::async, [&] { return search(1); });
    const auto first = search(0);
    const auto second = other.get();
    best[0] = {first.best, first.cost};
    best[1] = {second.best, second.cost};
    if (second.cost < first.cost) std::swap(best[0], best[1]);
    out.evaluations += first.evaluations + second.evaluations;
    step = 0.15;
    if (round == 0 && options.own_filters && shape.bearings > 1) {
      for (auto& candidate : best) candidate.x = Untied(shape, candidate.x);
      shape.own_filters = true;
    } else if (round > 0) {
      best[1] = best[0];
      step = 0.08;
    }
    // The worst plant by cost of the best law joins.
    double worst = CostOf(judge.Of(LawAt(shape, best[0].x), now));
    std::size_t joins = every.size();
    for (std::size_t i = 0; i < every.size(); ++i) {
      const double alone = CostOf(judge.Of(LawAt(shape, best[0].x), {every[i]}));
      if (alone <= worst + 1e-3) continue;
      worst = alone;
      joins = i;
    }
    if (joins < every.size()) held.push_back(joins);
    now = plants();
  }
  out.law = LawAt(shape, best[0].x);
  out.figures = judge.Of(out.law, every);
  out.cost = CostOf(out.figures);
  out.plants_met = every.size();
  out.plants_held = held.size();
  out.interrupted = !watch.going();
  return out;
}

}  // namespace levitas::design
