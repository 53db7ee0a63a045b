#pragma once
// Which gains hold the rig: |S| over the proportional and the derivative gain, around a law.
//
// Grid      both gains of every axis times factors from `least` to `most`, logarithmic; the filters
//           and Ki/Kp stay.
// Value     largest |S| of an axis over the plants; infinite where one of the loops is unstable.
// Thread    any; uses one more of its own. Same law, same map.

#include <vector>

#include "design/pid/requirements.hpp"

namespace levitas::design {

struct GainMap {
  std::vector<double> factors;  ///< along both ways
  std::vector<double> peak;     ///< derivative by derivative, proportional factors within
};

struct GainMapOptions {
  double least{0.2};
  double most{5.0};
  std::size_t points{25};  ///< odd: the law itself is one of them
};

[[nodiscard]] GainMap MapGains(const law::LawConfig& law,
                               const std::vector<std::shared_ptr<const SampledPlant>>& plants,
                               const GainMapOptions& options);

}  // namespace levitas::design
