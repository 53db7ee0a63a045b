#include "design/pid/loop_survey.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/two_pi.hpp"
#include "design/pid/survey_samples.hpp"
#include "numerics/dense/eigenvalues.hpp"

namespace levitas::design {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double kTurn = 0.7;  // rad
constexpr double kNarrowest = 1e-7;
constexpr std::size_t kMostPoints = 3000;
constexpr double kLeastHz = 1.0;     // of an oscillating pole
constexpr double kMostDamped = 0.3;  // more needs no bound
constexpr double kClose = 2e-4;      // step after which Newton's next is far below it

Complex Ratio(Complex a, Complex b) {
  const double norm = std::norm(b);
  return {(a.real() * b.real() + a.imag() * b.imag()) / norm,
          (a.imag() * b.real() - a.real() * b.imag()) / norm};
}

Complex Through(const law::Section& s, Complex q, Complex value) {
  return Ratio(value * (s.b0 + q * (s.b1 + q * s.b2)), 1.0 + q * (s.a1 + q * s.a2));
}

template <int N>
class Loop {
 public:
  using Matrix = Eigen::Matrix < Complex, N, N, 0,
        N < 0 ? static_cast<int>(kMaxAxes) : N, N<0 ? static_cast<int>(kMaxAxes) : N>;

  Loop(const SampledPlant& plant, const std::vector<law::DiscreteLaw>& laws,
       const std::vector<double>& noise_m)
      : plant_(plant), laws_(laws), noise_m_(noise_m) {
    // x and y of a bearing mostly have one law: evaluated once.
    for (std::size_t i = 0; i < laws.size(); ++i) {
      const bool again = i > 0 && Same(laws[i], laws[i - 1]);
      same_as_last_.push_back(again);
    }
    if (const Coordinates& other = plant.coordinates(); !other.empty()) {
      channels_ = true;
      to_channels_ = other.measure.cast<Complex>();
      to_axes_ = other.measure.inverse().cast<Complex>();
      drive_ = other.drive.cast<Complex>();
      from_coils_ = other.drive.inverse().cast<Complex>();
    }
  }

  LoopSurvey Run() {
    samples_.clear();
    for (const auto& point : plant_.grid()) samples_.push_back(At(point));
    Refine();
    LoopSurvey out;
    const int outside = AddPoles(out);
    Refine();
    out.growing =
        std::max(outside, plant_.growing() -
                              static_cast<int>(std::lround(Turned(samples_) / std::numbers::pi)));
    out.sensitivity = LargestOf(samples_, &Sample::sensitivity);
    out.complementary = LargestOf(samples_, &Sample::complementary);
    out.current_per_metre = LargestOf(samples_, &Sample::current_per_metre);
    out.metre_per_newton = LargestOf(samples_, &Sample::metre_per_newton);
    AddSingular(out);
    AddNoise(samples_, laws_.size(), out);
    return out;
  }

 private:
  static bool Same(const law::DiscreteLaw& a, const law::DiscreteLaw& b) {
    const auto alike = [](const law::Section& s, const law::Section& t) {
      return s.b0 == t.b0 && s.b1 == t.b1 && s.b2 == t.b2 && s.a1 == t.a1 && s.a2 == t.a2;
    };
    return a.pid.proportional_a_per_m == b.pid.proportional_a_per_m &&
           a.pid.integral_a_per_m == b.pid.integral_a_per_m &&
           a.pid.derivative_a_per_m == b.pid.derivative_a_per_m &&
           a.pid.derivative_pole == b.pid.derivative_pole &&
           std::ranges::equal(a.lead_lags, b.lead_lags, alike) &&
           std::ranges::equal(a.notches, b.notches, alike);
  }

  struct Factors {
    std::array<Complex, kMaxAxes> taken_out{}, law{};
  };

  /// (I + P C) with the columns of integrating axes times 1 - q.
  Matrix Return(Complex q, const AxisMatrix& plant, Factors& at) const {
    const auto n = static_cast<Index>(laws_.size());
    Matrix m(n, n);
    LawValue last;
    for (Index i = 0; i < n; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      if (!same_as_last_[axis]) last = ValueAt(laws_[axis], q);
      at.law[axis] = last.value;
      at.taken_out[axis] = last.integrates ? 1.0 - q : Complex(1.0);
      for (Index k = 0; k < n; ++k) m(k, i) = plant(k, i) * last.value;
      m(i, i) += at.taken_out[axis];
    }
    return m;
  }

