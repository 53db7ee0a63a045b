#include "identification/modal/stabilisation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "identification/modal/mode_scan.hpp"
#include "numerics/factors/factors.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

constexpr double kSameFrequency = 0.005;
constexpr double kSameDamping = 0.005;
constexpr double kMostDamping = 0.02;
constexpr double kRelative = 0.1;
/// A mode and the skirts of its neighbours.
constexpr std::size_t kLowestOrder = 3;
/// A band reaches beyond its middle by this factor on either side; middles span kMiddle.
constexpr double kOverlap = 1.15;
constexpr double kMiddle = 1.4;

/// Part of the spectrum that is fitted by itself; modes are taken from its middle.
struct Band {
  double low_hz, high_hz;
  [[nodiscard]] double middle_low_hz() const { return low_hz * kOverlap; }
  [[nodiscard]] double middle_high_hz() const { return high_hz / kOverlap; }
};

/// Sum over the responses of T - S^H R^-1 S: what the denominator alone has to explain.
/// Kept in parts, whose leading blocks serve every lower order.
struct Normal {
  std::vector<Eigen::MatrixXcd> R, S, T;
};

Normal Assemble(const FrequencyResponse& r, const Band& band, std::size_t highest_order) {
  const auto size = static_cast<Index>(highest_order) + 1;
  Normal normal;
  for (Index i = 0; i < r.axes(); ++i) {
    for (Index j = i % 2; j < r.axes(); j += 2) {  // within a plane
      Eigen::MatrixXcd R = Eigen::MatrixXcd::Zero(size, size);
      Eigen::MatrixXcd S = R;
      Eigen::MatrixXcd T = R;
      Eigen::VectorXcd x(size);
      for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
        const double f = r.frequency_hz[k];
        if (f < band.low_hz || f > band.high_hz) continue;
        // Relative where the noise allows: else the strongest lines outweigh every mode.
        const double w = 1.0 / std::sqrt(r.variance[k](i, j) +
                                         kRelative * kRelative * std::norm(r.plant[k](i, j)));
        const Complex z =
            std::polar(1.0, std::numbers::pi * (f - band.low_hz) / (band.high_hz - band.low_hz));
        Complex power = w;
        for (Index n = 0; n < size; ++n, power *= z) x[n] = power;
        const Complex h = r.plant[k](i, j);
        const Eigen::MatrixXcd outer = x.conjugate() * x.transpose();
        R += outer;
        S -= h * outer;
        T += std::norm(h) * outer;
      }
      normal.R.push_back(std::move(R));
      normal.S.push_back(std::move(S));
      normal.T.push_back(std::move(T));
    }
  }
  return normal;
}

std::vector<Complex> Roots(const Eigen::VectorXcd& coefficients) {
  const Index n = coefficients.size() - 1;
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(n, n);
  companion.bottomLeftCorner(n - 1, n - 1).setIdentity();
  companion.col(n - 1) = -coefficients.head(n) / coefficients[n];
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(companion, false);
  return {solver.eigenvalues().data(), solver.eigenvalues().data() + n};
}

/// Denominator a_0 = 1, a_1 .. a_n of one order.
Eigen::VectorXcd Denominator(const Normal& normal, Index order) {
  const Index size = order + 1;
  Eigen::MatrixXcd m = Eigen::MatrixXcd::Zero(size, size);
  for (std::size_t o = 0; o < normal.R.size(); ++o) {
    const Eigen::MatrixXcd R = normal.R[o].topLeftCorner(size, size);
    const Eigen::MatrixXcd S = normal.S[o].topLeftCorner(size, size);
    m += normal.T[o].topLeftCorner(size, size) - S.adjoint() * R.ldlt().solve(S);
  }
  Eigen::VectorXcd a(size);
  a[0] = 1.0;
  const Eigen::MatrixXcd rest = m.bottomRightCorner(order, order);
  const Eigen::VectorXcd right = -m.col(0).tail(order);
  a.tail(order) = rest.ldlt().solve(right);
  return a;
}

std::vector<OrderPole> PolesOf(const Normal& normal, std::size_t order, const Band& band) {
  std::vector<OrderPole> poles;
  const Complex j(0.0, 1.0);
  for (const Complex z : Roots(Denominator(normal, static_cast<Index>(order)))) {
    // ln z = j pi (f - low)/(high - low) with a complex frequency f = s/(2 pi j).
    const Complex f =
        band.low_hz + std::log(z) * (band.high_hz - band.low_hz) / (j * std::numbers::pi);
    // Noise may push a weakly damped pole across the circle: what counts is how near it is.
    const double damping = std::abs(f.imag()) / std::abs(f);
    if (f.real() < band.middle_low_hz() || f.real() > band.middle_high_hz()) continue;
    if (damping > kMostDamping) continue;
    poles.push_back({order, std::abs(f), damping, false});
  }
  return poles;
}

