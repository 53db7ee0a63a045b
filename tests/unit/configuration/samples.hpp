#pragma once
// Small complete files for the tests, and what is wrong with a text.

#include <string>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::configuration::test {

/// A rig of one bearing; each line is a key, so that a test can replace one.
inline constexpr const char* kRig = R"(kind: rig
name: small
sampling:
  period_us: 100
coils:
  bias_current_a: 1
  max_current_a: 2
rotor:
  material:
    young_gpa: 200
    poisson: 0.3
    density_kg_per_m3: 7800
  sections:
    - length_mm: 200
      outer_diameter_mm: 20
bearings:
  - name: de
    actuator_z_mm: 100
    sensor_z_mm: 110
    magnet:
      gap_mm: 0.4
      ki_n_per_a: 40
    amplifier:
      bandwidth_hz: 1000
    sensor:
      bandwidth_hz: 5000
      noise_rms_um: 1
      range_um: 300
    touchdown:
      clearance_um: 200
      stiffness_n_per_m: 1e7
      damping_n_s_per_m: 500
      friction: 0.15
      journal_radius_mm: 12
drive:
  max_speed_rpm: 6000
  max_acceleration_rpm_per_s: 1000
  coast_down_1_per_s: 0.02
  friction_rpm_per_s: 20
objectives:
  standing_orbit_um: 7
  spinning_orbit_um: 36
)";

inline constexpr const char* kController = R"(kind: controller
name: small
laws:
  de:
    kp_a_per_m: 5000
    ki_a_per_m_s: 20000
    kd_a_s_per_m: 10
    derivative_corner_hz: 1800
    lead_lags:
      - zero_hz: 900
        pole_hz: 1800
    notches:
      - frequency_hz: 450
        zero_damping: 0.6
        pole_damping: 0.8
)";

inline constexpr const char* kScenario = R"(kind: scenario
name: small
steps:
  - do: lift
    until: levitating
    timeout_s: 5
    hold_s: 1
  - do: spin
    speed_rpm: 3000
    acceleration_rpm_per_s: 1000
    until: speed_reached
    timeout_s: 6
)";

/// `text` with the first `from` replaced; the test is wrong if there is none.
inline std::string With(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("test: no \"" + from + "\" in the sample");
  return text.replace(at, from.size(), to);
}

inline RigNumbers SmallRig() { return ParseRig(kRig, "small.yaml").numbers; }

/// What is said about a rig text; empty if it is fine.
inline std::string RigProblems(const std::string& text) {
  try {
    (void)ParseRig(text, "rig.yaml");
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "";
}

inline std::string ControllerProblems(const std::string& text) {
  try {
    (void)ParseController(text, "controller.yaml", SmallRig());
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "";
}

inline std::string ScenarioProblems(const std::string& text) {
  try {
    (void)ParseScenario(text, "scenario.yaml", SmallRig());
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "";
}

}  // namespace levitas::configuration::test