  Sample At(const SampledPoint& point) const {
    const auto n = static_cast<Index>(laws_.size());
    Factors factors;
    const Matrix m = Return(std::conj(point.z), point.plant, factors);
    Sample out;
    out.hz = point.hz;
    out.determinant = m.determinant();
    const AxisLoop loop = AxesOf(m.inverse(), factors);
    AddCompliance(point.plant, loop.sensitivity, out);
    for (Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (Index k = 0; k < n; ++k) {
        const double noise = std::norm(noise_m_[static_cast<std::size_t>(k)]);
        const Complex s = loop.sensitivity(i, k);
        const double current = std::norm(loop.control(i, k));
        const double passed = std::norm((i == k ? 1.0 : 0.0) - s);
        out.frobenius += std::norm(s);
        out.current[at] += current * noise;
        out.position[at] += passed * noise;
        if (i != k) continue;
        out.sensitivity = std::max(out.sensitivity, std::sqrt(std::norm(s)));
        out.complementary = std::max(out.complementary, std::sqrt(passed));
        out.current_per_metre = std::max(out.current_per_metre, std::sqrt(current));
      }
    }
    out.frobenius = std::sqrt(out.frobenius);
    return out;
  }

  /// S and C S between the axes, from the inverse of what Return gives.
  struct AxisLoop {
    Matrix sensitivity, control;
  };
  AxisLoop AxesOf(const Matrix& inverse, const Factors& factors) const {
    AxisLoop out{inverse, inverse};
    for (Index i = 0; i < inverse.rows(); ++i) {
      out.sensitivity.row(i) *= factors.taken_out[static_cast<std::size_t>(i)];
      out.control.row(i) *= factors.law[static_cast<std::size_t>(i)];
    }
    if (!channels_) return out;
    return {to_axes_ * out.sensitivity * to_channels_, drive_ * out.control * to_channels_};
  }

  void AddCompliance(const AxisMatrix& plant, const Matrix& sensitivity, Sample& out) const {
    Matrix between = plant;
    if (channels_) between = to_axes_ * between * from_coils_;
    for (Index i = 0; i < sensitivity.rows(); ++i) {
      const auto axis = static_cast<std::size_t>(i);
      Complex moved = 0.0;
      for (Index k = 0; k < sensitivity.cols(); ++k) moved += sensitivity(i, k) * between(k, i);
      const double per_newton = std::abs(moved) / std::abs(plant_.current_n_per_a()[axis]);
      out.metre_per_newton = std::max(out.metre_per_newton, per_newton);
    }
  }

  /// Points between neighbours whose determinants point apart.
  void Refine() {
    std::vector<Sample> out{samples_.front()};
    std::vector<Sample> ahead(samples_.rbegin(), samples_.rend() - 1);
    while (!ahead.empty()) {
      const Sample& left = out.back();
      const Sample& right = ahead.back();
      const bool narrow = right.hz - left.hz < kNarrowest * right.hz;
      if (std::abs(Turn(left, right)) > kTurn && !narrow && out.size() < kMostPoints) {
        ahead.push_back(At(plant_.AtHz(0.5 * (left.hz + right.hz))));
        continue;
      }
      out.push_back(right);
      ahead.pop_back();
    }
    samples_ = std::move(out);
  }

  [[nodiscard]] Matrix MatrixAt(Complex s) const {
    Factors factors;
    const Complex z = std::exp(s * plant_.period_s());
    return Return(1.0 / z, plant_.At(z), factors);
  }

  /// The two largest eigenvalues of X = M^-1 dM/ds, taken as if there were no others: near a pole
  /// of the loop 1/(s - pole), near two both.
  [[nodiscard]] std::pair<Complex, Complex> Nearness(Complex s) const {
    const Complex step(0.0, 1e-5 * std::abs(s));
    const Matrix below = MatrixAt(s - step);
    const Matrix above = MatrixAt(s + step);
    const Matrix middle = 0.5 * (below + above);
    const Matrix x = middle.inverse() * ((above - below) / (2.0 * step));
    const Complex sum = x.trace();
    if (x.rows() == 1) return {sum, 0.0};
    const Complex squares = x.cwiseProduct(x.transpose()).sum();
    const Complex root = std::sqrt(2.0 * squares - sum * sum);
    const Complex a = 0.5 * (sum + root);
    const Complex b = 0.5 * (sum - root);
    return std::norm(a) > std::norm(b) ? std::pair(a, b) : std::pair(b, a);
  }

