#include "report/signature/orders.hpp"

#include <cmath>
#include <numbers>

namespace levitas::signature {

std::vector<std::complex<double>> Difference(const std::vector<std::complex<double>>& a,
                                             const std::vector<std::complex<double>>& b) {
  std::vector<std::complex<double>> difference(a);
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= b.at(i);
  return difference;
}

svg::Series OrderSpectrum(const std::vector<std::complex<double>>& orbit, const Orders& orders,
                          const std::string& name, std::size_t colour) {
  svg::Series series;
  series.name = name;
  series.colour = svg::Colour(colour);
  const auto count = static_cast<double>(orbit.size());
  const int most = orders.most * orders.turns;
  for (int bin = -most; bin <= most; ++bin) {
    const std::complex<double> back = std::polar(1.0, -2.0 * std::numbers::pi * bin / count);
    std::complex<double> turning = 1.0;
    std::complex<double> sum = 0.0;
    for (const std::complex<double> r : orbit) {
      sum += r * turning;
      turning *= back;
    }
    series.x.push_back(static_cast<double>(bin) / orders.turns);
    series.y.push_back(std::abs(sum) / count * orders.unit);
  }
  return series;
}

}  // namespace levitas::signature
