#include "diagnosis/normal_equations.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <barrier>
#include <cmath>
#include <thread>

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kChunk = 1024;  ///< samples
constexpr std::size_t kThreads = 2;

/// Filters columns of one axis through the whitening filter, keeping its memory between chunks.
/// `rows` x `columns`, in place.
class ColumnFilter {
 public:
  ColumnFilter(const std::vector<double>& filter, std::size_t columns)
      : memory_(Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(filter.size()) - 1,
                                      static_cast<Eigen::Index>(columns))) {
    for (const double c : filter) filter_.push_back(static_cast<float>(c));
  }

  void Clear() { memory_.setZero(); }

  void Apply(Eigen::Ref<Eigen::MatrixXf> block) {
    const auto order = static_cast<Eigen::Index>(filter_.size()) - 1;
    const Eigen::Index rows = block.rows();
    Eigen::MatrixXf padded(rows + order, block.cols());
    padded.topRows(order) = memory_;
    padded.bottomRows(rows) = block;
    memory_ = padded.bottomRows(order);
    block = filter_[0] * padded.bottomRows(rows);
    for (Eigen::Index k = 1; k <= order; ++k) {
      block += filter_[static_cast<std::size_t>(k)] * padded.middleRows(order - k, rows);
    }
  }

 private:
  std::vector<float> filter_;
  Eigen::MatrixXf memory_;
};

/// Autoregression of one axis (Levinson-Durbin) over uninterrupted counting samples.
std::vector<double> WhiteningFilter(const std::vector<Trajectory>& runs, std::size_t axis,
                                    std::size_t order) {
  std::vector<double> correlation(order + 1, 0.0);
  double count = 0.0;
  for (const Trajectory& run : runs) {
    for (std::size_t n = order; n < run.moments.size(); ++n) {
      if (!run.moments[n].counts) continue;
      const double now = static_cast<double>(run.moments[n].innovation_m[axis]);
      for (std::size_t k = 0; k <= order; ++k) {
        correlation[k] += now * static_cast<double>(run.moments[n - k].innovation_m[axis]);
      }
      count += 1.0;
    }
  }
  std::vector<double> a{1.0};
  double power = correlation[0];
  for (std::size_t k = 1; k <= order; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < k; ++i) sum += a[i] * correlation[k - i];
    const double reflection = -sum / power;
    std::vector<double> next(a);
    next.push_back(0.0);
    for (std::size_t i = 1; i <= k; ++i) next[i] += reflection * (i == k ? 1.0 : a[k - i]);
    a = next;
    power *= 1.0 - reflection * reflection;
  }
  const double rms = std::sqrt(power / std::max(1.0, count));
  for (double& c : a) c /= rms > 0.0 ? rms : 1.0;
  return a;
}

/// Places in `chosen` of the terms that can act in a record: what turns adds nothing at rest.
std::vector<std::size_t> Acting(const Trajectory& run, const std::vector<Term>& terms,
                                const std::vector<std::size_t>& chosen) {
  const bool turns = std::any_of(run.moments.begin(), run.moments.end(),
                                 [](const Moment& m) { return m.speed_rad_per_s != 0.0F; });
  const int record = run.moments.empty() ? -1 : static_cast<int>(run.moments.front().record);
  std::vector<std::size_t> acting;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Term& term = terms[chosen[i]];
    const bool here = term.record < 0 || term.record == record;
    if (here && (turns || !term.rotating)) acting.push_back(i);
  }
  return acting;
}

/// Sums of one record.
class RecordSums {
 public:
  RecordSums(const RigView& rig, const Trajectory& run, const std::vector<Term>& terms,
             const std::vector<double>& theta, const Whitener& whitener,
             const std::vector<std::size_t>& chosen)
      : axes_(rig.axes), run_(run), acting_(Acting(run, terms, chosen)), columns_(acting_.size()) {
    const LanePair models(rig, run.gains);
    for (std::size_t i = 0; i < acting_.size(); i += kLanes) {
      std::vector<std::size_t> block;
      for (std::size_t k = i; k < std::min(acting_.size(), i + kLanes); ++k) {
        block.push_back(chosen[acting_[k]]);
      }
      blocks_.emplace_back(models, terms, theta, std::move(block));
    }
    const auto width = static_cast<Eigen::Index>(columns_ + 1);
    for (std::size_t a = 0; a < axes_; ++a) filters_.emplace_back(whitener.filter[a], columns_ + 1);
    derivative_.resize(static_cast<Eigen::Index>(kChunk * axes_), width);
    sum_ = Eigen::MatrixXd::Zero(width, width);
  }

  /// Adds to sums over all of `chosen`, innovations last; lower triangle.
  void AddTo(Eigen::MatrixXd& sum) const {
    std::vector<Eigen::Index> to;
    to.reserve(acting_.size() + 1);
    for (const std::size_t i : acting_) to.push_back(static_cast<Eigen::Index>(i));
    to.push_back(sum.rows() - 1);
    for (std::size_t i = 0; i < to.size(); ++i) {
      for (std::size_t k = 0; k <= i; ++k) {
        sum(to[i], to[k]) += sum_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
      }
    }
  }
  [[nodiscard]] std::size_t values() const { return values_; }