  /// From s to the pole of the loop beside it; false when there is none.
  bool Approach(Complex& s) const {
    for (int turn = 0; turn < 5; ++turn) {
      const Complex nearness = Nearness(s).first;
      if (!(std::norm(nearness) > 0.0)) return false;
      const Complex by = Ratio(1.0, nearness);
      s -= by;
      if (!(std::abs(by) < 0.5 * std::abs(s)) || !(s.imag() > 0.0)) return false;
      if (-s.real() > kMostDamped * std::abs(s)) return false;
      if (std::abs(by) < kClose * std::abs(s)) return true;
    }
    return false;
  }

  /// Poles near the axis, each met by points of its own; returns how many lie beyond it.
  int AddPoles(LoopSurvey& out) {
    std::vector<Complex> found;
    for (std::size_t i = 1; i + 1 < samples_.size(); ++i) {
      const double here = std::norm(samples_[i].determinant);
      const bool lowest = here < std::norm(samples_[i - 1].determinant) &&
                          here < std::norm(samples_[i + 1].determinant);
      if (!lowest || samples_[i].hz < kLeastHz) continue;
      const Complex s(0.0, kTwoPi * samples_[i].hz);
      const auto [first, second] = Nearness(s);
      for (const Complex& nearness : {first, second}) {
        if (!(std::abs(nearness * s) > 3.0)) continue;
        Complex pole = s - Ratio(1.0, nearness);
        if (-pole.real() < kMostDamped * std::abs(pole) && Approach(pole)) found.push_back(pole);
      }
    }
    for (const LightMode& mode : plant_.light_modes()) AddLight(mode, found);
    return TakePoles(found, out);
  }

  /// Where the loop moves a mode of the plant, to first order: met even where pole and zero of the
  /// determinant are too close to be seen from the axis. z = eig(L - B C (1 + P' C)^-1 O).
  void AddLight(const LightMode& mode, std::vector<Complex>& found) const {
    constexpr double kNear = 0.01;
    if (mode.poles.size() > 2) return;
    Factors factors;
    const Matrix rest = Return(1.0 / mode.z, mode.others, factors).inverse();
    const auto k = static_cast<Index>(mode.poles.size());
    Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2> moved(k, k);
    // C (1 + P' C)^-1: the factors that were taken out cancel.
    for (Index a = 0; a < k; ++a)
      for (Index b = 0; b < k; ++b) {
        Complex sum = a == b ? mode.poles[static_cast<std::size_t>(a)] : 0.0;
        for (Index i = 0; i < rest.rows(); ++i) {
          Complex through = 0.0;
          for (Index j = 0; j < rest.cols(); ++j) through += rest(i, j) * mode.output(j, b);
          sum -= mode.input(a, i) * factors.law[static_cast<std::size_t>(i)] * through;
        }
        moved(a, b) = sum;
      }
    std::array<Complex, 2> z{moved(0, 0), moved(0, 0)};
    if (k == 2) {
      const Complex middle = 0.5 * (moved(0, 0) + moved(1, 1));
      const Complex half = 0.5 * (moved(0, 0) - moved(1, 1));
      const Complex root = std::sqrt(half * half + moved(0, 1) * moved(1, 0));
      z = {middle + root, middle - root};
    }
    for (Index a = 0; a < k; ++a) {
      const Complex s = std::log(z[static_cast<std::size_t>(a)]) / plant_.period_s();
      const Complex from = std::log(mode.z) / plant_.period_s();
      if (std::abs(s - from) < kNear * std::abs(from)) found.push_back(s);
    }
  }

