#include "diagnosis/record_errors/rate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "diagnosis/record_errors/plant_fit.hpp"
#include "diagnosis/record_errors/rotation_unit.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kOff = 2e-3;          ///< crystals are off by 1e-4
constexpr double kDrift = 1e-3;        ///< between the two ends
constexpr double kOffRotation = 0.05;  ///< a speed that lags in a run-up is off by less
constexpr double kLeftOut = 0.2;
constexpr std::size_t kFewestTimes = 200;
constexpr double kRateGain = 3.0;
constexpr std::array kFactors{0.25, 0.33, 0.5, 0.67, 1.5, 2.0, 3.0, 4.0};
constexpr ObserverSpeed kRateObserver{0.003, 1e-5};

/// Mean step in periods, of rows [from, to).
double MeanStep(const std::vector<double>& times_s, std::size_t from, std::size_t to,
                double period_s) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t n = from + 1; n < to; ++n) {
    const double step = (times_s[n] - times_s[n - 1]) / period_s;
    if (!(step > 0.0)) continue;
    // A longer step is a drop-out: as many whole periods.
    const double whole = step > 1.5 ? std::round(step) : 1.0;
    sum += step / whole;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 1.0;
}

}  // namespace

void FindClock(const RigView& rig, const std::vector<double>& times_s, RecordErrors& out) {
  if (times_s.size() < kFewestTimes) return;
  const std::size_t part = times_s.size() / 8;
  const double first = MeanStep(times_s, 0, part, rig.period_s);
  const double last = MeanStep(times_s, times_s.size() - part, times_s.size(), rig.period_s);
  const double all = MeanStep(times_s, 0, times_s.size(), rig.period_s);
  out.drifts = std::abs(last - first) > kDrift;
  if (std::abs(all - 1.0) < kOff && !out.drifts) return;
  out.time_factor = out.drifts ? 1.0 : 1.0 / all;
  const double rate_hz = 1.0 / rig.period_s;
  RecordError error{
      RecordErrorKind::kRate, {"time"}, all, std::abs(all - 1.0) / kOff, {}, {}, true};
  error.sentence = out.drifts
                       ? fmt::format(
                             "the times drift: rows are {:.4f} periods of the rig apart at the "
                             "start and {:.4f} at the end",
                             first, last)
                       : fmt::format(
                             "by its times the file has {:.6g} rows a second, the rig samples "
                             "{:.6g} times",
                             rate_hz / all, rate_hz);
  error.mend = fmt::format(
      "rate_hz: {:g} in a map of columns, which then reads no times; or the rig file's period, if "
      "that is what is wrong",
      rate_hz);
  out.errors.push_back(std::move(error));
}

bool FindRateOfRotation(const RigView& rig, const Columns& columns, RecordErrors& out) {
  const double factor = AngleOverSpeed(columns, rig.period_s);
  const bool known = std::ranges::any_of(out.errors, [](const RecordError& error) {
    return error.columns.front() == "speed" || error.columns.front() == "rotor_angle" ||
           error.kind == RecordErrorKind::kRate;
  });
  if (factor <= 0.0 || known || std::abs(factor - 1.0) < kOffRotation) return false;
  const double rate_hz = 1.0 / rig.period_s;
  const bool left_out = std::abs(factor - 1.0) > kLeftOut;
  if (left_out) out.rows_apart = factor;
  out.errors.push_back(
      {RecordErrorKind::kRate,
       {"time"},
       factor,
       std::abs(factor - 1.0) / kOffRotation,
       fmt::format("the rotor turns by {:.3g} times its speed times the period from row to row: "
                   "some {:.4g} rows a second, the rig samples {:.6g} times",
                   factor, rate_hz / factor, rate_hz),
       "record every sample; rows that are left out no map of columns brings back. Or the rig "
       "file's period, or the scale of the speed, if that is what is wrong",
       false});
  return left_out;
}

void FindRate(const RigView& rig, const Columns& columns, const std::vector<LawOfColumn>& laws,
              double left, double rows_apart, RecordErrors& out) {
  const bool exact =
      std::ranges::any_of(laws, [](const LawOfColumn& law) { return law.left < 0.5 * kLawKnown; });
  if (exact) return;
  const std::span<const double> candidates =
      rows_apart > 0.0 ? std::span<const double>(&rows_apart, 1) : std::span(kFactors);
  double best = left;
  double factor = 1.0;
  for (const double candidate : candidates) {
    const PlantFit plant(rig, columns, kRateObserver, false, candidate);
    const Eigen::VectorXd squares = plant.MeanSquares({});
    if (squares.size() == 0) continue;
    const double now = squares.array().log().sum();
    if (!(now < best)) continue;
    best = now;
    factor = candidate;
  }
  if (factor == 1.0 || left - best < kRateGain) return;
  const double rate_hz = 1.0 / rig.period_s;
  out.errors.push_back(
      {RecordErrorKind::kRate,
       {"time"},
       factor,
       std::exp(left - best),
       fmt::format(
           "the rotor moves as if the rows were {:.3g} periods of the rig apart: some {:.4g} "
           "rows a second, the rig samples {:.6g} times",
           factor, rate_hz / factor, rate_hz),
       "record every sample; rows that are left out, or made from others, no map of columns brings "
       "back",
       false});
}

}  // namespace levitas::diagnosis
