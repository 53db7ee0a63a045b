#include "diagnosis/sharpen.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace levitas::diagnosis {
namespace {

constexpr int kRounds = 2;
constexpr double kNarrower = 3.0;
constexpr double kWorth = 1.0;  // [nat] a round that gains less is the last

/// One shape that was tried.
struct Tried {
  double log_shape{};
  Refined fit;
};

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

  void Become(double log_shape) {
    for (const std::size_t i : cause_.terms) {
      if (!terms_[i].family.member) continue;
      Term other = terms_[i].family.member(std::exp(log_shape));
      other.family.linearised_as = terms_[i].family.linearised_as;
      terms_[i] = std::move(other);
    }
  }

  Tried Try(double log_shape, const std::vector<double>& start) {
    Become(log_shape);
    return {log_shape, refiner_.Fit(causes_, start, view_, passes_)};
  }

 private:
  const Refiner& refiner_;
  const Hypothesis& cause_;
  const std::vector<Hypothesis>& causes_;
  const View& view_;
  int passes_;
  std::vector<Term>& terms_;
};

/// Highest point of the parabola through three, at most 1.5 widths off the middle one.
double Vertex(const Tried& below, const Tried& middle, const Tried& above, double width) {
  const double rise = 0.5 * (above.fit.evidence - below.fit.evidence);
  const double bend = below.fit.evidence + above.fit.evidence - 2.0 * middle.fit.evidence;
  const double off = bend < 0.0 ? -rise / bend : (rise > 0.0 ? 1.5 : -1.5);
  return middle.log_shape + width * std::clamp(off, -1.5, 1.5);
}

}  // namespace

bool HasFamily(const Hypothesis& cause, const std::vector<Term>& terms) {
  return std::any_of(cause.terms.begin(), cause.terms.end(),
                     [&terms](std::size_t i) { return static_cast<bool>(terms[i].family.member); });
}

Refined Sharpen(const Refiner& refiner, const Hypothesis& cause,
                const std::vector<Hypothesis>& causes, const View& view, int passes, Refined start,
                std::vector<Term>& terms) {
  Members members(refiner, cause, causes, view, passes, terms);
  const Term& first = terms[cause.terms.front()];
  double width = first.family.log_width;
  Tried best{std::log(first.family.shape), std::move(start)};
  for (int round = 0; round < kRounds; ++round, width /= kNarrower) {
    const double before = best.fit.evidence;
    const Tried middle = best;
    const auto keep = [&best](const Tried& tried) {
      if (tried.fit.ok && tried.fit.evidence > best.fit.evidence) best = tried;
    };
    const Tried below = members.Try(middle.log_shape - width, middle.fit.theta);
    const Tried above = members.Try(middle.log_shape + width, middle.fit.theta);
    keep(below);
    keep(above);
    if (below.fit.ok && above.fit.ok) {
      keep(members.Try(Vertex(below, middle, above, width), best.fit.theta));
    }
    if (best.fit.evidence - before < kWorth) break;
  }
  members.Become(best.log_shape);
  return std::move(best.fit);
}

}  // namespace levitas::diagnosis
