#include "identification/balance/hole_split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/two_pi.hpp"

namespace levitas::balancing {
namespace {

using Complex = std::complex<double>;

/// Share of the wanted mass that an equally good spread with less mass is worth.
constexpr double kLessMass = 1e-9;
constexpr int kSweeps = 20'000;

double AngleOf(const CorrectionPlane& plane, std::size_t hole) {
  return plane.first_hole_rad +
         kTwoPi * static_cast<double>(hole) / static_cast<double>(plane.holes);
}

double LargestOf(const CorrectionPlane& plane) {
  return plane.largest_kg > 0.0 ? plane.largest_kg : std::numeric_limits<double>::infinity();
}

Complex SumOf(const std::vector<double>& masses, const CorrectionPlane& plane) {
  Complex sum = 0.0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    sum += std::polar(masses[i], AngleOf(plane, i));
  }
  return sum;
}

/// Both neighbours of the direction; of one or two holes what there is comes from Spread.
std::vector<double> BetweenNeighbours(Complex wanted_kg, const CorrectionPlane& plane) {
  std::vector<double> masses(plane.holes, 0.0);
  const double step = kTwoPi / static_cast<double>(plane.holes);
  double behind = std::fmod(std::arg(wanted_kg) - plane.first_hole_rad, kTwoPi);
  if (behind < 0.0) behind += kTwoPi;
  const auto first = static_cast<std::size_t>(behind / step) % plane.holes;
  const double past = behind - step * std::floor(behind / step);
  const double mass_kg = std::abs(wanted_kg);
  masses[first] = mass_kg * std::sin(step - past) / std::sin(step);
  masses[(first + 1) % plane.holes] = mass_kg * std::sin(past) / std::sin(step);
  return masses;
}

/// Least squares within the limits, hole by hole until nothing moves. `least_kg`: of each hole;
/// `price_kg`: what a hole has to gain to take more.
void Descend(Complex wanted_kg, const CorrectionPlane& plane, double least_kg, double price_kg,
             const std::vector<bool>& takes, std::vector<double>& masses) {
  const double largest = LargestOf(plane);
  Complex left = wanted_kg - SumOf(masses, plane);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double moved = 0.0;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      if (!takes[i]) continue;
      const Complex direction = std::polar(1.0, AngleOf(plane, i));
      const double pull = (std::conj(direction) * left).real() - price_kg;
      const double next = std::clamp(masses[i] + pull, least_kg, largest);
      left -= (next - masses[i]) * direction;
      moved += std::abs(next - masses[i]);
      masses[i] = next;
    }
    if (moved <= 1e-12 * std::abs(wanted_kg)) break;
  }
}

/// Over all holes.
std::vector<double> Spread(Complex wanted_kg, const CorrectionPlane& plane) {
  std::vector<double> masses(plane.holes, 0.0);
  const std::vector<bool> all(plane.holes, true);
  Descend(wanted_kg, plane, 0.0, kLessMass * std::abs(wanted_kg), all, masses);
  return masses;
}

void RaiseOrLeaveOut(Complex wanted_kg, const CorrectionPlane& plane, std::vector<double>& masses) {
  for (double& mass : masses) {
    if (mass == 0.0 || mass >= plane.smallest_kg) continue;
    mass = 0.0;
    const double without = std::abs(SumOf(masses, plane) - wanted_kg);
    mass = plane.smallest_kg;
    if (std::abs(SumOf(masses, plane) - wanted_kg) >= without) mass = 0.0;
  }
}

/// Over the holes that have a weight: none of them falls below the smallest.
void SettleKept(Complex wanted_kg, const CorrectionPlane& plane, std::vector<double>& masses) {
  std::vector<bool> kept;
  for (const double mass : masses) kept.push_back(mass != 0.0);
  Descend(wanted_kg, plane, plane.smallest_kg, 0.0, kept, masses);
}

}  // namespace

PlacedWeights PlaceWeights(Complex added_kg_m, const CorrectionPlane& plane, bool drill) {
  const double sign = drill ? -1.0 : 1.0;
  const Complex wanted_kg = sign * added_kg_m / plane.radius_m;
  PlacedWeights made;
  if (plane.holes == 0) {
    double mass_kg = std::min(std::abs(wanted_kg), LargestOf(plane));
    if (mass_kg < plane.smallest_kg) {
      mass_kg = mass_kg < 0.5 * plane.smallest_kg ? 0.0 : plane.smallest_kg;
    }
    if (mass_kg > 0.0) made.weights.push_back({0, std::arg(wanted_kg), mass_kg});
    made.moment_kg_m = sign * plane.radius_m * std::polar(mass_kg, std::arg(wanted_kg));
    return made;
  }
  std::vector<double> masses;
  if (plane.holes > 2) masses = BetweenNeighbours(wanted_kg, plane);
  const double largest = LargestOf(plane);
  if (plane.holes <= 2 || std::ranges::any_of(masses, [&](double m) { return m > largest; })) {
    masses = Spread(wanted_kg, plane);
  }
  // What rounding alone has put there is no weight.
  for (double& mass : masses) mass = mass < 1e-9 * std::abs(wanted_kg) ? 0.0 : mass;
  if (plane.smallest_kg > 0.0) {
    RaiseOrLeaveOut(wanted_kg, plane, masses);
    SettleKept(wanted_kg, plane, masses);
  }
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (masses[i] > 0.0) made.weights.push_back({i + 1, AngleOf(plane, i), masses[i]});
  }
  made.moment_kg_m = sign * plane.radius_m * SumOf(masses, plane);
  return made;
}

}  // namespace levitas::balancing
