#include "identification/frf/flat_top.hpp"

#include <algorithm>
#include <vector>

namespace levitas::identification {
namespace {

constexpr std::ptrdiff_t kMore = 5;

/// Of sorted values, from one end.
template <class Iterator>
double FlatAt(Iterator begin, Iterator end) {
  const auto next = std::find_if(begin, end, [&](double value) { return value != *begin; });
  if (next == end) return 0.0;  // dead, not clipped
  const auto beyond = std::find_if(next, end, [&](double value) { return value != *next; });
  const bool flat = next - begin > kMore * (beyond - next);
  return flat ? static_cast<double>(next - begin) / static_cast<double>(end - begin) : 0.0;
}

}  // namespace

double FlatShare(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return std::max(FlatAt(sorted.cbegin(), sorted.cend()), FlatAt(sorted.crbegin(), sorted.crend()));
}

}  // namespace levitas::identification
