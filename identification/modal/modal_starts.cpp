#include "identification/modal/modal_starts.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "identification/modal/modal_quality.hpp"

namespace levitas::identification {

Eigen::VectorXd RandomStart(const ModalStart& start, const std::vector<bool>& fitted,
                            const StartSpread& spread, Random& random) {
  const ModalLayout& at = start.frame.layout;
  Eigen::VectorXd vector = start.vector;
  for (Eigen::Index k = 0; k < at.size; ++k) {
    if (!fitted[static_cast<std::size_t>(k)]) continue;
    const bool gain = k >= at.ki && k < at.delay;
    const double width = gain ? spread.gains : spread.everything;
    const double factor = 1.0 + width * (2.0 * random.Uniform() - 1.0);
    const bool linear =
        k == at.centre || k == at.delay || k >= at.gyroscopic || (k >= at.shape && k < at.ki);
    if (linear) {
      vector[k] *= factor;
    } else {
      vector[k] += std::log(factor);
    }
  }
  return vector;
}

double Apart(const ModalResult& one, const ModalResult& other,
             const std::vector<FrequencyResponse>& responses) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (!one.quality[i].fitted) continue;
    // The other's plant takes the place of the data, their variance stays.
    FrequencyResponse between = responses[i];
    const auto theirs = ModelOn(other.start, other.fit.vector, responses[i]);
    const auto own = ModelOn(one.start, one.fit.vector, responses[i]);
    std::vector<Eigen::MatrixXcd> shifted(own.size());
    for (std::size_t k = 0; k < own.size(); ++k) {
      shifted[k] = between.plant[k] + own[k] - theirs[k];
    }
    sum += Misfit(between, shifted, one.options);
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

StartsOutcome TryStarts(const ModalResult& reference,
                        const std::vector<FrequencyResponse>& responses, int starts,
                        const StartSpread& spread, std::uint64_t seed) {
  Random random(seed);
  StartsOutcome outcome;
  outcome.starts = starts;
  std::vector<double> times_s;
  for (int n = 0; n < starts; ++n) {
    const auto began = std::chrono::steady_clock::now();
    const ModalResult result = IdentifyModal(
        reference.start, RandomStart(reference.start, reference.fit.fitted, spread, random),
        reference.stabilisation, responses, reference.options);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    times_s.push_back(took.count());
    outcome.apart.push_back(Apart(result, reference, responses));
    const bool cost = std::abs(result.fit.cost / reference.fit.cost - 1.0) < kSameCost;
    if (cost && outcome.apart.back() < kSameOptimum) ++outcome.same;
  }
  if (!times_s.empty()) {
    std::ranges::sort(times_s);
    outcome.median_time_s = times_s[times_s.size() / 2];
  }
  return outcome;
}

}  // namespace levitas::identification
