#include "diagnosis/report/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "common/rotational_speed.hpp"
#include "diagnosis/report/separations.hpp"
#include "diagnosis/report/validation_check.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

/// A maximum-length sequence of order 12 on every axis in turn.
std::string TestSignals(const std::vector<std::string>& channels, int divisor, double period_s) {
  std::string text;
  const double hold_s = 2.0 * 4095.0 * divisor * period_s;
  for (const std::string& channel : channels) {
    text += fmt::format(
        "  - do: nothing\n    hold_s: {:.3f}\n    excitation:\n"
        "      - {{channel: {}, amplitude_a: 0.1, order: 12, divisor: {}}}\n",
        hold_s, channel, divisor);
  }
  return text;
}

std::string Spin(double rpm, double hold_s, double rate_rpm_per_s, double most_rpm) {
  return fmt::format(
      "  - do: spin\n    speed_rpm: {:.0f}\n    acceleration_rpm_per_s: {:.0f}\n"
      "    until: speed_reached\n    timeout_s: {:.0f}\n    hold_s: {:.1f}\n",
      rpm, rate_rpm_per_s, 5.0 + 3.0 * most_rpm / rate_rpm_per_s, hold_s);
}

}  // namespace

std::string PlanScenario(const DiagnosisReport& s, const configuration::RigFile& rig) {
  std::vector<std::string> effects = s.also_possible;
  for (const ReportCause& cause : s.causes) effects.push_back(cause.effect);
  const bool sound = s.verdict == Verdict::kNone;
  const std::vector<effect::Id> ids = effect::IdsOf(effects);
  const bool turning = std::any_of(
      ids.begin(), ids.end(), [](effect::Id id) { return effect::At(id).facts.needs_rotation; });
  const bool rotating = effects.empty() || turning || s.validation_is_faster;
  const bool fast =
      std::any_of(ids.begin(), ids.end(), NeedsFastSignal) || (sound && !s.coverage.excited);
  const std::vector<std::string>& channels = rig.numbers.channels;
  const double period_s = 1e-9 * static_cast<double>(rig.plant.period_ns);
  const double most_rpm = RadPerSToRpm(rig.numbers.max_speed_rad_per_s);
  const double rate = RadPerSToRpm(0.5 * rig.plant.drive.max_acceleration_rad_per_s2);
  std::string text = "kind: scenario\nname: diagnosis_next\n\n";
  if (!PassesValidation(s)) {
    text += fmt::format("# For a model that carries over: {}.\n", s.next_experiment);
  } else if (sound) {
    const std::string& lacks = s.coverage.missing_records;
    text +=
        fmt::format("# What the records lack: {}.\n", lacks.empty() ? s.next_experiment : lacks);
  } else if (effects.empty()) {
    text += "# To learn where the residual belongs.\n";
  } else {
    text += fmt::format("# To separate {}:\n# {}.\n", fmt::join(effects, ", "), s.next_experiment);
  }
  text += "steps:\n  - {do: lift, until: levitating, timeout_s: 10, hold_s: 1}\n";
  text += TestSignals(channels, fast ? 1 : 2, period_s);
  if (rotating && most_rpm > 0.0) {
    text += Spin(0.08 * most_rpm, 3.0, rate, most_rpm);
    text += Spin(0.5 * most_rpm, 1.0, rate, most_rpm);
    text += TestSignals(channels, 2, period_s);
    text += Spin(0.95 * most_rpm, 2.0, rate, most_rpm);
    text += fmt::format(
        "  - do: spin\n    speed_rpm: 0\n    acceleration_rpm_per_s: {:.0f}\n"
        "    until: standstill\n    timeout_s: {:.0f}\n",
        rate, 10.0 + 3.0 * most_rpm / rate);
  }
  return text + "  - {do: land, until: off, timeout_s: 10, hold_s: 0.2}\n";
}

}  // namespace levitas::diagnosis
