#include "identification/probe/probe_characteristic.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/problem.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

/// Steps of the search for the straight range.
constexpr int kRangeSteps = 2000;
/// Standard deviations by which a place's mean may miss the cubic: some fifty places are looked at.
constexpr double kMisfitDeviations = 4.0;
/// Of a part of the way: rows nearer to each other are at one displacement.
constexpr double kSameDisplacement = 0.1;
constexpr std::size_t kCentrePlaces = 5;
/// Of a part: displacements just a part apart, as those of equal steps, are two places however they
/// were rounded.
constexpr double kRounding = 1e-6;

/// The rows of one part of the way.
struct Place {
  std::vector<std::size_t> rows;
  double displacement_m{};
  double reading{};  ///< without hysteresis
};

/// +1 and -1: the way on which each row was measured. All +1 where the table has one way.
struct Ways {
  std::vector<double> way;
  bool both{};
};

Ways WaysOf(const std::vector<double>& x_m, double turn_m) {
  Ways ways{std::vector<double>(x_m.size(), 0.0), false};
  double farthest_m = x_m.front();
  double way = 0.0;
  for (std::size_t k = 0; k < x_m.size(); ++k) {
    const double moved_m = x_m[k] - farthest_m;
    if (way == 0.0 ? std::abs(moved_m) > turn_m : way * moved_m < -turn_m) {
      way = moved_m > 0.0 ? 1.0 : -1.0;
    }
    if (way == 0.0) continue;
    if (way * moved_m > 0.0 || ways.way[k > 0 ? k - 1 : 0] != way) farthest_m = x_m[k];
    ways.way[k] = way;
  }
  const auto first = std::ranges::find_if(ways.way, [](double w) { return w != 0.0; });
  if (first != ways.way.end()) std::fill(ways.way.begin(), first, *first);
  ways.both = std::ranges::find(ways.way, 1.0) != ways.way.end() &&
              std::ranges::find(ways.way, -1.0) != ways.way.end();
  if (!ways.both) std::ranges::fill(ways.way, 1.0);
  return ways;
}

std::vector<Place> PlacesOf(const PlatformTable& table, double part_m) {
  std::vector<std::size_t> order(table.rows());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::sort(order, {}, [&](std::size_t k) { return table.displacement_m[k]; });
  std::vector<Place> places;
  for (const std::size_t k : order) {
    const bool next = places.empty() ||
                      table.displacement_m[k] - table.displacement_m[places.back().rows.front()] >=
                          (1.0 - kRounding) * part_m;
    if (next) places.emplace_back();
    places.back().rows.push_back(k);
  }
  return places;
}

/// Least squares of a table: coefficients in displacement over `scale_m`, their covariance, and the
/// residual of every row.
struct Cubic {
  double scale_m{};
  Eigen::VectorXd b;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd residual;
  double rms{};

  [[nodiscard]] Estimate Of(Index i, double factor) const {
    return {factor * b[i], factor * std::sqrt(covariance(i, i))};
  }
  /// b_i/b_1 over a power of the scale.
  [[nodiscard]] Estimate Ratio(Index i, double factor) const {
    const double ratio = b[i] / b[1];
    const double variance =
        covariance(i, i) - 2.0 * ratio * covariance(i, 1) + ratio * ratio * covariance(1, 1);
    return {factor * ratio, factor * std::sqrt(std::max(0.0, variance)) / std::abs(b[1])};
  }
};

Cubic FitCubic(const PlatformTable& table, const Ways& ways) {
  const auto rows = static_cast<Index>(table.rows());
  const Index unknowns = ways.both ? 5 : 4;
  Cubic cubic;
  for (const double x_m : table.displacement_m) {
    cubic.scale_m = std::max(cubic.scale_m, std::abs(x_m));
  }
  Eigen::MatrixXd design(rows, unknowns);
  for (Index k = 0; k < rows; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double x = table.displacement_m[at] / cubic.scale_m;
    design.row(k).head(4) << 1.0, x, x * x, x * x * x;
    if (ways.both) design(k, 4) = 0.5 * ways.way[at];
  }
  const Eigen::Map<const Eigen::VectorXd> reading(table.reading.data(), rows);
  const Eigen::MatrixXd normal = design.transpose() * design;
  const Eigen::MatrixXd inverse =
      normal.ldlt().solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  cubic.b = inverse * (design.transpose() * reading);
  cubic.residual = reading - design * cubic.b;
  const double squares = cubic.residual.squaredNorm();
  cubic.rms = std::sqrt(squares / static_cast<double>(rows));
  cubic.covariance = inverse * (squares / static_cast<double>(rows - unknowns));
  return cubic;
}

