#include "diagnosis/record_errors/gaps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>

#include "diagnosis/model/repeated_frames.hpp"
#include "diagnosis/record_errors/columns.hpp"

namespace levitas::diagnosis {
namespace {

constexpr Eigen::Index kPositionsBack = 12, kTestsBack = 8, kCurrentsBack = 6;
constexpr std::size_t kMemory = 12;  ///< rows that a row depends on, before it
constexpr std::size_t kMostFitted = 16'000;
constexpr double kFewestFitted = 1000.0;
constexpr int kFits = 5;
constexpr double kNotFitted = 8.0;    ///< times the usual: not fitted again
constexpr double kBroken = 25.0;      ///< times the usual: a law that is broken
constexpr double kKnown = 0.01;       ///< of the rms of the currents
constexpr double kExact = 1e-5;       ///< digits of a file
constexpr double kMostBroken = 0.05;  ///< of the rows
constexpr std::size_t kListed = 3;
constexpr double kNearLimit = 0.999;

class Law {
 public:
  Law(const RigView& rig, const Record& record)
      : rig_(rig), rows_(record.rows), axes_(static_cast<Eigen::Index>(rig.axes)) {
    for (std::size_t a = 0; a < rig.axes; ++a) limit_a_.push_back(CurrentLimit(rig, a));
    FindUsable();
  }

  /// Whether the currents of all axes follow from it.
  [[nodiscard]] bool Fit();
  /// Usable rows, in order, at which it is broken.
  [[nodiscard]] std::vector<std::size_t> Broken() const;
  [[nodiscard]] std::size_t usable() const noexcept { return usable_.size(); }

 private:
  [[nodiscard]] Eigen::Index Size() const noexcept {
    return axes_ * (kPositionsBack + 1 + kTestsBack + 1 + kCurrentsBack) + 1;
  }
  void FindUsable();
  [[nodiscard]] bool IsPlain(std::size_t n) const;
  void Read(std::size_t n, Eigen::Ref<Eigen::VectorXd> regressors) const;
  [[nodiscard]] Eigen::VectorXd Current(std::size_t n) const {
    return Eigen::Map<const Eigen::VectorXd>(rows_[n].sample.command.control_current_a.data(),
                                             axes_);
  }

