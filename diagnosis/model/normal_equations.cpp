#include "diagnosis/model/normal_equations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/each_in_parallel.hpp"
#include "diagnosis/model/convolve.hpp"
#include "diagnosis/model/innovation_series.hpp"
#include "diagnosis/model/levinson.hpp"

namespace levitas::diagnosis {
namespace {

/// Products of a signal with its past, by lag.
struct Products {
  std::vector<double> sum;
  double count{};

  explicit Products(std::size_t order) : sum(order + 1, 0.0) {}
  void Add(const std::vector<double>& signal, std::size_t n) {
    const std::size_t lags = std::min(sum.size(), n + 1);
    for (std::size_t k = 0; k < lags; ++k) sum[k] += signal[n] * signal[n - k];
    count += 1.0;
  }
};

/// Autoregression of one axis over uninterrupted counting samples. Their sums, with the past as it
/// is, are nearly an autocorrelation: of a loud narrow line they leave too little power, or less
/// than none. Those of a signal that is zero where it does not count are one, with blunter lines:
/// they are taken where what the two filters leave differs by more than 30 %.
std::vector<double> FilterOf(const std::vector<Trajectory>& runs, std::size_t axis,
                             std::size_t order) {
  constexpr double kAlike = 0.7;  // ratio of the rms; of noise both leave the same within 1 %
  Products counting(order);
  Products zero_filled(order);
  for (const Trajectory& run : runs) {
    std::vector<double> innovations = InnovationSeries(run, axis, 0);
    const std::vector<std::uint8_t> counts = Counting(run);
    for (std::size_t n = order; n < innovations.size(); ++n) {
      if (counts[n] != 0) counting.Add(innovations, n);
    }
    for (std::size_t n = 0; n < innovations.size(); ++n) {
      if (counts[n] == 0) innovations[n] = 0.0;
    }
    for (std::size_t n = 0; n < innovations.size(); ++n) {
      if (counts[n] != 0) zero_filled.Add(innovations, n);
    }
  }
  std::vector<double> filter = WhiteningFilter(counting.sum, counting.count);
  std::vector<double> zero_filled_filter = WhiteningFilter(zero_filled.sum, zero_filled.count);
  // A filter begins with one over the rms of what it leaves; where nothing is left, with one.
  const bool sound =
      counting.sum.front() == 0.0 || (filter.front() > zero_filled_filter.front() * kAlike &&
                                      filter.front() * kAlike < zero_filled_filter.front());
  return sound ? filter : zero_filled_filter;
}

/// [m] rms of what each axis measured about its mean in each record, of samples that count.
AxisArray MotionOf(const std::vector<Trajectory>& runs, std::size_t axes) {
  AxisArray power{};
  double count = 0.0;
  for (const Trajectory& run : runs) {
    AxisArray sum{};
    AxisArray square{};
    double here = 0.0;
    for (const SamplePoint& m : run.moments) {
      if (!m.counts) continue;
      here += 1.0;
      for (std::size_t a = 0; a < axes; ++a) {
        const auto measured = static_cast<double>(m.measured_m[a]);
        sum[a] += measured;
        square[a] += measured * measured;
      }
    }
    if (!(here > 0.0)) continue;
    count += here;
    for (std::size_t a = 0; a < axes; ++a) {
      power[a] += std::max(0.0, square[a] - sum[a] * sum[a] / here);
    }
  }
  AxisArray motion_m{};
  if (!(count > 0.0)) return motion_m;
  for (std::size_t a = 0; a < axes; ++a) motion_m[a] = std::sqrt(power[a] / count);
  return motion_m;
}

}  // namespace

Whitener MakeWhitener(const std::vector<Trajectory>& runs, std::size_t axes, std::size_t order) {
  Whitener whitener{order, {}};
  whitener.filter.resize(axes);
  EachInParallel(axes, 0, [&](std::size_t a) { whitener.filter[a] = FilterOf(runs, a, order); });
  return whitener;
}

Whitener MakeWhitener(const std::vector<Trajectory>& runs, std::size_t axes, std::size_t order,
                      double share) {
  Whitener whitener = MakeWhitener(runs, axes, order);
  const AxisArray motion_m = MotionOf(runs, axes);
  for (std::size_t a = 0; a < axes; ++a) {
    std::vector<double>& filter = whitener.filter[a];
    // The least noise over the rms of what no past explains.
    const double weight = filter.front() * share * motion_m[a];
    if (!(weight > 1.0)) continue;
    for (double& coefficient : filter) coefficient /= weight;
  }
  return whitener;
}

double SquaredSum(const std::vector<Trajectory>& runs, std::size_t axes, const Whitener& whitener,
                  std::size_t* values) {
  const std::size_t order = whitener.order;
  std::vector<double> sums(runs.size() * axes, 0.0);
  std::vector<std::size_t> counted(sums.size(), 0);
  EachInParallel(sums.size(), 0, [&](std::size_t i) {
    const Trajectory& run = runs[i / axes];
    const std::size_t a = i % axes;
    const std::size_t samples = run.moments.size();
    std::vector<double> white(samples);
    const std::vector<double> innovations = InnovationSeries(run, a, order);
    Convolve(whitener.filter[a], innovations.data() + order, samples, white.data());
    for (std::size_t n = order; n < samples; ++n) {
      if (!run.moments[n].counts) continue;
      sums[i] += white[n] * white[n];
      ++counted[i];
    }
  });
  if (values != nullptr) *values = std::accumulate(counted.begin(), counted.end(), std::size_t{0});
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace levitas::diagnosis