  /// Propagates blocks thread, thread + kThreads, ... over one chunk.
  void Propagate(std::size_t from, std::size_t count, std::size_t thread) {
    std::array<float, kMaxAxes * kLanes> d{};
    for (std::size_t b = thread; b < blocks_.size(); b += kThreads) {
      const std::size_t lanes = blocks_[b].chosen().size();
      for (std::size_t n = 0; n < count; ++n) {
        blocks_[b].Step(run_.moments[from + n], d.data());
        for (std::size_t a = 0; a < axes_; ++a) {
          const auto row = static_cast<Eigen::Index>(a * kChunk + n);
          for (std::size_t l = 0; l < lanes; ++l) {
            derivative_(row, static_cast<Eigen::Index>(b * kLanes + l)) = d[a * kLanes + l];
          }
        }
      }
    }
  }

  /// Whitens and sums one axis; call for every axis, then `Collect`.
  void WhitenAxis(std::size_t from, std::size_t count, std::size_t a) {
    const auto rows = static_cast<Eigen::Index>(count);
    auto block = derivative_.middleRows(static_cast<Eigen::Index>(a * kChunk), rows);
    for (std::size_t n = 0; n < count; ++n) {
      block(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(columns_)) =
          run_.moments[from + n].innovation_m[a];
    }
    Eigen::MatrixXf whitened = block;
    filters_[a].Apply(whitened);
    for (std::size_t n = 0; n < count; ++n) {
      if (!run_.moments[from + n].counts) whitened.row(static_cast<Eigen::Index>(n)).setZero();
    }
    // In double: sums of single precision lose more than a unit of evidence where terms explain
    // 1e8 of them, and are then no longer positive definite.
    const Eigen::MatrixXd exact = whitened.cast<double>();
    partial_[a] = Eigen::MatrixXd::Zero(exact.cols(), exact.cols());
    partial_[a].selfadjointView<Eigen::Lower>().rankUpdate(exact.transpose());
  }

  void Collect(std::size_t from, std::size_t count) {
    for (std::size_t a = 0; a < axes_; ++a) sum_ += partial_[a];
    for (std::size_t n = 0; n < count; ++n) values_ += run_.moments[from + n].counts ? axes_ : 0;
  }

 private:
  std::size_t axes_;
  const Trajectory& run_;
  std::vector<std::size_t> acting_;  ///< places in `chosen`
  std::size_t columns_;
  std::vector<SensitivityBlock> blocks_;
  std::vector<ColumnFilter> filters_;
  Eigen::MatrixXf derivative_;
  std::array<Eigen::MatrixXd, kMaxAxes> partial_;
  Eigen::MatrixXd sum_;
  std::size_t values_{0};
};

void SumRecord(RecordSums& sums, std::size_t samples, std::size_t axes) {
  std::barrier meet(static_cast<std::ptrdiff_t>(kThreads));
  const auto work = [&](std::size_t thread) {
    for (std::size_t from = 0; from < samples; from += kChunk) {
      const std::size_t count = std::min(kChunk, samples - from);
      sums.Propagate(from, count, thread);
      meet.arrive_and_wait();
      for (std::size_t a = thread; a < axes; a += kThreads) sums.WhitenAxis(from, count, a);
      meet.arrive_and_wait();
      if (thread == 0) sums.Collect(from, count);
      meet.arrive_and_wait();
    }
  };
  std::thread other(work, 1);
  work(0);
  other.join();
}

}  // namespace

Whitener MakeWhitener(const std::vector<Trajectory>& runs, std::size_t axes, std::size_t order) {
  Whitener whitener{order, {}};
  for (std::size_t a = 0; a < axes; ++a) whitener.filter.push_back(WhiteningFilter(runs, a, order));
  return whitener;
}

NormalEquations Accumulate(const RigView& rig, const std::vector<Trajectory>& runs,
                           const std::vector<Term>& terms, const std::vector<double>& theta,
                           const Whitener& whitener, const std::vector<std::size_t>& chosen) {
  const auto size = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size + 1, size + 1);
  NormalEquations out;
  for (const Trajectory& run : runs) {
    RecordSums sums(rig, run, terms, theta, whitener, chosen);
    SumRecord(sums, run.moments.size(), rig.axes);
    sums.AddTo(sum);
    out.values += sums.values();
  }
  sum.triangularView<Eigen::StrictlyUpper>() = sum.transpose();
  out.jtj = sum.topLeftCorner(size, size);
  out.jte = sum.topRightCorner(size, 1);
  out.ete = sum(size, size);
  return out;
}

double SquaredSum(const std::vector<Trajectory>& runs, std::size_t axes, const Whitener& whitener,
                  std::size_t* values) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Trajectory& run : runs) {
    for (std::size_t n = whitener.order; n < run.moments.size(); ++n) {
      if (!run.moments[n].counts) continue;
      for (std::size_t a = 0; a < axes; ++a) {
        double e = 0.0;
        for (std::size_t k = 0; k <= whitener.order; ++k) {
          e += whitener.filter[a][k] * static_cast<double>(run.moments[n - k].innovation_m[a]);
        }
        sum += e * e;
        ++count;
      }
    }
  }
  if (values != nullptr) *values = count;
  return sum;
}

}  // namespace levitas::diagnosis
