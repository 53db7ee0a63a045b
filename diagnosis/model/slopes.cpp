#include "diagnosis/model/slopes.hpp"

#include <algorithm>

#include "diagnosis/model/convolve.hpp"
#include "diagnosis/model/cross_products.hpp"
#include "diagnosis/model/innovation_series.hpp"
#include "diagnosis/model/longest_first.hpp"

namespace levitas::diagnosis {
namespace {

using Eigen::Index;

/// Parts that a sum over a record is kept in, each by one thread at a time: as many however many
/// threads there are, so that its rounding does not depend on their number.
constexpr std::size_t kParts = 8;

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

/// `count` whitened values of `now`; zero where nothing counts.
void Whiten(const std::vector<double>& filter, const double* now, const std::uint8_t* counts,
            std::size_t count, double* to) {
  Convolve(filter, now, count, to);
  for (std::size_t n = 0; n < count; ++n) to[n] = counts[n] != 0 ? to[n] : 0.0;
}

/// What a stretch needs of a run besides the slopes.
struct Weighed {
  Weighed(const Trajectory& run, std::size_t axes, const Whitener& by)
      : whitener(by), counts(Counting(run)) {
    for (std::size_t a = 0; a < axes; ++a) {
      innovations.push_back(InnovationSeries(run, a, whitener.order));
    }
  }
  const Whitener& whitener;
  std::vector<std::uint8_t> counts;
  std::vector<std::vector<double>> innovations;  ///< per axis, behind zeros
};

/// One stretch of one axis, whitened, multiplied out and added; innovations last.
class Stretch {
 public:
  explicit Stretch(std::size_t columns)
      : columns_(columns),
        whitened_(Eigen::MatrixXd::Zero(static_cast<Index>(kProductRows),
                                        static_cast<Index>((columns + 4) / 4 * 4))),
        sum_(Eigen::MatrixXd::Zero(whitened_.cols(), whitened_.cols())) {}

  void Add(const Weighed& run, const Eigen::MatrixXf& slope, std::size_t axis, std::size_t first) {
    const std::size_t samples = run.counts.size();
    const std::size_t count = std::min(kProductRows, samples - first);
    const std::vector<double>& filter = run.whitener.filter[axis];
    const std::uint8_t* counts = run.counts.data() + first;
    const std::size_t past = std::min(first, filter.size() - 1);
    wide_.assign(filter.size() - 1 + count, 0.0);  // nothing is known before the record
    double* now = wide_.data() + filter.size() - 1;
    if (count < kProductRows) whitened_.setZero();
    for (std::size_t c = 0; c < columns_; ++c) {
      const float* from = slope.col(static_cast<Index>(c)).data() + axis * samples + first;
      std::copy(from - past, from + count, now - past);
      Whiten(filter, now, counts, count, whitened_.col(static_cast<Index>(c)).data());
    }
    Whiten(filter, run.innovations[axis].data() + run.whitener.order + first, counts, count,
           whitened_.col(static_cast<Index>(columns_)).data());
    AddCrossProducts(whitened_, sum_);
    values_ += static_cast<std::size_t>(std::count(counts, counts + count, std::uint8_t{1}));
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
  std::vector<double> wide_;  ///< of one column, with what the filter needs of the past
  std::size_t values_{0};
};

/// What the slopes of one axis are to be multiplied with: the whitened innovations, whitened again
/// backwards in time.
Eigen::VectorXf TwiceWhitened(const Trajectory& run, const Whitener& whitener, std::size_t axis,
                              double& square) {
  const std::size_t samples = run.moments.size();
  const std::vector<double>& filter = whitener.filter[axis];
  std::vector<double> once(whitener.order + samples, 0.0);
  double* const white = once.data() + whitener.order;
  Whiten(filter, InnovationSeries(run, axis, whitener.order).data() + whitener.order,
         Counting(run).data(), samples, white);
  for (std::size_t n = 0; n < samples; ++n) square += white[n] * white[n];
  std::reverse(white, white + samples);
  std::vector<double> backwards(samples);
  Convolve(filter, white, samples, backwards.data());
  Eigen::VectorXf twice(static_cast<Index>(samples));
  std::transform(backwards.rbegin(), backwards.rend(), twice.data(),
                 [](double value) { return static_cast<float>(value); });
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
    std::vector<Stretch> sums(kParts, Stretch(part.acting.size()));
    const std::size_t stretches = (samples + kProductRows - 1) / kProductRows;
    const Weighed run(runs[r], axes_, whitener);
    EachInParallel(sums.size(), 0, [&](std::size_t s) {
      for (std::size_t i = s; i < stretches * axes_; i += kParts) {
        sums[s].Add(run, part.slope, i / stretches, i % stretches * kProductRows);
      }
    });
    for (const Stretch& sum : sums) sum.AddTo(part.acting, out);
  }
  return out;
}

void Slopes::Renew(const std::vector<Trajectory>& runs, const Whitener& whitener,
                   NormalEquations& sum) const {
  std::vector<Eigen::VectorXd> jte(parts_.size() * axes_);
  std::vector<double> ete(jte.size(), 0.0);
  EachInParallel(jte.size(), 0, [&](std::size_t i) {
    const std::size_t r = i / axes_;
    const std::size_t a = i % axes_;
    const auto samples = static_cast<Index>(runs[r].moments.size());
    const Eigen::VectorXf twice = TwiceWhitened(runs[r], whitener, a, ete[i]);
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
