#include "identification/frf/frequency_response.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <utility>

#include "common/problem.hpp"
#include "identification/frf/checks.hpp"
#include "identification/frf/spectra.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

/// A line is excited when its power is at least this share of the mean power of all lines.
constexpr double kExcitedShare = 1e-4;

Index At(std::size_t i) { return static_cast<Index>(i); }

Complex MeanOf(const std::vector<Spectrum>& periods, std::size_t line) {
  Complex sum = 0.0;
  for (const Spectrum& period : periods) sum += period[line];
  return sum / static_cast<double>(periods.size());
}

std::vector<std::size_t> ExcitedLines(const std::vector<Spectra>& all, double highest_hz) {
  const std::vector<double>& frequency_hz = all.front().frequency_hz;
  std::vector<double> mean(all.size(), 0.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Complex& line : all[i].excitation) mean[i] += std::norm(line);
    mean[i] /= static_cast<double>(frequency_hz.size());
  }
  std::vector<std::size_t> lines;
  for (std::size_t k = 0; k < frequency_hz.size() && frequency_hz[k] <= highest_hz; ++k) {
    bool excited = true;
    for (std::size_t i = 0; i < all.size(); ++i) {
      excited = excited && std::norm(all[i].excitation[k]) > kExcitedShare * mean[i];
    }
    if (excited) lines.push_back(k);
  }
  return lines;
}

/// Mean responses of one line: columns by excited axis; several experiments on one axis average.
struct LineMeans {
  Eigen::MatrixXcd g, q;
};

LineMeans Means(const std::vector<Spectra>& all, std::size_t line, Index axes) {
  LineMeans means{Eigen::MatrixXcd::Zero(axes, axes), Eigen::MatrixXcd::Zero(axes, axes)};
  Eigen::VectorXd count = Eigen::VectorXd::Zero(axes);
  for (const Spectra& spectra : all) {
    const Index j = At(spectra.axis);
    count[j] += 1.0;
    for (Index i = 0; i < axes; ++i) {
      const auto channel = static_cast<std::size_t>(i);
      means.g(i, j) += MeanOf(spectra.position[channel], line) / spectra.excitation[line];
      means.q(i, j) += MeanOf(spectra.current[channel], line) / spectra.excitation[line];
    }
  }
  means.g *= count.cwiseInverse().asDiagonal();
  means.q *= count.cwiseInverse().asDiagonal();
  return means;
}

/// Power of what does not repeat, per output and experiment: |r|^2 / (M (M - 1)), the variance of
/// the mean over the periods.
Eigen::MatrixXd NoisePower(const std::vector<Spectra>& all, std::size_t line,
                           const Eigen::MatrixXcd& plant) {
  const Index axes = plant.rows();
  Eigen::MatrixXd power = Eigen::MatrixXd::Zero(axes, At(all.size()));
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Spectra& spectra = all[n];
    for (std::size_t m = 0; m < spectra.periods; ++m) {
      Eigen::VectorXcd dy(axes), du(axes);
      for (std::size_t i = 0; i < static_cast<std::size_t>(axes); ++i) {
        dy[At(i)] = spectra.position[i][m][line] - MeanOf(spectra.position[i], line);
        du[At(i)] = spectra.current[i][m][line] - MeanOf(spectra.current[i], line);
      }
      power.col(At(n)) += (dy - plant * du).cwiseAbs2();
    }
    const auto periods = static_cast<double>(spectra.periods);
    power.col(At(n)) /= periods * (periods - 1.0);
  }
  return power;
}

/// Power of what does not repeat in the sum behind the excited point, per experiment: one row.
Eigen::MatrixXd OwnScatter(const std::vector<Spectra>& all, std::size_t line) {
  Eigen::MatrixXd power = Eigen::MatrixXd::Zero(1, At(all.size()));
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Spectra& s = all[n];
    const std::vector<Spectrum>& sum =
        s.point == SummingPoint::kReading ? s.position[s.axis] : s.current[s.axis];
    const Complex mean = MeanOf(sum, line);
    for (const Spectrum& period : sum) power(0, At(n)) += std::norm(period[line] - mean);
    const auto periods = static_cast<double>(all[n].periods);
    power(0, At(n)) /= periods * (periods - 1.0);
  }
  return power;
}

/// Variances of the responses to each axis from the powers of its experiments: each is divided by
/// the power of its excitation on this very line, which need not be that of the lines beside it.
Eigen::MatrixXd PerExcitation(const std::vector<Spectra>& all, std::size_t line,
                              const Eigen::MatrixXd& power, Index axes) {
  Eigen::MatrixXd variance = Eigen::MatrixXd::Zero(power.rows(), axes);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(axes);
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Index j = At(all[n].axis);
    variance.col(j) += power.col(At(n)) / std::norm(all[n].excitation[line]);
    count[j] += 1.0;
  }
  for (Index j = 0; j < axes; ++j) variance.col(j) /= count[j] * count[j];
  return variance;
}

