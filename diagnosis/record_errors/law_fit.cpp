#include "diagnosis/record_errors/law_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace levitas::diagnosis {
namespace {

constexpr int kPositionLags = 12;  ///< after the first one
constexpr int kCurrentLags = 6;
constexpr int kTestLags = 8;
constexpr int kWindow = kMostShift + kPositionLags;  ///< rows before the present one
constexpr double kAtLimit = 0.999;
constexpr Eigen::Index kNone = -1;    ///< no test signal
constexpr double kAsLittle = 2.0;     ///< times as much left is as little
constexpr double kNothing = 1e-4;     ///< of the rms: digits of a file
constexpr double kIsExplained = 0.5;  ///< of what is left without the test signal

/// Sums of all regressors of one column of currents: subsets are solved from it.
class Sums {
 public:
  Sums(const RigView& rig, const Columns& columns, Eigen::Index current);

  /// Left over the rms with these regressors, and their coefficients.
  [[nodiscard]] double Left(const std::vector<Eigen::Index>& of,
                            Eigen::VectorXd* solution = nullptr) const;
  [[nodiscard]] Eigen::Index Position(Eigen::Index axis, int lag) const {
    return axis * per_position_ + lag + kMostShift;
  }
  [[nodiscard]] Eigen::Index Test(Eigen::Index axis, int lag) const {
    return tests_ + axis * per_test_ + lag + kMostShift;
  }
  [[nodiscard]] Eigen::Index Current(int lag) const { return currents_ + lag - 1; }
  [[nodiscard]] Eigen::Index Constant() const { return currents_ + kCurrentLags; }
  [[nodiscard]] double rows() const { return rows_; }

