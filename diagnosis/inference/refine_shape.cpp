#include "diagnosis/inference/refine_shape.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
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
  Members(const MemberFits& fits, const Hypothesis& cause, const std::vector<Term>& terms)
      : fits_(fits), cause_(cause), terms_(terms) {}

  [[nodiscard]] const Family& family() const { return terms_[cause_.terms.front()].family; }

  /// A better value of one parameter than that of the start, if there is one.
  [[nodiscard]] Refined Improve(std::size_t parameter, double width, Refined start) {
    const double here = std::log(start.point.shapes[cause_.terms.front()][parameter]);
    // A parameter that did not help leaves the point to the next one.
    if (!about_ || about_->point != start.point) about_ = fits_.LinearisedAt(start.point);
    const auto step = fits_.StepAlong(start.point, *about_, width, [&](double by) {
      return Moved(start.point, parameter, here + by);
    });
    for (double share = 1.0; share > kLeast; share *= 0.3) {
      Point at = Moved(start.point, parameter, here + share * step.step);
      for (std::size_t i = 0; i < at.theta.size(); ++i) {
        at.theta[i] += share * (step.theta[i] - at.theta[i]);
      }
      Refined fit = fits_.Fit(std::move(at), *about_, start.evidence);
      if (fit.ok && fit.evidence > start.evidence) return fit;
    }
    return start;
  }

 private:
  /// With another value of one parameter of the shape.
  [[nodiscard]] Point Moved(Point point, std::size_t parameter, double log_value) const {
    for (const std::size_t i : cause_.terms) {
      if (terms_[i].family.member) point.shapes[i][parameter] = std::exp(log_value);
    }
    return point;
  }

  const MemberFits& fits_;
  const Hypothesis& cause_;
  const std::vector<Term>& terms_;
  std::optional<View> about_;
};

}  // namespace

bool HasFamily(const Hypothesis& cause, const std::vector<Term>& terms) {
  return std::any_of(cause.terms.begin(), cause.terms.end(),
                     [&terms](std::size_t i) { return static_cast<bool>(terms[i].family.member); });
}

Refined RefineShape(const MemberFits& fits, const Hypothesis& cause, Refined start,
                    const std::vector<Term>& terms, double worth) {
  Members members(fits, cause, terms);
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