/// Share of the readings' power that repeats from period to period, over all experiments of an
/// axis together.
Eigen::MatrixXd CoherenceOf(const std::vector<Spectra>& all, std::size_t line, Index axes) {
  Eigen::MatrixXd repeats = Eigen::MatrixXd::Zero(axes, axes);
  Eigen::MatrixXd power = Eigen::MatrixXd::Zero(axes, axes);
  for (const Spectra& spectra : all) {
    const Index j = At(spectra.axis);
    for (std::size_t i = 0; i < static_cast<std::size_t>(axes); ++i) {
      for (const Spectrum& period : spectra.position[i]) power(At(i), j) += std::norm(period[line]);
      repeats(At(i), j) +=
          static_cast<double>(spectra.periods) * std::norm(MeanOf(spectra.position[i], line));
    }
  }
  return (power.array() > 0.0).select(repeats.array() / power.array(), 0.0);
}

/// Replaces each line's noise power by the mean over its neighbours.
std::vector<Eigen::MatrixXd> Smoothed(const std::vector<Eigen::MatrixXd>& power,
                                      std::ptrdiff_t neighbours) {
  std::vector<Eigen::MatrixXd> smooth;
  smooth.reserve(power.size());
  const auto count = static_cast<std::ptrdiff_t>(power.size());
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const std::ptrdiff_t low = std::max<std::ptrdiff_t>(0, k - neighbours);
    const std::ptrdiff_t high = std::min(count - 1, k + neighbours);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(power.front().rows(), power.front().cols());
    for (std::ptrdiff_t n = low; n <= high; ++n) sum += power[static_cast<std::size_t>(n)];
    smooth.push_back(sum / static_cast<double>(high - low + 1));
  }
  return smooth;
}

double MeanSquare(const std::vector<Eigen::MatrixXcd>& sensitivity, std::size_t line,
                  std::size_t neighbours, Index axis) {
  const std::size_t low = line - std::min(line, neighbours);
  const std::size_t high = std::min(sensitivity.size() - 1, line + neighbours);
  double sum = 0.0;
  for (std::size_t k = low; k <= high; ++k) sum += std::norm(sensitivity[k](axis, axis));
  return sum / static_cast<double>(high - low + 1);
}

/// What noise the loop reads reaches the sum as S_ii times it. The mean over the neighbours is too
/// low where |S_ii|^2 has a peak narrower than they are: its shape is put back, from three lines,
/// since a line alone holds the noise that is looked for.
double PeakShare(const std::vector<Eigen::MatrixXcd>& sensitivity, std::size_t line,
                 std::ptrdiff_t neighbours, Index axis) {
  return MeanSquare(sensitivity, line, 1, axis) /
         MeanSquare(sensitivity, line, static_cast<std::size_t>(neighbours), axis);
}

void FindExtremes(const session::Recording& record, const Campaign& campaign,
                  FrequencyResponse& response) {
  for (const Experiment& e : campaign.experiments) {
    std::vector<double> mean(record.axes(), 0.0);
    for (std::size_t axis = 0; axis < record.axes(); ++axis) {
      for (std::size_t row = e.begin; row < e.end(); ++row) {
        mean[axis] += record.position_m[axis][row] / static_cast<double>(e.end() - e.begin);
        response.largest_current_a =
            std::max(response.largest_current_a, std::abs(record.current_a[axis][row]));
      }
    }
    for (std::size_t x = 0; x + 1 < record.axes(); x += 2) {
      for (std::size_t row = e.begin; row < e.end(); ++row) {
        response.largest_orbit_m = std::max(
            response.largest_orbit_m, std::hypot(record.position_m[x][row] - mean[x],
                                                 record.position_m[x + 1][row] - mean[x + 1]));
      }
    }
  }
}

/// First-order, as an amplifier; 0 Hz: without limit.
std::vector<double> Passed(std::span<const double> current_a, double amplifier_hz,
                           double period_s) {
  const double pass =
      amplifier_hz > 0.0 ? 1.0 - std::exp(-2.0 * std::numbers::pi * amplifier_hz * period_s) : 1.0;
  std::vector<double> coil_a(current_a.begin(), current_a.end());
  for (std::size_t n = 1; n < coil_a.size(); ++n) {
    coil_a[n] = coil_a[n - 1] + pass * (current_a[n] - coil_a[n - 1]);
  }
  return coil_a;
}

