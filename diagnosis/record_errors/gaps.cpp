#include "diagnosis/record_errors/gaps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "diagnosis/model/repeated_frames.hpp"
#include "diagnosis/record_errors/columns.hpp"

namespace levitas::diagnosis {
namespace {

constexpr Eigen::Index kPositionsBack = 12, kTestsBack = 8, kCurrentsBack = 8;
constexpr Eigen::Index kOfAxis = kPositionsBack + 1 + kTestsBack + 1 + kCurrentsBack;
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
  /// Rows, in order, at which it is broken; none where too many are.
  [[nodiscard]] std::vector<std::size_t> Broken() const;

 private:
  [[nodiscard]] Eigen::Index Size() const noexcept { return axes_ * kOfAxis + 1; }
  void FindUsable();
  [[nodiscard]] bool IsRead(std::size_t n) const;
  void Read(std::size_t n, Eigen::Ref<Eigen::VectorXd> regressors) const;
  [[nodiscard]] Eigen::VectorXd Current(std::size_t n) const {
    return Eigen::Map<const Eigen::VectorXd>(rows_[n].sample.command.control_current_a.data(),
                                             axes_);
  }

  const RigView& rig_;
  const std::vector<analysis::RecordedRow>& rows_;
  Eigen::Index axes_;
  std::vector<double> limit_a_;
  std::vector<std::size_t> usable_;      ///< rows whose memory is read and free of limits
  std::vector<std::size_t> read_;        ///< rows whose memory is read
  std::vector<std::vector<bool>> free_;  ///< of each of these: axes that were below their limits
  Eigen::MatrixXd law_;                  ///< regressors x axes
  Eigen::VectorXd usual_a_;
  bool between_axes_{};
};

/// Whether a row is the sample after the one before it and was read anew.
bool Law::IsRead(std::size_t n) const {
  if (n == 0 || !rows_[n].levitated) return false;
  const auto& sample = rows_[n].sample;
  const auto& before = rows_[n - 1];
  if (rows_[n].cycle != before.cycle + 1) return false;
  if (Repeats(before.sample.position_m, sample.position_m, rig_.axes)) return false;
  for (std::size_t a = 0; a < rig_.axes; ++a) {
    if (!std::isfinite(sample.position_m[a])) return false;
  }
  return true;
}

void Law::FindUsable() {
  std::size_t read = 0;
  std::vector<std::size_t> below(rig_.axes);  // rows since an axis was at its limit
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    read = IsRead(n) ? read + 1 : 0;
    for (std::size_t a = 0; a < rig_.axes; ++a) {
      const double current_a = std::abs(rows_[n].sample.command.control_current_a[a]);
      below[a] = current_a < kNearLimit * limit_a_[a] ? below[a] + 1 : 0;
    }
    if (read <= kMemory) continue;
    std::vector<bool> free(rig_.axes);
    for (std::size_t a = 0; a < rig_.axes; ++a) free[a] = below[a] > kMemory;
    if (std::ranges::all_of(free, [](bool axis) { return axis; })) usable_.push_back(n);
    read_.push_back(n);
    free_.push_back(std::move(free));
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

struct Fitted {
  Eigen::VectorXd law;
  double usual_a{};  ///< as a standard deviation
};

/// Least squares; rows that do not fit are left out, and the rest is fitted again.
Fitted FitOne(Eigen::MatrixXd regressors, const Eigen::RowVectorXd& target_a, double rms_a) {
  const Eigen::VectorXd scale = regressors.rowwise().norm().cwiseMax(1e-300);
  regressors = scale.cwiseInverse().asDiagonal() * regressors;
  Eigen::RowVectorXd weight = Eigen::RowVectorXd::Ones(target_a.size());
  Eigen::RowVectorXd before = Eigen::RowVectorXd::Zero(target_a.size());
  Fitted out;
  for (int fit = 0; fit < kFits && before != weight; ++fit) {
    before = weight;
    const Eigen::MatrixXd weighted = regressors * weight.asDiagonal();
    Eigen::MatrixXd gram = weighted * regressors.transpose();
    gram.diagonal().array() += 1e-13;
    const Eigen::VectorXd solved = gram.ldlt().solve(weighted * target_a.transpose());
    const Eigen::RowVectorXd left = (target_a - solved.transpose() * regressors).cwiseAbs();
    out.usual_a = std::max(1.48 * Median({left.begin(), left.end()}), kExact * rms_a);
    out.law = scale.cwiseInverse().asDiagonal() * solved;
    weight = (left.array() <= kNotFitted * out.usual_a).cast<double>();
  }
  return out;
}

// A law of each axis alone where there is one: among all columns the laws of the other axes are
// redundant, and a fit that leans on them breaks wherever one of them is at its limit.
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
  const Eigen::VectorXd rms_a = (target.colwise() - target.rowwise().mean()).rowwise().norm() /
                                std::sqrt(static_cast<double>(count));
  law_ = Eigen::MatrixXd::Zero(Size(), axes_);
  usual_a_ = Eigen::VectorXd::Zero(axes_);
  for (Eigen::Index a = 0; a < axes_; ++a) {
    Eigen::MatrixXd own(kOfAxis + 1, count);
    own << regressors.middleRows(a * kOfAxis, kOfAxis), regressors.bottomRows(1);
    const Fitted alone = FitOne(std::move(own), target.row(a), rms_a[a]);
    usual_a_[a] = alone.usual_a;
    law_.col(a).segment(a * kOfAxis, kOfAxis) = alone.law.head(kOfAxis);
    law_(Size() - 1, a) = alone.law[kOfAxis];
  }
  const auto known = [&] { return (usual_a_.array() < kKnown * rms_a.array()).all(); };
  if (known()) return true;
  between_axes_ = true;
  for (Eigen::Index a = 0; a < axes_; ++a) {
    const Fitted all = FitOne(regressors, target.row(a), rms_a[a]);
    usual_a_[a] = all.usual_a;
    law_.col(a) = all.law;
  }
  return known();
}

// An axis at its limit follows no law for as long as the law remembers; a law between axes hands
// that on to the others.
std::vector<std::size_t> Law::Broken() const {
  std::vector<std::size_t> broken;
  std::size_t judged = 0;
  const std::size_t most = std::max<std::size_t>(2, (rig_.axes + 1) / 2);
  Eigen::VectorXd regressors(Size());
  for (std::size_t i = 0; i < read_.size(); ++i) {
    const auto free = static_cast<std::size_t>(std::ranges::count(free_[i], true));
    if (free < (between_axes_ ? rig_.axes : most)) continue;
    ++judged;
    Read(read_[i], regressors);
    const Eigen::VectorXd left = (Current(read_[i]) - law_.transpose() * regressors).cwiseAbs();
    std::size_t off = 0;
    for (std::size_t a = 0; a < rig_.axes; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      if (free_[i][a] && left[axis] > kBroken * usual_a_[axis]) ++off;
    }
    if (off >= most) broken.push_back(read_[i]);
  }
  if (static_cast<double>(broken.size()) > kMostBroken * static_cast<double>(judged)) return {};
  return broken;
}

}  // namespace

void FindGaps(const RigView& rig, const Record& record, std::uint64_t first_cycle,
              RecordErrors& out) {
  if (rig.axes < 2) return;
  Law law(rig, record);
  if (!law.Fit()) return;
  const std::vector<std::size_t> broken = law.Broken();
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
