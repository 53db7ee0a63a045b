#include "diagnosis/levitator/misfit.hpp"

#include <algorithm>
#include <cmath>

#include "common/each_in_parallel.hpp"
#include "diagnosis/model/levinson.hpp"

namespace levitas::levitator {
namespace {

bool IsOwn(std::size_t index) { return index >= kParameters; }

bool BelongsTo(std::size_t index, std::size_t record) {
  return !IsOwn(index) || (index - kParameters) / kOwnParameters == record;
}

constexpr double kBlockS = 0.5;

/// Rows with enough uninterrupted past for the filter.
template <class Visit>
void ForCounted(const Series& series, Visit visit) {
  std::size_t past = 0;
  for (std::size_t n = 0; n < series.size(); ++n) {
    past = series.restart[n] ? 0 : past + 1;
    if (series.counts[n] && past > 2 * kMemory) visit(n);
  }
}

}  // namespace

double ToleranceOf(std::size_t index) {
  if (!IsOwn(index)) return Table()[index].tolerance;
  return (index - kParameters) % kOwnParameters == kOwnResistance ? kOwnResistanceTolerance
                                                                  : kOwnOffsetToleranceM;
}

double WideOf(std::size_t index) { return IsOwn(index) ? ToleranceOf(index) : Table()[index].wide; }

double LeastOf(std::size_t index, const Theta& origin) {
  return IsOwn(index) ? -0.5 : LowerBound(index, origin[index]);
}

Raw Misfit::RawOf(const Theta& theta, std::size_t record) const {
  const Series& series = series_[record];
  const CoilRun coils = RunCoils(rig_, series, theta, record);
  Raw raw;
  if (series.has_currents()) {
    for (std::size_t coil = 0; coil < 2; ++coil) {
      raw[coil] = series.measured_a[coil];
      for (std::size_t n = 0; n < raw[coil].size(); ++n) raw[coil][n] -= coils.reading_a[coil][n];
    }
  }
  raw[2] = Innovations(rig_, series, theta, record, coils);
  return raw;
}

Filters Misfit::Whiten(const Theta& theta, std::size_t memory) const {
  Filters filters;
  std::array<std::vector<double>, kChannels> correlation;
  std::array<double, kChannels> count{};
  correlation.fill(std::vector<double>(memory + 1, 0.0));
  for (std::size_t record = 0; record < series_.size(); ++record) {
    const Raw raw = RawOf(theta, record);
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (raw[c].empty()) continue;
      ForCounted(series_[record], [&](std::size_t n) {
        for (std::size_t k = 0; k <= memory; ++k) correlation[c][k] += raw[c][n] * raw[c][n - k];
        count[c] += 1.0;
      });
    }
  }
  for (std::size_t c = 0; c < kChannels; ++c) {
    filters[c] = diagnosis::WhiteningFilter(correlation[c], count[c]);
  }
  return filters;
}

Eigen::VectorXd Misfit::Whitened(const Raw& raw, std::size_t record, const Filters& filters) const {
  std::vector<double> out;
  out.reserve(kChannels * series_[record].size());
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (raw[c].empty()) continue;
    ForCounted(series_[record], [&](std::size_t n) {
      double sum = 0.0;
      for (std::size_t k = 0; k < filters[c].size(); ++k) sum += filters[c][k] * raw[c][n - k];
      out.push_back(sum);
    });
  }
  return Eigen::Map<const Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size()));
}

double Misfit::SquaredSum(const Theta& theta, const Filters& filters) const {
  std::vector<double> sums(series_.size(), 0.0);
  EachInParallel(series_.size(), 0, [&](std::size_t record) {
    sums[record] = Whitened(RawOf(theta, record), record, filters).squaredNorm();
  });
  double sum = 0.0;
  for (const double one : sums) sum += one;
  return sum;
}

std::vector<double> Misfit::BlockSums(const Theta& theta, const Filters& filters) const {
  const auto rows = static_cast<Eigen::Index>(std::max(1.0, kBlockS / rig_.period_s));
  std::vector<double> sums;
  for (std::size_t record = 0; record < series_.size(); ++record) {
    const Raw raw = RawOf(theta, record);
    const Eigen::VectorXd values = Whitened(raw, record, filters);
    const auto channels = static_cast<Eigen::Index>(std::count_if(
        raw.begin(), raw.end(), [](const auto& channel) { return !channel.empty(); }));
    const Eigen::Index count = values.size() / channels;
    const std::size_t first = sums.size();
    sums.resize(first + static_cast<std::size_t>((count + rows - 1) / rows), 0.0);
    for (Eigen::Index i = 0; i < count * channels; ++i) {
      sums[first + static_cast<std::size_t>(i % count / rows)] += values[i] * values[i];
    }
  }
  return sums;
}

Sums Misfit::LineariseOne(const Theta& theta, const Filters& filters,
                          const std::vector<std::size_t>& active, std::size_t record) const {
  const Raw raw = RawOf(theta, record);
  const Eigen::VectorXd error = Whitened(raw, record, filters);
  const bool probes = series_[record].has_currents();
  const auto columns = static_cast<Eigen::Index>(active.size());
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(error.size(), columns);
  Theta shifted = theta;
  for (Eigen::Index i = 0; i < columns; ++i) {
    const std::size_t index = active[static_cast<std::size_t>(i)];
    if (!BelongsTo(index, record)) continue;
    const double step = 1e-3 * std::max(WideOf(index), ToleranceOf(index));
    shifted[index] = theta[index] + step;
    // What moves the coils alone leaves the motion as it is, which follows the measured currents.
    const bool coils_only = probes && !IsOwn(index) && Table()[index].side == Side::kCoils;
    const bool motion_only = probes && !IsOwn(index) && Table()[index].side == Side::kMotion;
    Raw moved = raw;
    const CoilRun coils =
        motion_only ? CoilRun{} : RunCoils(rig_, series_[record], shifted, record);
    for (std::size_t coil = 0; coil < 2 && probes && !motion_only; ++coil) {
      for (std::size_t n = 0; n < raw[coil].size(); ++n) {
        moved[coil][n] = series_[record].measured_a[coil][n] - coils.reading_a[coil][n];
      }
    }
    if (!coils_only) moved[2] = Innovations(rig_, series_[record], shifted, record, coils);
    slopes.col(i) = (Whitened(moved, record, filters) - error) / step;
    shifted[index] = theta[index];
  }
  return {slopes.transpose() * slopes, slopes.transpose() * error, error.squaredNorm(),
          static_cast<double>(error.size())};
}

Sums Misfit::Linearise(const Theta& theta, const Filters& filters,
                       const std::vector<std::size_t>& active) const {
  std::vector<Sums> parts(series_.size());
  EachInParallel(series_.size(), 0, [&](std::size_t record) {
    parts[record] = LineariseOne(theta, filters, active, record);
  });
  Sums total = parts.front();
  for (std::size_t record = 1; record < parts.size(); ++record) {
    total.jtj += parts[record].jtj;
    total.jte += parts[record].jte;
    total.ete += parts[record].ete;
    total.values += parts[record].values;
  }
  return total;
}

}  // namespace levitas::levitator
