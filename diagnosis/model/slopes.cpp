#include "diagnosis/model/slopes.hpp"

#include <algorithm>

#include "diagnosis/model/cross_products.hpp"
#include "diagnosis/model/parallel_for.hpp"

namespace levitas::diagnosis {
namespace {

using Eigen::Index;

/// Terms that can act in a record: what turns adds nothing at rest.
std::vector<std::size_t> Acting(const Trajectory& run, const std::vector<Term>& terms,
                                const std::vector<std::size_t>& chosen) {
  const bool turns = std::any_of(run.moments.begin(), run.moments.end(),
                                 [](const SamplePoint& m) { return m.speed_rad_per_s != 0.0F; });
  std::vector<std::size_t> acting;
  for (const std::size_t i : chosen) {
    const bool here =
        !terms[i].record || run.moments.empty() || *terms[i].record == run.moments.front().record;
    if (here && (turns || !terms[i].rotating)) acting.push_back(i);
  }
  return acting;
}

/// A block of up to kLanes terms through one record, into its columns.
void Propagate(SensitivityBlock block, const Trajectory& run, std::size_t axes,
               Eigen::Ref<Eigen::MatrixXf> columns) {
  const std::size_t samples = run.moments.size();
  const std::size_t lanes = block.chosen().size();
  std::array<float, kMaxAxes * kLanes> d{};
  for (std::size_t n = 0; n < samples; ++n) {
    block.Step(run.moments[n], d.data());
    for (std::size_t a = 0; a < axes; ++a) {
      for (std::size_t l = 0; l < lanes; ++l) {
        columns(static_cast<Index>(a * samples + n), static_cast<Index>(l)) = d[a * kLanes + l];
      }
    }
  }
}

/// `count` whitened values from sample `first` on of what `from` has; zero where nothing counts.
void Whiten(const std::vector<double>& filter, const Trajectory& run, std::size_t first,
            std::size_t count, const float* from, double* to) {
  std::fill_n(to, count, 0.0);
  for (std::size_t k = 0; k < filter.size(); ++k) {
    const double weight = filter[k];
    const std::size_t start = first < k ? k - first : 0;  // nothing is known before the record
    const float* late = from + first + start - k;
    double* out = to + start;
    for (std::size_t n = 0; n + start < count; ++n) out[n] += weight * static_cast<double>(late[n]);
  }
  for (std::size_t n = 0; n < count; ++n) to[n] = run.moments[first + n].counts ? to[n] : 0.0;
}

std::vector<float> Innovations(const Trajectory& run, std::size_t axis) {
  std::vector<float> values;
  values.reserve(run.moments.size());
  for (const SamplePoint& m : run.moments) values.push_back(m.innovation_m[axis]);
  return values;
}

/// One stretch of one axis, whitened, multiplied out and added; innovations last.
class Stretch {
 public:
  explicit Stretch(std::size_t columns)
      : columns_(columns),
        whitened_(Eigen::MatrixXd::Zero(static_cast<Index>(kProductRows),
                                        static_cast<Index>((columns + 4) / 4 * 4))),
        sum_(Eigen::MatrixXd::Zero(whitened_.cols(), whitened_.cols())) {}

  void Add(const Trajectory& run, const Eigen::MatrixXf& slope,
           const std::vector<float>& innovations, const std::vector<double>& filter,
           std::size_t axis, std::size_t first) {
    const std::size_t samples = run.moments.size();
    const std::size_t count = std::min(kProductRows, samples - first);
    if (count < kProductRows) whitened_.setZero();
    for (std::size_t c = 0; c < columns_; ++c) {
      Whiten(filter, run, first, count, slope.col(static_cast<Index>(c)).data() + axis * samples,
             whitened_.col(static_cast<Index>(c)).data());
    }
    Whiten(filter, run, first, count, innovations.data(),
           whitened_.col(static_cast<Index>(columns_)).data());
    AddCrossProducts(whitened_, sum_);
    for (std::size_t n = first; n < first + count; ++n) values_ += run.moments[n].counts ? 1U : 0U;
  }

  /// Adds to sums over all terms.
  void AddTo(const std::vector<std::size_t>& acting, NormalEquations& out) const {
    const auto last = static_cast<Index>(columns_);
    for (std::size_t i = 0; i < columns_; ++i) {
      const auto row = static_cast<Index>(acting[i]);
      const auto at = static_cast<Index>(i);
      out.jte[row] += sum_(last, at);
      for (Index k = 0; k <= at; ++k) {
        const auto column = static_cast<Index>(acting[static_cast<std::size_t>(k)]);
        out.jtj(row, column) += sum_(at, k);
        if (k < at) out.jtj(column, row) += sum_(at, k);
      }
    }
    out.ete += sum_(last, last);
    out.values += values_;
  }