  const RigView& rig_;
  const std::vector<analysis::RecordedRow>& rows_;
  Eigen::Index axes_;
  std::vector<double> limit_a_;
  std::vector<std::size_t> usable_;
  Eigen::MatrixXd law_;  ///< regressors x axes
  Eigen::VectorXd usual_a_;
};

/// Whether a row is the sample after the one before it, was read anew, and is below all limits.
bool Law::IsPlain(std::size_t n) const {
  if (n == 0 || !rows_[n].levitated) return false;
  const auto& sample = rows_[n].sample;
  const auto& before = rows_[n - 1];
  if (rows_[n].cycle != before.cycle + 1) return false;
  if (Repeats(before.sample.position_m, sample.position_m, rig_.axes)) return false;
  for (std::size_t a = 0; a < rig_.axes; ++a) {
    if (!std::isfinite(sample.position_m[a])) return false;
    if (std::abs(sample.command.control_current_a[a]) >= kNearLimit * limit_a_[a]) return false;
  }
  return true;
}

void Law::FindUsable() {
  std::size_t plain = 0;
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    plain = IsPlain(n) ? plain + 1 : 0;
    if (plain > kMemory) usable_.push_back(n);
  }
}

void Law::Read(std::size_t n, Eigen::Ref<Eigen::VectorXd> regressors) const {
  Eigen::Index at = 0;
  for (std::size_t a = 0; a < rig_.axes; ++a) {
    for (std::size_t lag = 0; lag <= kPositionsBack; ++lag)
      regressors[at++] = rows_[n - lag].sample.position_m[a];
    for (std::size_t lag = 0; lag <= kTestsBack; ++lag)
      regressors[at++] = rows_[n - lag].excitation_a[a];
    for (std::size_t lag = 1; lag <= kCurrentsBack; ++lag)
      regressors[at++] = rows_[n - lag].sample.command.control_current_a[a];
  }
  regressors[at] = 1.0;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool Law::Fit() {
  std::vector<std::size_t> fitted;
  const std::size_t every = 1 + usable_.size() / kMostFitted;
  for (std::size_t i = 0; i < usable_.size(); i += every) fitted.push_back(usable_[i]);
  if (static_cast<double>(fitted.size()) < kFewestFitted) return false;
  const auto count = static_cast<Eigen::Index>(fitted.size());
  Eigen::MatrixXd regressors(Size(), count);
  Eigen::MatrixXd target(axes_, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    Read(fitted[static_cast<std::size_t>(i)], regressors.col(i));
    target.col(i) = Current(fitted[static_cast<std::size_t>(i)]);
  }
  const Eigen::VectorXd scale = regressors.rowwise().norm().cwiseMax(1e-300);
  regressors = scale.cwiseInverse().asDiagonal() * regressors;
  const Eigen::VectorXd rms_a = (target.colwise() - target.rowwise().mean()).rowwise().norm() /
                                std::sqrt(static_cast<double>(count));
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(count);
  Eigen::VectorXd before = Eigen::VectorXd::Zero(count);
  for (int fit = 0; fit < kFits && before != weight; ++fit) {
    before = weight;
    const Eigen::MatrixXd weighted = regressors * weight.asDiagonal();
    Eigen::MatrixXd gram = weighted * regressors.transpose();
    gram.diagonal().array() += 1e-13;
    const Eigen::MatrixXd solved = gram.ldlt().solve(weighted * target.transpose());
    const Eigen::MatrixXd left = (target - solved.transpose() * regressors).cwiseAbs();
    usual_a_ = Eigen::VectorXd(axes_);
    for (Eigen::Index a = 0; a < axes_; ++a) {
      const Eigen::VectorXd row = left.row(a).transpose();
      usual_a_[a] = std::max(1.48 * Median({row.begin(), row.end()}), kExact * rms_a[a]);
    }
    law_ = scale.cwiseInverse().asDiagonal() * solved;
    for (Eigen::Index i = 0; i < count; ++i) {
      weight[i] = (left.col(i).array() > kNotFitted * usual_a_.array()).any() ? 0.0 : 1.0;
    }
  }
  return (usual_a_.array() < kKnown * rms_a.array()).all();
}

std::vector<std::size_t> Law::Broken() const {
  std::vector<std::size_t> broken;
  const Eigen::Index most = std::max<Eigen::Index>(2, (axes_ + 1) / 2);
  Eigen::VectorXd regressors(Size());
  for (const std::size_t n : usable_) {
    Read(n, regressors);
    const Eigen::VectorXd left = (Current(n) - law_.transpose() * regressors).cwiseAbs();
    if ((left.array() > kBroken * usual_a_.array()).count() >= most) broken.push_back(n);
  }
  return broken;
}

}  // namespace

void FindGaps(const RigView& rig, const Record& record, std::uint64_t first_cycle,
              RecordErrors& out) {
  if (rig.axes < 2) return;
  Law law(rig, record);
  if (!law.Fit()) return;
  const std::vector<std::size_t> broken = law.Broken();
  if (static_cast<double>(broken.size()) > kMostBroken * static_cast<double>(law.usable())) return;
  std::vector<std::uint64_t> first;
  std::size_t end = 0;  // rows before it are broken by the gap that was found last
  for (const std::size_t n : broken) {
    if (n >= end) {
      first.push_back(record.rows[n].cycle);
      end = n + kMemory + 1;
    }
  }
  if (first.empty()) return;
  std::vector<std::string> places;
  for (std::size_t i = 0; i < std::min(first.size(), kListed); ++i)
    places.push_back(
        fmt::format("{:.4f} s", static_cast<double>(first[i] - first_cycle) * rig.period_s));
  out.gaps = first;
  out.errors.push_back(
      {RecordErrorKind::kGaps,
       {"time"},
       static_cast<double>(first.size()),
       kBroken,
       fmt::format(
           "rows are left out at {} place{} while the times run on: {} after the first row{}",
           first.size(), first.size() == 1 ? "" : "s", fmt::join(places, ", "),
           first.size() > kListed ? " and later" : ""),
       "times that jump where rows are missing, or one file for each piece",
       false});
}

}  // namespace levitas::diagnosis