Moments MomentsOf(const session::Recording& record, const Campaign& campaign, double amplifier_hz) {
  const Index axes = At(record.axes());
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(axes, axes);
  Moments moments{zero, zero, zero};
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(axes);
  for (const Experiment& e : campaign.experiments) {
    const std::size_t count = e.end() - e.begin;
    const auto size = static_cast<Index>(count);
    const Index j = At(e.axis);
    rows[j] += static_cast<double>(count);
    for (std::size_t axis = 0; axis < record.axes(); ++axis) {
      const auto coil_a = Passed(std::span(record.current_a[axis]).subspan(e.begin, count),
                                 amplifier_hz, record.period_s());
      const Eigen::Map<const Eigen::ArrayXd> i_a(coil_a.data(), size);
      const Eigen::Map<const Eigen::ArrayXd> x_m(&record.position_m[axis][e.begin], size);
      const Eigen::ArrayXd i = i_a - i_a.mean();
      const Eigen::ArrayXd x = x_m - x_m.mean();
      moments.current_square_a2(At(axis), j) += i.square().sum();
      moments.position_square_m2(At(axis), j) += x.square().sum();
      moments.product_a_m(At(axis), j) += (i * x).sum();
    }
  }
  for (auto* sum :
       {&moments.current_square_a2, &moments.position_square_m2, &moments.product_a_m}) {
    *sum *= rows.cwiseInverse().asDiagonal();
  }
  return moments;
}

/// Of the lines that are used: what the variances of the response follow from.
struct LineNoise {
  std::vector<std::size_t> line;
  std::vector<Eigen::MatrixXd> power, own;
  std::vector<Eigen::MatrixXcd> inverse;  ///< of the currents' response
};

void FillVariances(const std::vector<Spectra>& all, const LineNoise& noise,
                   FrequencyResponse& response) {
  const Index axes = response.axes();
  const auto smooth = Smoothed(noise.power, all.front().neighbours);
  const auto smooth_own = Smoothed(noise.own, all.front().neighbours);
  for (std::size_t k = 0; k < noise.line.size(); ++k) {
    response.noise.push_back(PerExcitation(all, noise.line[k], smooth[k], axes));
    response.variance.push_back(response.noise[k] * noise.inverse[k].cwiseAbs2());
    Eigen::VectorXd scatter = PerExcitation(all, noise.line[k], smooth_own[k], axes).row(0);
    for (Index i = 0; i < axes; ++i) {
      scatter[i] *= PeakShare(response.sensitivity, k, all.front().neighbours, i);
    }
    response.own_variance.push_back(std::move(scatter));
  }
}

}  // namespace

FrequencyResponse EstimateResponse(const session::Recording& record, const Campaign& campaign,
                                   const ResponseOptions& options) {
  FrequencyResponse response;
  response.speed_rad_per_s = campaign.speed_rad_per_s;
  response.period_s = record.period_s();
  response.channels = record.channels;
  response.point = campaign.experiments.front().point;
  const bool reading = response.point == SummingPoint::kReading;
  const bool turns = std::abs(campaign.speed_rad_per_s) > std::numbers::pi;
  std::vector<Spectra> all;
  all.reserve(campaign.experiments.size());
  response.periods = campaign.experiments.front().periods;
  for (const Experiment& e : campaign.experiments) {
    all.push_back(SpectraOf(record, e, turns ? options.orders : 0));
    response.periods = std::min(response.periods, e.periods);
  }
  LineNoise noise;
  const Index axes = response.axes();
  for (const std::size_t line : ExcitedLines(all, options.highest_hz)) {
    const double f = all.front().frequency_hz[line];
    if (all.front().near_order[line]) {
      response.left_out_hz.push_back(f);
      continue;
    }
    const LineMeans means = Means(all, line, axes);
    noise.line.push_back(line);
    noise.inverse.push_back(means.q.inverse());
    response.frequency_hz.push_back(f);
    response.plant.push_back(means.g * noise.inverse.back());
    response.currents.push_back(means.q);
    response.sensitivity.push_back(
        reading ? Eigen::MatrixXcd(Eigen::MatrixXcd::Identity(axes, axes) + means.g) : means.q);
    response.coherence.push_back(CoherenceOf(all, line, axes));
    noise.power.push_back(NoisePower(all, line, response.plant.back()));
    noise.own.push_back(OwnScatter(all, line));
  }
  if (noise.power.empty()) throw BadInput(record.name + ": no line of the spectrum is excited");
  FillVariances(all, noise, response);
  response.moments = MomentsOf(record, campaign, options.amplifier_hz);
  FindExtremes(record, campaign, response);
  return response;
}

std::vector<FrequencyResponse> EstimateResponses(const session::Recording& record, double delay_s,
                                                 const ExperimentOptions& experiment_options,
                                                 const ResponseOptions& options) {
  const auto experiments = FindExperiments(record, experiment_options);
  RefuseBadSignals(record, experiments);
  std::vector<FrequencyResponse> responses;
  for (const Campaign& campaign : GroupBySpeed(record, experiments)) {
    responses.push_back(EstimateResponse(record, campaign, options));
    RefuseWrongSigns(responses.back(), delay_s);
  }
  return responses;
}

}  // namespace levitas::identification