/// Mean residual of the rows of a place that were measured on `way` (0: all of them).
std::optional<double> MeanOf(const Place& place, const Cubic& cubic, const Ways& ways, double way) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const std::size_t k : place.rows) {
    if (way != 0.0 && ways.way[k] != way) continue;
    sum += cubic.residual[static_cast<Index>(k)];
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

/// Sum of squares about what the rows have in common, and what remains of their number.
struct Scatter {
  double squares{};
  std::size_t freedom{};
};

/// Of the residuals of a place's rows on one way.
Scatter ScatterOf(const Place& place, const PlatformTable& table, const Cubic& cubic,
                  const Ways& ways, double way, double part_m) {
  std::vector<double> x_m, residual;
  for (const std::size_t k : place.rows) {
    if (ways.way[k] != way) continue;
    x_m.push_back(table.displacement_m[k]);
    residual.push_back(cubic.residual[static_cast<Index>(k)]);
  }
  if (x_m.size() < 2) return {};
  const auto count = static_cast<Index>(x_m.size());
  Eigen::Map<Eigen::ArrayXd> x(x_m.data(), count), r(residual.data(), count);
  const bool apart = x.maxCoeff() - x.minCoeff() > kSameDisplacement * part_m;
  if (apart && count < 3) return {};
  x -= x.mean();
  r -= r.mean();
  if (apart) r -= (x * r).sum() / x.square().sum() * x;
  return {r.square().sum(), static_cast<std::size_t>(count) - (apart ? 2U : 1U)};
}

void Judge(const std::vector<Place>& places, const PlatformTable& table, const Cubic& cubic,
           const Ways& ways, double part_m, ProbeCharacteristic& found) {
  Scatter pooled;
  for (const Place& place : places) {
    const auto up = MeanOf(place, cubic, ways, 1.0);
    const auto down = MeanOf(place, cubic, ways, -1.0);
    if (up && down && found.hysteresis) {
      const double width = std::abs(*up - *down + found.hysteresis->value);
      found.largest_hysteresis = std::max(found.largest_hysteresis.value_or(0.0), width);
    }
    for (const double way : {1.0, -1.0}) {
      const Scatter one = ScatterOf(place, table, cubic, ways, way, part_m);
      pooled.squares += one.squares;
      pooled.freedom += one.freedom;
    }
  }
  if (pooled.freedom > 0) {
    found.repeatability = std::sqrt(pooled.squares / static_cast<double>(pooled.freedom));
    found.cubic_suffices = true;
  }
  for (const Place& place : places) {
    const double misfit = std::abs(MeanOf(place, cubic, ways, 0.0).value_or(0.0));
    found.largest_misfit = std::max(found.largest_misfit, misfit);
    if (!found.repeatability) continue;
    const double allowed = *found.repeatability / std::sqrt(static_cast<double>(place.rows.size()));
    if (misfit > kMisfitDeviations * allowed) found.cubic_suffices = false;
  }
}

void FindStraightRange(double error_m, ProbeCharacteristic& found) {
  const auto off_m = [&](double x_m) { return std::abs(found.Cubic().Read(x_m) - x_m); };
  const auto reached_m = [&](double end_m) {
    double reached = 0.0;
    for (int n = 0; n <= kRangeSteps; ++n) {
      const double x_m = end_m * n / kRangeSteps;
      if (off_m(x_m) > error_m) break;
      reached = x_m;
    }
    return reached;
  };
  found.straight_low_m = reached_m(found.low_m);
  found.straight_high_m = reached_m(found.high_m);
  for (int n = 0; n <= kRangeSteps; ++n) {
    const double x_m = found.low_m + (found.high_m - found.low_m) * n / kRangeSteps;
    found.largest_curvature_m = std::max(found.largest_curvature_m, off_m(x_m));
  }
}

/// Straight line through the places nearest to the centre.
void TakeCentreFromPlaces(std::vector<Place> places, ProbeCharacteristic& found) {
  std::ranges::sort(places, {}, [](const Place& p) { return std::abs(p.displacement_m); });
  places.resize(std::min(places.size(), kCentrePlaces));
  const auto count = static_cast<Index>(places.size());
  Eigen::ArrayXd x(count), y(count);
  for (Index i = 0; i < count; ++i) {
    x[i] = places[static_cast<std::size_t>(i)].displacement_m;
    y[i] = places[static_cast<std::size_t>(i)].reading;
  }
  const Eigen::ArrayXd from_mean = x - x.mean();
  found.points_gain = (from_mean * y).sum() / from_mean.square().sum();
  found.points_offset = y.mean() - found.points_gain * x.mean();
}

/// Means of the places without offset and hysteresis; the one at the centre is (0, 0).
void SetPoints(std::vector<Place>& places, const PlatformTable& table, const Ways& ways,
               double part_m, const std::string& name, ProbeCharacteristic& found) {
  const double half = found.hysteresis ? 0.5 * found.hysteresis->value : 0.0;
  for (Place& place : places) {
    for (const std::size_t k : place.rows) {
      place.displacement_m += table.displacement_m[k];
      place.reading += table.reading[k] - half * ways.way[k];
    }
    const auto count = static_cast<double>(place.rows.size());
    place.displacement_m /= count;
    place.reading /= count;
  }
  found.points_offset = found.offset.value;
  found.points_gain = found.gain.value;
  if (!found.cubic_suffices.value_or(true)) TakeCentreFromPlaces(places, found);
  for (Place& place : places) place.reading -= found.points_offset;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i].reading > places[i - 1].reading) continue;
    constexpr double kMicro = 1e6;
    throw BadInput(fmt::format(
        "{}: the reading does not rise from displacement {:.4g} um to {:.4g} um; allowed: a "
        "reading "
        "that rises all the way. Leave out where the probe saturates, turn the sign of the column "
        "of a probe that reads the other way round, or lower --places where noise does it",
        name, kMicro * places[i - 1].displacement_m, kMicro * places[i].displacement_m));
  }
  const double unit = found.volts ? 1.0 / found.points_gain : 1.0;
  bool centred = false;
  for (const Place& place : places) {
    const bool centre = std::abs(place.displacement_m) < 0.5 * part_m;
    if (!centred && (centre || place.displacement_m > 0.0)) {
      found.points.push_back({0.0, 0.0});
      centred = true;
    }
    if (!centre) found.points.push_back({place.displacement_m, unit * place.reading});
  }
}

}  // namespace

