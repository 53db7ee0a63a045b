#pragma once
// The published law of the flexible rotor's drive-end axes (Sahinkaya & Sawicki rig), for tests.

#include "controller/law/law_config.hpp"

namespace levitas::law {

inline constexpr double kPeriodS = 1e-4;

inline AxisLawConfig FlexibleRotorAxis(double scale = 1.0) {
  AxisLawConfig axis;
  axis.kp_a_per_m = 4514.47 * scale;
  axis.ki_a_per_m_s = 24128.6 * scale;
  axis.kd_a_s_per_m = 13.0414 * scale;
  axis.derivative_hz = 1868.85;
  axis.lead_lags = {{916.816, 1801.41}};
  axis.notches = {{449.181, 0.6458, 0.8256}, {862.316, 0.2442, 0.8139}};
  return axis;
}

inline LawConfig FlexibleRotorLaw() {
  return {{FlexibleRotorAxis(), FlexibleRotorAxis(), FlexibleRotorAxis(2.1294),
           FlexibleRotorAxis(2.1294)},
          kPeriodS,
          1.0,
          {}};
}

}  // namespace levitas::law