void MarkStable(const std::vector<OrderPole>& before, std::vector<OrderPole>& poles) {
  for (OrderPole& pole : poles) {
    pole.stable = std::ranges::any_of(before, [&](const OrderPole& other) {
      return std::abs(other.frequency_hz - pole.frequency_hz) <
                 kSameFrequency * pole.frequency_hz &&
             std::abs(other.damping_ratio - pole.damping_ratio) < kSameDamping;
    });
  }
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Groups stable poles by frequency.
std::vector<ProposedMode> Propose(const std::vector<OrderPole>& all, std::size_t orders) {
  std::vector<OrderPole> stable;
  std::ranges::copy_if(all, std::back_inserter(stable), &OrderPole::stable);
  std::ranges::sort(stable, {}, &OrderPole::frequency_hz);
  std::vector<ProposedMode> modes;
  for (std::size_t first = 0; first < stable.size();) {
    std::size_t last = first + 1;
    while (last < stable.size() && stable[last].frequency_hz - stable[last - 1].frequency_hz <
                                       kSameFrequency * stable[last].frequency_hz) {
      ++last;
    }
    const double share = static_cast<double>(last - first) / static_cast<double>(orders);
    if (share > 0.5) {
      std::vector<double> f, damping;
      for (std::size_t i = first; i < last; ++i) {
        f.push_back(stable[i].frequency_hz);
        damping.push_back(stable[i].damping_ratio);
      }
      modes.push_back({Median(f), Median(damping), std::min(share, 1.0), 0.0});
    }
    first = last;
  }
  return modes;
}

/// A resonance of the scan confirms a stable pole nearby, or is a mode by itself.
void AddScanned(const std::vector<ScannedMode>& scanned, std::vector<ProposedMode>& modes) {
  const std::size_t stable = modes.size();
  for (const ScannedMode& mode : scanned) {
    bool known = false;
    for (std::size_t n = 0; n < stable; ++n) {
      if (std::abs(mode.frequency_hz / modes[n].frequency_hz - 1.0) > kSameMode) continue;
      modes[n].evidence = std::max(modes[n].evidence, mode.evidence);
      known = true;
    }
    if (!known) modes.push_back({mode.frequency_hz, mode.damping_ratio, 0.0, mode.evidence});
  }
  std::ranges::sort(modes, {}, &ProposedMode::frequency_hz);
}

}  // namespace

Stabilisation Stabilise(const FrequencyResponse& response, const StabilisationOptions& options) {
  Stabilisation result;
  // Middles follow one another without gap; the last reaches the end of the range.
  for (double low = options.lowest_hz / kOverlap; low * kOverlap < options.highest_hz;) {
    const Band band{low, low * kOverlap * kOverlap * kMiddle};
    const Normal normal = Assemble(response, band, options.highest_order);
    std::vector<OrderPole> all;
    // Of the two orders before: near the noise a pole alternates between odd and even ones.
    std::vector<OrderPole> before;
    std::size_t last = 0;
    for (std::size_t order = kLowestOrder; order <= options.highest_order; ++order) {
      std::vector<OrderPole> poles = PolesOf(normal, order, band);
      MarkStable(before, poles);
      all.insert(all.end(), poles.begin(), poles.end());
      before.erase(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(last));
      last = before.size();
      before.insert(before.end(), poles.begin(), poles.end());
    }
    // The first order has none before it to be stable against.
    for (const ProposedMode& mode : Propose(all, options.highest_order - kLowestOrder)) {
      const bool beyond = mode.frequency_hz > options.highest_hz;
      const bool twice =
          !result.modes.empty() && std::abs(result.modes.back().frequency_hz - mode.frequency_hz) <
                                       2.0 * kSameFrequency * mode.frequency_hz;
      if (!beyond && !twice) result.modes.push_back(mode);
    }
    result.poles.insert(result.poles.end(), all.begin(), all.end());
    low *= kMiddle;
  }
  AddScanned(ScanModes(response, options.lowest_hz, options.highest_hz), result.modes);
  return result;
}

double UsableBandHz(const FrequencyResponse& r) {
  const double tenth = std::pow(2.0, 0.1);
  double usable_hz = 0.0;
  for (double low = 20.0; low * tenth < r.frequency_hz.back(); low *= tenth) {
    double best = 0.0;
    for (Index i = 0; i < r.axes(); ++i) {
      for (Index j = i % 2; j < r.axes(); j += 2) {
        std::vector<double> ratio;
        for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
          if (r.frequency_hz[k] < low || r.frequency_hz[k] >= low * tenth) continue;
          ratio.push_back(std::abs(r.plant[k](i, j)) / std::sqrt(r.variance[k](i, j)));
        }
        if (!ratio.empty()) best = std::max(best, Median(std::move(ratio)));
      }
    }
    if (best > 2.0) usable_hz = low * tenth;
  }
  return usable_hz;
}

}  // namespace levitas::identification
