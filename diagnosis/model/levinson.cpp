#include "diagnosis/model/levinson.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace levitas::diagnosis {

std::vector<double> WhiteningFilter(const std::vector<double>& correlation, double count) {
  std::vector<double> a{1.0};
  a.reserve(correlation.size());
  double power = correlation.front();
  for (std::size_t k = 1; k < correlation.size() && power > 0.0; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < k; ++i) sum += a[i] * correlation[k - i];
    const double reflection = -sum / power;
    std::vector<double> next(a);
    next.push_back(0.0);
    for (std::size_t i = 1; i <= k; ++i) next[i] += reflection * (i == k ? 1.0 : a[k - i]);
    a = next;
    power *= 1.0 - reflection * reflection;
  }
  a.resize(correlation.size(), 0.0);
  const double rms = std::sqrt(std::max(0.0, power) / std::max(1.0, count));
  for (double& c : a) c /= rms > 0.0 ? rms : 1.0;
  return a;
}

}  // namespace levitas::diagnosis
