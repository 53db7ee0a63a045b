#include "diagnosis/inference/frequency_scan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace levitas::diagnosis {
namespace {

constexpr double kReach = 4.0;         ///< tolerances, to either side
constexpr double kSpacing = 0.5;       ///< tolerances
constexpr double kWorth = 3.0;         ///< [nat] what the best of so many places has by chance
constexpr double kDampingOff = 1.0;    ///< tolerances from which a damping asks for a scan
constexpr double kFrequencyOff = 2.0;  ///< tolerances from which a frequency does
constexpr double kOtherOff = 3.0;      ///< tolerances, of numbers of which no mode has any

struct Best {
  Point point;
  double cost;
};

/// The term of the damping of the mode that has this frequency.
std::optional<std::size_t> DampingOf(const std::vector<Term>& terms, const Term& frequency) {
  const auto own = std::find_if(terms.begin(), terms.end(), [&frequency](const Term& term) {
    return term.effect == effect::Id::kModalDamping &&
           term.location.mode == frequency.location.mode;
  });
  if (own == terms.end()) return std::nullopt;
  return static_cast<std::size_t>(own - terms.begin());
}

bool IsOff(const Term& term, double theta, double tolerances) {
  return std::abs(theta - term.healthy_mean) > tolerances * term.tolerance;
}

/// True where a number that is no mode's lies far off: something acts that the model lacks, and a
/// mode elsewhere would imitate it.
bool LacksACause(const std::vector<Term>& terms, const Point& point) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto effect = terms[i].effect;
    const bool of_a_mode =
        effect == effect::Id::kModalFrequency || effect == effect::Id::kModalDamping;
    if (!of_a_mode && terms[i].nuisance() && IsOff(terms[i], point.theta[i], kOtherOff))
      return true;
  }
  return false;
}

/// Takes the point if it costs less.
void Try(const std::function<double(const Point&)>& cost, const Point& at, Best& best) {
  const double now = cost(at);
  if (now < best.cost) best = {at, now};
}

/// The best of the grid for the frequency `term`; what is left of `best` where none is better.
void ScanOne(const std::vector<Term>& terms, std::size_t term, std::optional<std::size_t> damping,
             const std::function<double(const Point&)>& cost, Best& best) {
  const double spacing = kSpacing * terms[term].tolerance;
  Point at = best.point;
  const double from = terms[term].healthy_mean - kReach * terms[term].tolerance;
  for (double steps = 0.0; steps <= 2.0 * kReach / kSpacing; steps += 1.0) {
    at.theta[term] = from + steps * spacing;
    Try(cost, at, best);
  }
  if (!damping) return;
  at = best.point;
  at.theta[*damping] = terms[*damping].healthy_mean;
  const double about = best.point.theta[term];
  for (const double steps : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    at.theta[term] = about + steps * spacing;
    Try(cost, at, best);
  }
}

}  // namespace

Point AlongFrequencies(const std::vector<Term>& terms,
                       const std::function<double(const Point&)>& cost, Point start) {
  if (LacksACause(terms, start)) return start;
  std::optional<double> own;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].effect != effect::Id::kModalFrequency || !terms[i].nuisance()) continue;
    const std::optional<std::size_t> damping = DampingOf(terms, terms[i]);
    if (!IsOff(terms[i], start.theta[i], kFrequencyOff) &&
        !(damping && IsOff(terms[*damping], start.theta[*damping], kDampingOff)))
      continue;
    if (!own) own = cost(start);
    Best best{start, *own};
    ScanOne(terms, i, damping, cost, best);
    if (!(best.cost < *own - kWorth)) continue;
    own = best.cost;
    start = std::move(best.point);
  }
  return start;
}

}  // namespace levitas::diagnosis
