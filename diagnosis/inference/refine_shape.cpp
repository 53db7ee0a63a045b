#include "diagnosis/inference/refine_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace levitas::diagnosis {
namespace {

constexpr int kRounds = 6;
constexpr double kLeast = 0.05;  ///< of a step; shorter ones are not tried
/// [nat] A round that gains less is the last. Not larger: of a strong effect (a support mode) a
/// coarse shape leaves a residual that hides every other effect.
constexpr double kWorth = 10.0;

class Members {
 public:
  Members(const Refiner& refiner, const Hypothesis& cause, const std::vector<Hypothesis>& causes,
          const View& view, int passes, std::vector<Term>& terms)
      : refiner_(refiner),
        cause_(cause),
        causes_(causes),
        view_(view),
        passes_(passes),
        terms_(terms) {}

  [[nodiscard]] const Family& family() const { return terms_[cause_.terms.front()].family; }

  void Become(std::size_t parameter, double log_value) {
    for (const std::size_t i : cause_.terms) {
      if (!terms_[i].family.member) continue;
      Family::Shape shape = terms_[i].family.shape;
      shape[parameter] = std::exp(log_value);
      Term other = terms_[i].family.member(shape);
      other.family.linearised_as = terms_[i].family.linearised_as;
      terms_[i] = std::move(other);
    }
  }

  /// A better value of one parameter than the present one, if there is one.
  Refined Improve(std::size_t parameter, double width, Refined start) {
    const double here = std::log(family().shape[parameter]);
    const auto [step, view] = refiner_.StepAlong(causes_, start.theta, view_, width,
                                                 [&](double by) { Become(parameter, here + by); });
    std::vector<double> theta = step.theta;
    for (double share = 1.0; share > kLeast; share *= 0.3) {
      for (std::size_t i = 0; i < theta.size(); ++i) {
        theta[i] = start.theta[i] + share * (step.theta[i] - start.theta[i]);
      }
      Become(parameter, here + share * step.step);
      Refined fit = refiner_.Fit(causes_, theta, view, passes_, start.evidence);
      if (fit.ok && fit.evidence > start.evidence) return fit;
    }
    Become(parameter, here);
    return start;
  }

 private:
  const Refiner& refiner_;
  const Hypothesis& cause_;
  const std::vector<Hypothesis>& causes_;
  const View& view_;
  int passes_;
  std::vector<Term>& terms_;
};

}  // namespace

bool HasFamily(const Hypothesis& cause, const std::vector<Term>& terms) {
  return std::any_of(cause.terms.begin(), cause.terms.end(),
                     [&terms](std::size_t i) { return static_cast<bool>(terms[i].family.member); });
}

Refined RefineShape(const Refiner& refiner, const Hypothesis& cause,
                    const std::vector<Hypothesis>& causes, const View& view, int passes,
                    Refined start, std::vector<Term>& terms, double worth) {
  Members members(refiner, cause, causes, view, passes, terms);
  Refined best = std::move(start);
  const Family::Shape width = members.family().log_width;
  // A parameter whose trials failed fails again until another one has moved the fit.
  std::size_t failed = 0;
  for (int round = 0; round < kRounds; ++round) {
    const double before = best.evidence;
    for (std::size_t parameter = 0; parameter < width.size(); ++parameter) {
      if (failed == width.size()) return best;
      const double evidence = best.evidence;
      best = members.Improve(parameter, width[parameter], std::move(best));
      failed = best.evidence > evidence ? 0 : failed + 1;
    }
    const double gained = best.evidence - before;
    if (gained < kWorth || best.evidence + (kRounds - 1 - round) * gained < worth) break;
  }
  return best;
}

}  // namespace levitas::diagnosis
