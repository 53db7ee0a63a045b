#include "controller/synchronous/influence_estimate.hpp"

#include <cmath>
#include <utility>

namespace levitas::synchronous {
namespace {

using Complex = std::complex<double>;

Complex Times(const Complex& a, const Complex& b) noexcept {
  // The operator of the library also asks whether the result is infinite.
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

Complex At(const ComplexMatrix& m, std::size_t to, std::size_t from) noexcept {
  return {m.real[to][from], m.imaginary[to][from]};
}

void Put(ComplexMatrix& m, std::size_t to, std::size_t from, const Complex& value) noexcept {
  m.real[to][from] = value.real();
  m.imaginary[to][from] = value.imag();
}

ComplexMatrix Identity(std::size_t axes) noexcept {
  ComplexMatrix made;
  for (std::size_t i = 0; i < axes; ++i) made.real[i][i] = 1.0;
  return made;
}

}  // namespace

InfluenceEstimate::InfluenceEstimate(std::size_t axes, double period_s,
                                     double least_change_m) noexcept
    : axes_(axes),
      period_s_(period_s),
      least_change_m_(least_change_m),
      answer_(Identity(axes)),
      correct_(Identity(axes)) {}

void InfluenceEstimate::Reset() noexcept {
  Restart();
  answer_ = correct_ = Identity(axes_);
  learned_ = refused_ = 0;
  fresh_ = false;
}

void InfluenceEstimate::Restart() noexcept {
  sum_ = {};
  turned_ = samples_ = 0.0;
  has_before_ = false;
  windows_ = 0;
}

void InfluenceEstimate::Observe(const InverseLanes& inverse, const UnitPhasor& phasor, double turns,
                                const AxisArray& error, const NotchState& state) noexcept {
  const double cosine = 2.0 * phasor.cosine;
  const double sine = 2.0 * phasor.sine;
  for (std::size_t i = 0; i < axes_; ++i) {
    sum_.error_real[i] += error[i] * cosine;
    sum_.error_imaginary[i] -= error[i] * sine;
    sum_.given_real[i] += state.real[i];
    sum_.given_imaginary[i] += state.imaginary[i];
  }
  samples_ += 1.0;
  const double whole_before = std::floor(turned_);
  turned_ += turns;
  const bool whole = std::floor(turned_) > whole_before;
  if (whole && turned_ >= kTurns && samples_ * period_s_ >= kLeastS) EndWindow(inverse);
}

void InfluenceEstimate::EndWindow(const InverseLanes& inverse) noexcept {
  Means mean = sum_;
  double change2 = 0.0;
  for (std::size_t i = 0; i < axes_; ++i) {
    mean.error_real[i] /= samples_;
    mean.error_imaginary[i] /= samples_;
    mean.given_real[i] /= samples_;
    mean.given_imaginary[i] /= samples_;
    const double re = mean.error_real[i] - before_.error_real[i];
    const double im = mean.error_imaginary[i] - before_.error_imaginary[i];
    change2 += re * re + im * im;
  }
  const Means before = std::exchange(before_, mean);
  const double pace = turned_ / samples_;
  const double pace_before = std::exchange(turns_per_sample_, pace);
  const bool steady = std::abs(pace - pace_before) <= kSteady * pace;
  const bool pair = std::exchange(has_before_, true) && steady;
  sum_ = {};
  turned_ = samples_ = 0.0;
  ++windows_;
  if (!pair || !(change2 >= least_change_m_ * least_change_m_)) return;

  std::array<Complex, kMaxAxes> step{};    // c_1 - c_0
  std::array<Complex, kMaxAxes> answer{};  // w, then w - A dc
  double step2 = 0.0;
  for (std::size_t i = 0; i < axes_; ++i) {
    step[i] = {mean.given_real[i] - before.given_real[i],
               mean.given_imaginary[i] - before.given_imaginary[i]};
    step2 += std::norm(step[i]);
  }
  double answer2 = 0.0;
  for (std::size_t to = 0; to < axes_; ++to) {
    for (std::size_t from = 0; from < axes_; ++from) {
      const Complex change{mean.error_real[from] - before.error_real[from],
                           mean.error_imaginary[from] - before.error_imaginary[from]};
      answer[to] -= Times({inverse.real[from][to], inverse.imaginary[from][to]}, change);
    }
    answer2 += std::norm(answer[to]);
    for (std::size_t from = 0; from < axes_; ++from) {
      answer[to] -= Times(At(answer_, to, from), step[from]);
    }
  }
  const double damped2 = step2 + answer2 * least_change_m_ * least_change_m_ / change2;
  if (!(damped2 > 0.0)) return;
  Take(answer, step, damped2);
}

// A + answer step^H / damped2, unless it is out of bounds.
void InfluenceEstimate::Take(const std::array<Complex, kMaxAxes>& answer,
                             const std::array<Complex, kMaxAxes>& step, double damped2) noexcept {
  ComplexMatrix tried = answer_;
  bool within = true;
  for (std::size_t to = 0; to < axes_; ++to) {
    for (std::size_t from = 0; from < axes_; ++from) {
      const Complex value =
          At(answer_, to, from) + Times(answer[to], std::conj(step[from])) / damped2;
      Put(tried, to, from, value);
      const Complex off = value - (to == from ? 1.0 : 0.0);
      within = within && std::norm(off) <= kMost * kMost;  // false for what is no number
    }
  }
  ComplexMatrix inverted;
  if (!within || !Invert(tried, inverted)) {
    ++refused_;
    return;
  }
  answer_ = tried;
  correct_ = inverted;
  ++learned_;
  fresh_ = false;
}

// Gauss-Jordan with row exchange; false where a pivot is as good as none, or an element too large.
bool InfluenceEstimate::Invert(const ComplexMatrix& answer, ComplexMatrix& inverse) const noexcept {
  constexpr double kSmallestPivot = 1e-3;  // of a matrix that is I when all is right
  ComplexMatrix left = answer;
  inverse = Identity(axes_);
  for (std::size_t k = 0; k < axes_; ++k) {
    std::size_t best = k;
    for (std::size_t row = k + 1; row < axes_; ++row) {
      if (std::norm(At(left, row, k)) > std::norm(At(left, best, k))) best = row;
    }
    std::swap(left.real[k], left.real[best]);
    std::swap(left.imaginary[k], left.imaginary[best]);
    std::swap(inverse.real[k], inverse.real[best]);
    std::swap(inverse.imaginary[k], inverse.imaginary[best]);
    const double pivot2 = std::norm(At(left, k, k));
    if (!(pivot2 >= kSmallestPivot * kSmallestPivot)) return false;
    const Complex scale = std::conj(At(left, k, k)) / pivot2;
    for (std::size_t j = 0; j < axes_; ++j) {
      Put(left, k, j, Times(scale, At(left, k, j)));
      Put(inverse, k, j, Times(scale, At(inverse, k, j)));
    }
    for (std::size_t row = 0; row < axes_; ++row) {
      if (row == k) continue;
      const Complex factor = At(left, row, k);
      for (std::size_t j = 0; j < axes_; ++j) {
        Put(left, row, j, At(left, row, j) - Times(factor, At(left, k, j)));
        Put(inverse, row, j, At(inverse, row, j) - Times(factor, At(inverse, k, j)));
      }
    }
  }
  for (std::size_t to = 0; to < axes_; ++to) {
    for (std::size_t from = 0; from < axes_; ++from) {
      if (!(std::norm(At(inverse, to, from)) <= kFastest * kFastest)) return false;
    }
  }
  return true;
}

const InverseLanes& InfluenceEstimate::Corrected(const InverseLanes& inverse) noexcept {
  if (learned_ == 0) return inverse;
  if (fresh_ && of_ == &inverse) return corrected_;
  corrected_ = {};
  for (std::size_t from = 0; from < axes_; ++from) {
    for (std::size_t to = 0; to < axes_; ++to) {
      Complex sum;
      for (std::size_t via = 0; via < axes_; ++via) {
        sum +=
            Times(At(correct_, to, via), {inverse.real[from][via], inverse.imaginary[from][via]});
      }
      corrected_.real[from][to] = sum.real();
      corrected_.imaginary[from][to] = sum.imag();
    }
  }
  of_ = &inverse;
  fresh_ = true;
  return corrected_;
}

}  // namespace levitas::synchronous
