#include "diagnosis/sharpen.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace levitas::diagnosis {
namespace {

constexpr int kRounds = 6;
constexpr double kNarrower = 3.0;
/// [nat] A round that gains less is the last: where much is at stake, a support's frequency is known
/// to a thousandth, and what is left of the coarse one hides all else.
constexpr double kWorth = 10.0;

/// One member that was tried, by one of its parameters.
struct Tried {
  double log_value{};
  Refined fit;
};

/// Highest point of the parabola through three, at most 1.5 widths off the middle one.
double Vertex(const Tried& below, const Tried& middle, const Tried& above, double width) {
  const double rise = 0.5 * (above.fit.evidence - below.fit.evidence);
  const double bend = below.fit.evidence + above.fit.evidence - 2.0 * middle.fit.evidence;
  const double off = bend < 0.0 ? -rise / bend : (rise > 0.0 ? 1.5 : -1.5);
  return middle.log_value + width * std::clamp(off, -1.5, 1.5);
}

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

  /// The best value of one parameter around the present one.
  Refined Improve(std::size_t parameter, double width, Refined start) {
    const Tried middle{std::log(family().shape[parameter]), std::move(start)};
    Tried best = middle;
    const auto keep = [&best](const Tried& tried) {
      if (tried.fit.ok && tried.fit.evidence > best.fit.evidence) best = tried;
    };
    const Tried below = Try(parameter, middle.log_value - width, middle.fit.theta);
    const Tried above = Try(parameter, middle.log_value + width, middle.fit.theta);
    keep(below);
    keep(above);
    if (below.fit.ok && above.fit.ok) {
      keep(Try(parameter, Vertex(below, middle, above, width), best.fit.theta));
    }
    Become(parameter, best.log_value);
    return std::move(best.fit);
  }

 private:
  Tried Try(std::size_t parameter, double log_value, const std::vector<double>& start) {
    Become(parameter, log_value);
    return {log_value, refiner_.Fit(causes_, start, view_, passes_)};
  }

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

Refined Sharpen(const Refiner& refiner, const Hypothesis& cause,
                const std::vector<Hypothesis>& causes, const View& view, int passes, Refined start,
                std::vector<Term>& terms) {
  Members members(refiner, cause, causes, view, passes, terms);
  Refined best = std::move(start);
  Family::Shape width = members.family().log_width;
  for (int round = 0; round < kRounds; ++round) {
    const double before = best.evidence;
    for (std::size_t parameter = 0; parameter < width.size(); ++parameter) {
      best = members.Improve(parameter, width[parameter], std::move(best));
      width[parameter] /= kNarrower;
    }
    if (best.evidence - before < kWorth) break;
  }
  return best;
}

}  // namespace levitas::diagnosis
