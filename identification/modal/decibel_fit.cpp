#include "identification/modal/decibel_fit.hpp"

#include <algorithm>
#include <cmath>

#include "common/two_pi.hpp"
#include "identification/modal/fit_stages.hpp"
#include "identification/modal/modal_quality.hpp"
#include "identification/modal/modal_response.hpp"
#include "identification/modal/working_gains.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kAroundExtremeHz = 5.0;
constexpr double kNoiseRules = 1.0 / 3.0;
constexpr int kIterations = 100;

double Standing(double speed_rad_per_s) {
  return std::abs(speed_rad_per_s) < 1.0 ? 0.0 : speed_rad_per_s;
}

/// The rig by itself, as the cost in decibels has it: without the magnets' working gains.
std::vector<Eigen::MatrixXcd> PlainModel(const ModalFrame& frame, const Physical& rig,
                                         const FrequencyResponse& response) {
  std::vector<Eigen::MatrixXcd> lines;
  lines.reserve(response.frequency_hz.size());
  const double speed = Standing(response.speed_rad_per_s);
  for (const double f : response.frequency_hz) lines.push_back(ModalResponse(frame, rig, f, speed));
  return lines;
}

/// Frequencies at which an entry of the model is larger, or smaller, than on both lines beside.
std::vector<double> ExtremesHz(const std::vector<Eigen::MatrixXcd>& model,
                               const std::vector<double>& frequency_hz, Index i, Index j) {
  std::vector<double> found;
  const auto size = [&](std::size_t k) { return std::norm(model[k](i, j)); };
  for (std::size_t k = 1; k + 1 < model.size(); ++k) {
    const double rise = size(k) - size(k - 1);
    const double fall = size(k + 1) - size(k);
    if (rise * fall < 0.0) found.push_back(frequency_hz[k]);
  }
  return found;
}

DecibelRegion RegionOf(const FrequencyResponse& response, std::size_t line, Index i, Index j,
                       const std::vector<double>& extremes_hz) {
  const double deviation = std::sqrt(response.variance[line](i, j));
  if (deviation > kNoiseRules * std::abs(response.plant[line](i, j))) return DecibelRegion::kNoisy;
  const double f = response.frequency_hz[line];
  const bool marked = std::ranges::any_of(
      extremes_hz, [f](double at) { return std::abs(f - at) <= kAroundExtremeHz; });
  return marked ? DecibelRegion::kMarked : DecibelRegion::kOther;
}

std::size_t RegionOfWeight(double weight) {
  return static_cast<std::size_t>(std::ranges::find(kDecibelWeights, weight) -
                                  kDecibelWeights.begin());
}

using Sums = std::array<double, kDecibelRegions>;

DecibelLeft LeftBy(const Sums& squares, const Sums& counts) {
  DecibelLeft left;
  double cost = 0.0;
  double weights = 0.0;
  for (std::size_t r = 0; r < kDecibelRegions; ++r) {
    const double weight = kDecibelWeights[r] * kDecibelWeights[r];
    left.rms_db[r] = counts[r] > 0.0 ? std::sqrt(squares[r] / counts[r]) : 0.0;
    cost += weight * squares[r];
    weights += weight * counts[r];
  }
  left.weighted_rms_db = weights > 0.0 ? std::sqrt(cost / weights) : 0.0;
  return left;
}

struct Judged {
  DecibelLeft left;
  Sums share;
};

using Lines = std::vector<Eigen::MatrixXcd>;

Judged Judge(const Lines& model, const FrequencyResponse& response,
             const std::vector<Eigen::MatrixXd>& weights) {
  Sums squares{};
  Sums counts{};
  for (std::size_t k = 0; k < model.size(); ++k) {
    for (Index e = 0; e < weights[k].size(); ++e) {
      const double weight = weights[k].data()[e];
      if (weight == 0.0) continue;
      const std::size_t region = RegionOfWeight(weight);
      const double off_db =
          10.0 * std::log10(std::norm(model[k].data()[e]) / std::norm(response.plant[k].data()[e]));
      squares[region] += off_db * off_db;
      counts[region] += 1.0;
    }
  }
  Judged judged{LeftBy(squares, counts), counts};
  const double all = counts[0] + counts[1] + counts[2];
  for (double& share : judged.share) share /= std::max(all, 1.0);
  return judged;
}

std::size_t FreeIn(const ModalFit& fit) {
  return static_cast<std::size_t>(std::ranges::count(fit.fitted, true));
}

}  // namespace

std::vector<Eigen::MatrixXd> DecibelWeights(const ModalFrame& frame, const Physical& rig,
                                            const FrequencyResponse& response,
                                            const ModalFitOptions& options) {
  const auto model = PlainModel(frame, rig, response);
  const std::vector<double>& f = response.frequency_hz;
  const double least_hz =
      std::max(options.lowest_hz, std::abs(Standing(response.speed_rad_per_s)) / kTwoPi);
  const Index axes = response.axes();
  std::vector<Eigen::MatrixXd> weights(f.size(), Eigen::MatrixXd::Zero(axes, axes));
  for (Index j = 0; j < axes; ++j) {
    for (Index i = j % 2; i < axes; i += 2) {
      const std::vector<double> extremes_hz = ExtremesHz(model, f, i, j);
      for (std::size_t k = 0; k < f.size(); ++k) {
        if (f[k] < least_hz || f[k] > options.highest_hz) continue;
        const auto region = static_cast<std::size_t>(RegionOf(response, k, i, j, extremes_hz));
        weights[k](i, j) = kDecibelWeights[region];
      }
    }
  }
  return weights;
}

DecibelFit FitDecibels(const ModalResult& modal, const std::vector<FrequencyResponse>& responses) {
  const ModalFrame& frame = modal.start.frame;
  std::vector<const FrequencyResponse*> fitted{&responses.front()};
  if (responses.size() > 1) fitted.push_back(&responses.back());
  ModalFit fit = modal.fit;
  Search search(modal.start, modal.fit.assigned, modal.options, fit);
  DecibelFit found;
  std::vector<std::vector<Eigen::MatrixXd>> weights;
  for (const FrequencyResponse* response : fitted)
    weights.push_back(DecibelWeights(frame, modal.rig, *response, modal.options));
  for (std::size_t n = 0; n < fitted.size(); ++n) {
    const FitData data{*fitted[n], WorkingGainsOf(frame, *fitted[n])};
    search.Run({.name = n == 0 ? "decibels" : "gyroscopic matrix, decibels",
                .data = {&data},
                .kind = LineKind::kLogMagnitude,
                .rig_free = n == 0,
                .gyroscopic_free = n > 0,
                .iterations = kIterations,
                .marks = &weights[n]});
    (n == 0 ? found.standing : found.gyroscopic) = {FreeIn(fit), fit.converged};
  }
  found.rig = ToPhysical(frame, fit.vector);
  for (std::size_t n = 0; n < fitted.size(); ++n) {
    // Each by the model that it was fitted with.
    const auto modal_lines = ModelOn(modal.start, modal.fit.vector, *fitted[n]);
    const auto own_lines = PlainModel(frame, found.rig, *fitted[n]);
    const Judged own = Judge(own_lines, *fitted[n], weights[n]);
    found.speeds.push_back({fitted[n]->speed_rad_per_s, own.share,
                            Judge(modal_lines, *fitted[n], weights[n]).left, own.left,
                            Misfit(*fitted[n], modal_lines, modal.options),
                            Misfit(*fitted[n], own_lines, modal.options)});
  }
  return found;
}

}  // namespace levitas::identification