 private:
  std::size_t columns_;
  Eigen::MatrixXd whitened_, sum_;
  std::size_t values_{0};
};

/// What the slopes of one axis are to be multiplied with: the whitened innovations, whitened again
/// backwards in time.
Eigen::VectorXf TwiceWhitened(const Trajectory& run, const std::vector<double>& filter,
                              std::size_t axis, double& square) {
  const std::size_t samples = run.moments.size();
  std::vector<double> once(samples);
  Whiten(filter, run, 0, samples, Innovations(run, axis).data(), once.data());
  Eigen::VectorXf twice(static_cast<Index>(samples));
  for (std::size_t n = 0; n < samples; ++n) {
    double sum = 0.0;
    for (std::size_t k = 0; k < filter.size() && n + k < samples; ++k) {
      sum += filter[k] * once[n + k];
    }
    twice[static_cast<Index>(n)] = static_cast<float>(sum);
    square += once[n] * once[n];
  }
  return twice;
}

}  // namespace

Slopes::Slopes(const RigView& rig, const std::vector<Trajectory>& runs,
               const std::vector<Term>& terms, const std::vector<double>& theta,
               const std::vector<std::size_t>& chosen)
    : axes_(rig.axes), terms_(terms.size()) {
  struct Task {
    std::size_t part, first;
  };
  std::vector<Task> tasks;
  std::vector<std::size_t> work;  // terms times samples
  std::vector<LaneModels> models;
  const LinearChange change = ChangeOf(terms, theta);
  parts_.reserve(runs.size());
  models.reserve(runs.size());
  for (const Trajectory& run : runs) {
    Part& part = parts_.emplace_back();
    models.emplace_back(rig, run.gains, change);
    part.acting = Acting(run, terms, chosen);
    part.slope.resize(static_cast<Index>(rig.axes * run.moments.size()),
                      static_cast<Index>(part.acting.size()));
    for (std::size_t i = 0; i < part.acting.size(); i += kLanes) {
      tasks.push_back({parts_.size() - 1, i});
      work.push_back(std::min(kLanes, part.acting.size() - i) * run.moments.size());
    }
  }
  LongestFirst(work, [&](std::size_t i) {
    const Task& task = tasks[i];
    Part& part = parts_[task.part];
    const std::size_t end = std::min(part.acting.size(), task.first + kLanes);
    std::vector<std::size_t> block(part.acting.begin() + static_cast<std::ptrdiff_t>(task.first),
                                   part.acting.begin() + static_cast<std::ptrdiff_t>(end));
    const auto lanes = static_cast<Index>(block.size());
    Propagate(SensitivityBlock(rig, models[task.part], terms, theta, std::move(block)),
              runs[task.part], axes_, part.slope.middleCols(static_cast<Index>(task.first), lanes));
  });
}

NormalEquations Slopes::Sum(const std::vector<Trajectory>& runs, const Whitener& whitener) const {
  const auto size = static_cast<Index>(terms_);
  NormalEquations out;
  out.jtj = Eigen::MatrixXd::Zero(size, size);
  out.jte = Eigen::VectorXd::Zero(size);
  for (std::size_t r = 0; r < parts_.size(); ++r) {
    const Part& part = parts_[r];
    const std::size_t samples = runs[r].moments.size();
    std::vector<Stretch> sums(kThreads, Stretch(part.acting.size()));
    const std::size_t stretches = (samples + kProductRows - 1) / kProductRows;
    std::vector<std::vector<float>> innovations;
    for (std::size_t a = 0; a < axes_; ++a) innovations.push_back(Innovations(runs[r], a));
    ParallelFor(stretches * axes_, [&](std::size_t i, std::size_t thread) {
      const std::size_t a = i / stretches;
      sums[thread].Add(runs[r], part.slope, innovations[a], whitener.filter[a], a,
                       i % stretches * kProductRows);
    });
    for (const Stretch& sum : sums) sum.AddTo(part.acting, out);
  }
  return out;
}

void Slopes::Renew(const std::vector<Trajectory>& runs, const Whitener& whitener,
                   NormalEquations& sum) const {
  std::vector<Eigen::VectorXd> jte(parts_.size() * axes_);
  std::vector<double> ete(jte.size(), 0.0);
  ParallelFor(jte.size(), [&](std::size_t i, std::size_t /*thread*/) {
    const std::size_t r = i / axes_;
    const std::size_t a = i % axes_;
    const auto samples = static_cast<Index>(runs[r].moments.size());
    const Eigen::VectorXf twice = TwiceWhitened(runs[r], whitener.filter[a], a, ete[i]);
    const auto slope = parts_[r].slope.middleRows(static_cast<Index>(a) * samples, samples);
    jte[i] = Eigen::VectorXd::Zero(slope.cols());
    constexpr Index kRows = 2048;  // sums of single precision stay short
    for (Index first = 0; first < samples; first += kRows) {
      const Index rows = std::min(kRows, samples - first);
      jte[i] += (slope.middleRows(first, rows).transpose() * twice.segment(first, rows))
                    .template cast<double>();
    }
  });
  sum.jte.setZero();
  sum.ete = 0.0;
  for (std::size_t i = 0; i < jte.size(); ++i) {
    const Part& part = parts_[i / axes_];
    for (std::size_t c = 0; c < part.acting.size(); ++c) {
      sum.jte[static_cast<Index>(part.acting[c])] += jte[i][static_cast<Index>(c)];
    }
    sum.ete += ete[i];
  }
}

}  // namespace levitas::diagnosis