  int TakePoles(const std::vector<Complex>& found, LoopSurvey& out) {
    constexpr double kNarrow = 1e-6;
    constexpr double kSame = 1e-3;
    constexpr double kSeenByGrid = 0.05;
    const double last_hz = 0.5 / plant_.period_s();
    out.damping = {1.0, 0.0};
    std::vector<double> at_hz;
    int outside = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Complex s = found[i];
      const double damping = -s.real() / std::abs(s);
      const double hz = s.imag() / kTwoPi;
      if (!(hz > kLeastHz) || hz > last_hz || std::abs(damping) > kMostDamped) continue;
      const auto same = [&](const Complex& other) {
        return std::abs(other - s) < kSame * std::abs(s);
      };
      if (std::any_of(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(i), same))
        continue;
      if (damping < 0.0) ++outside;
      if (damping < out.damping.value) out.damping = {damping, hz};
      for (const double widths : {-1.5, -0.5, 0.0, 0.5, 1.5}) {
        if (widths != 0.0 && damping > kSeenByGrid) continue;
        at_hz.push_back(hz * (1.0 + widths * std::max(std::abs(damping), kNarrow)));
      }
    }
    Insert(at_hz);
    return outside;
  }

  void Insert(std::vector<double>& hz) {
    for (const double at : hz)
      if (at > 0.0 && at < 0.5 / plant_.period_s()) samples_.push_back(At(plant_.AtHz(at)));
    std::sort(samples_.begin(), samples_.end(),
              [](const Sample& a, const Sample& b) { return a.hz < b.hz; });
  }

  void AddSingular(LoopSurvey& out) const {
    for (const Sample& sample : samples_) {
      if (sample.frobenius <= out.singular.value) continue;
      const SampledPoint point = plant_.AtHz(sample.hz);
      Factors factors;
      const Matrix inverse = Return(std::conj(point.z), point.plant, factors).inverse();
      const double size = std::sqrt(PowerOf(AxesOf(inverse, factors).sensitivity));
      if (size > out.singular.value) out.singular = {size, sample.hz};
    }
  }

  /// Largest eigenvalue of S* S by squaring it: (S* S)^32's trace to 1/32.
  static double PowerOf(const Matrix& s) {
    Matrix gram = s.adjoint() * s;
    double scale = 1.0;
    double power = 1.0;
    for (int turn = 0; turn < 6; ++turn) {
      const double size = gram.trace().real();
      scale *= std::pow(size, power);
      gram /= size;
      const Matrix squared = gram * gram;
      gram = squared;
      power *= 0.5;
    }
    return scale * std::pow(gram.trace().real(), power);
  }

  const SampledPlant& plant_;
  const std::vector<law::DiscreteLaw>& laws_;
  const std::vector<double>& noise_m_;
  bool channels_{};
  Matrix to_channels_, to_axes_, drive_, from_coils_;
  std::vector<bool> same_as_last_;
  std::vector<Sample> samples_;
};

}  // namespace

LawValue ValueAt(const law::DiscreteLaw& law, Complex q) {
  const auto& pid = law.pid;
  LawValue out;
  out.integrates = pid.integral_a_per_m != 0.0;
  out.value = pid.proportional_a_per_m +
              Ratio(pid.derivative_a_per_m * (1.0 - q), 1.0 + pid.derivative_pole * q);
  if (out.integrates) out.value = out.value * (1.0 - q) + pid.integral_a_per_m * (1.0 + q);
  for (const auto& section : law.lead_lags) out.value = Through(section, q, out.value);
  for (const auto& section : law.notches) out.value = Through(section, q, out.value);
  return out;
}

AxisMatrix ControllerAt(const std::vector<law::DiscreteLaw>& laws, Complex q,
                        const Coordinates& coordinates) {
  const auto n = static_cast<Index>(laws.size());
  AxisMatrix out = AxisMatrix::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    const LawValue law = ValueAt(laws[static_cast<std::size_t>(i)], q);
    out(i, i) = law.integrates ? law.value / (1.0 - q) : law.value;
  }
  if (coordinates.empty()) return out;
  return coordinates.drive * out * coordinates.measure;
}

LoopSurvey Survey(const SampledPlant& plant, const std::vector<law::DiscreteLaw>& laws,
                  const std::vector<double>& noise_m) {
  if (laws.size() == 4) return Loop<4>(plant, laws, noise_m).Run();
  if (laws.size() == 1) return Loop<1>(plant, laws, noise_m).Run();
  return Loop<Eigen::Dynamic>(plant, laws, noise_m).Run();
}

}  // namespace levitas::design
