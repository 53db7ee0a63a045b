#include "diagnosis/inference/fit_gain.hpp"

#include <cmath>

namespace levitas::diagnosis {
namespace {

constexpr double kBlockS = 0.05;

double Square(const Whitener& whitener, const Trajectory& run, std::size_t n) {
  double sum = 0.0;
  for (std::size_t a = 0; a < whitener.filter.size(); ++a) {
    double e = 0.0;
    for (std::size_t k = 0; k <= whitener.order; ++k) {
      e += whitener.filter[a][k] * static_cast<double>(run.moments[n - k].innovation_m[a]);
    }
    sum += e * e;
  }
  return sum;
}

double Squared(double value) { return value * value; }

}  // namespace

std::size_t BlockRows(const RigView& rig) {
  return static_cast<std::size_t>(std::lround(kBlockS / rig.period_s));
}

FitGain GainOfBlocks(const std::vector<double>& blocks) {
  FitGain gain;
  const auto count = static_cast<double>(blocks.size());
  for (const double block : blocks) gain.value += block;
  if (blocks.size() < 2) return gain;
  double scatter = 0.0;
  for (const double block : blocks) scatter += Squared(block - gain.value / count);
  gain.deviation = std::sqrt(scatter * count / (count - 1.0));
  return gain;
}

FitGain GainedFit(const std::vector<Trajectory>& first, const std::vector<Trajectory>& second,
                  const Whitener& whitener, std::size_t rows) {
  std::vector<double> blocks;
  for (std::size_t r = 0; r < first.size() && r < second.size(); ++r) {
    std::size_t filled = rows;
    for (std::size_t n = whitener.order; n < first[r].moments.size(); ++n) {
      if (!first[r].moments[n].counts) continue;
      if (filled++ >= rows) {
        blocks.push_back(0.0);
        filled = 1;
      }
      blocks.back() += Square(whitener, first[r], n) - Square(whitener, second[r], n);
    }
  }
  return blocks.size() < 2 ? FitGain{} : GainOfBlocks(blocks);
}

double CameBack(const std::vector<Term>& terms, const std::vector<double>& calibrated,
                const std::vector<double>& extended, const std::vector<Hypothesis>& causes) {
  double back = 0.0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Term& term = terms[i];
    if (!term.nuisance()) continue;
    back += Squared((calibrated[i] - term.healthy_mean) / term.tolerance);
    if (!Moves(causes, i)) back -= Squared((extended[i] - term.healthy_mean) / term.tolerance);
  }
  return back;
}

void DropUngained(RecordLandscape& landscape, const Judging& judging, CauseSelection& found) {
  if (found.causes.empty()) return;
  const auto runs = landscape.RunAt(found.point);
  const FitGain gain = GainedFit(*found.calibrated_runs, runs, landscape.view().whitener,
                                 BlockRows(landscape.rig()));
  const double back =
      CameBack(landscape.terms(), found.calibrated.theta, found.point.theta, found.causes);
  if (gain.value + back > judging.gain_deviations * gain.deviation) return;
  found.causes.clear();
  found.point = found.WithoutCauses();
  landscape.LineariseAt(found.point);
  found.calibrated_runs = landscape.view().runs;
}

}  // namespace levitas::diagnosis