ProbeCharacteristic FitProbe(const PlatformTable& table, const std::string& name,
                             const ProbeFitOptions& options) {
  const auto [low, high] = std::ranges::minmax_element(table.displacement_m);
  ProbeCharacteristic found;
  found.volts = table.volts;
  found.low_m = *low;
  found.high_m = *high;
  found.rows = table.rows();
  constexpr double kMicro = 1e6;
  if (!(found.low_m < 0.0 && found.high_m > 0.0)) {
    throw BadInput(fmt::format(
        "{}: displacements run from {:.4g} to {:.4g} um; allowed: a table with the centre, 0, "
        "inside. Count the displacement from the place where the rotor is to levitate",
        name, kMicro * found.low_m, kMicro * found.high_m));
  }
  const double part_m = (found.high_m - found.low_m) / static_cast<double>(options.most_places);
  std::vector<Place> places = PlacesOf(table, part_m);
  found.places = places.size();
  if (places.size() < ProbeCharacteristic::kLeastPlaces) {
    throw BadInput(fmt::format("{}: {} places; a cubic and what it leaves need {} at least", name,
                               places.size(), ProbeCharacteristic::kLeastPlaces));
  }
  const Ways ways = WaysOf(table.displacement_m, 0.5 * part_m);
  const Cubic cubic = FitCubic(table, ways);
  found.offset = cubic.Of(0, 1.0);
  found.gain = cubic.Of(1, 1.0 / cubic.scale_m);
  found.a2 = cubic.Ratio(2, 1.0 / cubic.scale_m);
  found.a3 = cubic.Ratio(3, 1.0 / (cubic.scale_m * cubic.scale_m));
  if (ways.both) found.hysteresis = cubic.Of(4, 1.0);
  found.residual = cubic.rms;
  Judge(places, table, cubic, ways, part_m, found);
  SetPoints(places, table, ways, part_m, name, found);
  FindStraightRange(options.straight_error_m, found);
  return found;
}

}  // namespace levitas::identification