 private:
  static constexpr Eigen::Index per_position_ = 2 * kMostShift + kPositionLags + 1;
  static constexpr Eigen::Index per_test_ = 2 * kMostShift + kTestLags + 1;
  Eigen::Index tests_, currents_;
  Eigen::MatrixXd gram_;
  Eigen::VectorXd scale_, right_;
  double square_{}, mean_square_{};
  double rows_{};
};

std::vector<Eigen::Index> Usable(const RigView& rig, const Columns& columns, Eigen::Index current) {
  const double limit_a = kAtLimit * CurrentLimit(rig, static_cast<std::size_t>(current));
  std::vector<Eigen::Index> rows;
  Eigen::Index clean = 0;  // rows since the last one that breaks a window
  const Eigen::Index last = columns.rows() - kMostShift;
  for (Eigen::Index n = 0; n < columns.rows(); ++n) {
    const auto i = static_cast<std::size_t>(n);
    if (columns.missing[i] > 0) clean = 0;
    const double value_a = std::abs(columns.current_a(n, current));
    const bool breaks = columns.repeated[i] != 0 ||
                        (limit_a > 0.0 && value_a > limit_a && value_a < 1.01 * limit_a);
    clean = breaks ? 0 : clean + 1;
    // A position that is ahead is read up to kMostShift rows later.
    const Eigen::Index at = n - kMostShift;
    if (at < last && clean > kWindow + kMostShift) rows.push_back(at);
  }
  return rows;
}

Sums::Sums(const RigView& rig, const Columns& columns, Eigen::Index current)
    : tests_(columns.axes() * per_position_), currents_(tests_ + columns.axes() * per_test_) {
  const Eigen::Index size = currents_ + kCurrentLags + 1;
  const std::vector<Eigen::Index> usable = Usable(rig, columns, current);
  rows_ = static_cast<double>(usable.size());
  gram_ = Eigen::MatrixXd::Zero(size, size);
  right_ = Eigen::VectorXd::Zero(size);
  constexpr Eigen::Index kBlock = 256;
  Eigen::MatrixXd block(kBlock, size);
  Eigen::VectorXd target(kBlock);
  double sum = 0.0;
  for (std::size_t start = 0; start < usable.size(); start += kBlock) {
    const auto length =
        static_cast<Eigen::Index>(std::min<std::size_t>(kBlock, usable.size() - start));
    for (Eigen::Index r = 0; r < length; ++r) {
      const Eigen::Index n = usable[start + static_cast<std::size_t>(r)];
      for (Eigen::Index a = 0; a < columns.axes(); ++a) {
        for (int lag = -kMostShift; lag <= kMostShift + kPositionLags; ++lag) {
          block(r, Position(a, lag)) = columns.position_m(n - lag, a);
        }
        for (int lag = -kMostShift; lag <= kMostShift + kTestLags; ++lag) {
          block(r, Test(a, lag)) = columns.excitation_a(n - lag, a);
        }
      }
      for (int lag = 1; lag <= kCurrentLags; ++lag)
        block(r, Current(lag)) = columns.current_a(n - lag, current);
      block(r, Constant()) = 1.0;
      target[r] = columns.current_a(n, current);
    }
    const auto used = block.topRows(length);
    gram_.selfadjointView<Eigen::Lower>().rankUpdate(used.transpose());
    right_ += used.transpose() * target.head(length);
    square_ += target.head(length).squaredNorm();
    sum += target.head(length).sum();
  }
  gram_.triangularView<Eigen::StrictlyUpper>() = gram_.transpose();
  mean_square_ = square_ - (rows_ > 0.0 ? sum * sum / rows_ : 0.0);
  scale_ = gram_.diagonal().cwiseMax(1e-300).cwiseSqrt();
}

double Sums::Left(const std::vector<Eigen::Index>& of, Eigen::VectorXd* solution) const {
  constexpr double kRidge = 1e-13;
  const auto size = static_cast<Eigen::Index>(of.size());
  Eigen::MatrixXd gram(size, size);
  Eigen::VectorXd right(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Index row = of[static_cast<std::size_t>(i)];
    right[i] = right_[row] / scale_[row];
    for (Eigen::Index k = 0; k < size; ++k) {
      const Eigen::Index column = of[static_cast<std::size_t>(k)];
      gram(i, k) = gram_(row, column) / (scale_[row] * scale_[column]);
    }
    gram(i, i) += kRidge;
  }
  const Eigen::VectorXd x = gram.ldlt().solve(right);
  if (solution != nullptr) {
    *solution = x;
    for (Eigen::Index i = 0; i < size; ++i)
      (*solution)[i] /= scale_[of[static_cast<std::size_t>(i)]];
  }
  const double left = square_ - 2.0 * x.dot(right) + x.dot(gram * x);
  return mean_square_ > 0.0 ? std::sqrt(std::max(0.0, left) / mean_square_) : 1.0;
}

/// Regressors with positions of one axis from a lag on and test signals of another one.
std::vector<Eigen::Index> Chosen(const Sums& sums, Eigen::Index position, int position_from,
                                 Eigen::Index test, int test_from) {
  std::vector<Eigen::Index> of;
  for (int lag = position_from; lag <= kMostShift + kPositionLags; ++lag)
    of.push_back(sums.Position(position, lag));
  if (test != kNone) {
    for (int lag = test_from; lag <= kMostShift + kTestLags; ++lag)
      of.push_back(sums.Test(test, lag));
  }
  for (int lag = 1; lag <= kCurrentLags; ++lag) of.push_back(sums.Current(lag));
  of.push_back(sums.Constant());
  return of;
}

/// None, and the axes whose test signal is in the record.
std::vector<Eigen::Index> AxesWithTestSignal(const Columns& columns) {
  std::vector<Eigen::Index> tests{kNone};
  for (Eigen::Index a = 0; a < columns.axes(); ++a) {
    if (columns.excitation_a.col(a).cwiseAbs().maxCoeff() > 0.0) tests.push_back(a);
  }
  return tests;
}

/// The position that explains the current best; returns the test signal that goes with it.
Eigen::Index FindPosition(const Sums& sums, const std::vector<Eigen::Index>& tests,
                          Eigen::Index axes, Eigen::Index current, LawOfColumn& law) {
  Eigen::Index test = kNone;
  for (Eigen::Index p = 0; p < axes; ++p) {
    for (const Eigen::Index j : tests) {
      const double left = sums.Left(Chosen(sums, p, -kMostShift, j, -kMostShift));
      if (p == current) law.left_own = std::min(law.left_own, left);
      if (left < law.left) {
        law.left = left;
        law.position = static_cast<std::size_t>(p);
        test = j;
      }
    }
  }
  for (Eigen::Index p = 0; p < axes; ++p) {
    if (p == static_cast<Eigen::Index>(law.position)) continue;
    for (const Eigen::Index j : tests)
      law.left_second =
          std::min(law.left_second, sums.Left(Chosen(sums, p, -kMostShift, j, -kMostShift)));
  }
  return test;
}

/// How late position and test signal may be taken with as little left, and their coefficients then.
void FitShifts(const Sums& sums, Eigen::Index test, LawOfColumn& law) {
  const auto p = static_cast<Eigen::Index>(law.position);
  const double as_little = kAsLittle * std::max(law.left, kNothing);
  const auto left = [&](int from, int test_from) {
    return sums.Left(Chosen(sums, p, from, test, test_from));
  };
  law.shift = -kMostShift;
  while (law.shift < kMostShift && left(law.shift + 1, -kMostShift) < as_little) ++law.shift;
  law.test_shift = -kMostShift;
  while (test != kNone && law.test_shift < kMostShift &&
         left(law.shift, law.test_shift + 1) < as_little)
    ++law.test_shift;
  Eigen::VectorXd solution;
  static_cast<void>(sums.Left(Chosen(sums, p, law.shift, test, law.test_shift), &solution));
  law.direct_a_per_m = solution[0];
  if (test != kNone) {
    law.test = static_cast<std::size_t>(test);
    law.test_factor = solution[kMostShift + kPositionLags + 1 - law.shift];
  }
}

LawOfColumn FitColumn(const RigView& rig, const Columns& columns, Eigen::Index current) {
  LawOfColumn law;
  const Sums sums(rig, columns, current);
  if (sums.rows() < 500.0) return law;
  const std::vector<Eigen::Index> tests = AxesWithTestSignal(columns);
  Eigen::Index test = FindPosition(sums, tests, columns.axes(), current, law);
  const auto p = static_cast<Eigen::Index>(law.position);
  const double left_without = sums.Left(Chosen(sums, p, -kMostShift, kNone, 0));
  if (law.left > kIsExplained * left_without) test = kNone;
  law.known = law.left < kLawKnown;
  if (law.known) FitShifts(sums, test, law);
  return law;
}

}  // namespace

std::vector<LawOfColumn> FitLaw(const RigView& rig, const Columns& columns) {
  std::vector<LawOfColumn> laws;
  for (Eigen::Index c = 0; c < columns.axes(); ++c) laws.push_back(FitColumn(rig, columns, c));
  return laws;
}

}  // namespace levitas::diagnosis
