// Table of a controller file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "configuration/schema/schema.hpp"
#include "controller/law/law_schedule.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

constexpr std::size_t kMaxFilters = 8;

void Describe(Visitor& v, law::AxisLawConfig& law, double nyquist_hz) {
  const auto below_nyquist = [&](double frequency_hz, std::string_view key) {
    v.RefuseIf(frequency_hz >= nyquist_hz, key,
               fmt::format("found {:.6g} Hz, allowed below half the sampling frequency, {:.6g} Hz",
                           frequency_hz, nyquist_hz));
  };
  v.Number({"kp", kGainP, 0, 1e8, kRequired, "Kp, proportional gain"}, law.kp_a_per_m);
  v.Number({"ki", kGainI, 0, 1e10, kRequired, "Ki, integral gain; it carries the static load"},
           law.ki_a_per_m_s);
  v.Number({"kd", kGainD, 0, 1e6, kRequired, "Kd, derivative gain"}, law.kd_a_s_per_m);
  v.Number(
      {"derivative_corner", kHertz, 1, 1e6, kRequired, "wd of the derivative filter s/(1 + s/wd)"},
      law.derivative_hz);
  below_nyquist(law.derivative_hz, "derivative_corner_hz");
  v.List({"lead_lags", 0, kMaxFilters, "(1 + s/wz)/(1 + s/wp), each"}, law.lead_lags,
         [&](law::LeadLag& filter, std::size_t) {
           v.Number({"zero", kHertz, 0.01, 1e6, kRequired, "wz"}, filter.zero_hz);
           v.Number({"pole", kHertz, 0.01, 1e6, kRequired, "wp"}, filter.pole_hz);
           below_nyquist(filter.zero_hz, "zero_hz");
           below_nyquist(filter.pole_hz, "pole_hz");
         });
  v.List({"notches", 0, kMaxFilters, "(s^2/w^2 + 2 zz s/w + 1)/(s^2/w^2 + 2 zp s/w + 1), each"},
         law.notches, [&](law::Notch& notch, std::size_t) {
           v.Number({"frequency", kHertz, 0.01, 1e6, kRequired, "w"}, notch.frequency_hz);
           v.Number({"zero_damping", kOne, 0, 10, kRequired, "zz, damping ratio of the numerator"},
                    notch.zero_damping);
           v.Number(
               {"pole_damping", kOne, 0.001, 10, kRequired, "zp, damping ratio of the denominator"},
               notch.pole_damping);
           below_nyquist(notch.frequency_hz, "frequency_hz");
           DescribeSwitch(
               v, "prewarp",
               "true: sampled, it stands at this frequency; false: below it, by Tustin's "
               "rule, as the gains of published laws are given",
               notch.prewarp);
         });
}

bool Same(const law::AxisLawConfig& a, const law::AxisLawConfig& b) {
  const auto same_lead = [](const law::LeadLag& p, const law::LeadLag& q) {
    return p.zero_hz == q.zero_hz && p.pole_hz == q.pole_hz;
  };
  const auto same_notch = [](const law::Notch& p, const law::Notch& q) {
    return p.frequency_hz == q.frequency_hz && p.zero_damping == q.zero_damping &&
           p.pole_damping == q.pole_damping && p.prewarp == q.prewarp;
  };
  return a.kp_a_per_m == b.kp_a_per_m && a.ki_a_per_m_s == b.ki_a_per_m_s &&
         a.kd_a_s_per_m == b.kd_a_s_per_m && a.derivative_hz == b.derivative_hz &&
         std::ranges::equal(a.lead_lags, b.lead_lags, same_lead) &&
         std::ranges::equal(a.notches, b.notches, same_notch);
}

// A law under a bearing's name serves both of its axes; under an axis' name it replaces the
// bearing's on that axis, whole. Written under the bearing where both axes are alike.
void DescribeLaws(Visitor& v, std::vector<law::AxisLawConfig>& axes, const RigNumbers& rig) {
  const double nyquist_hz = 0.5 / rig.period_s();
  axes.resize(rig.axes());
  std::string without;
  for (std::size_t bearing = 0; bearing < rig.bearings.size(); ++bearing) {
    const std::size_t x = 2 * bearing;
    const std::size_t end = std::min(x + 2, rig.axes());
    const bool alike = Same(axes[x], axes[end - 1]);
    law::AxisLawConfig both = axes[x];
    bool for_both = alike;
    v.OptionalGroup(rig.bearings[bearing], "law of both axes of this bearing", for_both,
                    [&] { Describe(v, both, nyquist_hz); });
    for (std::size_t axis = x; axis < end; ++axis) {
      if (for_both) axes[axis] = both;
      law::AxisLawConfig own = axes[axis];
      bool present = !alike;
      v.OptionalGroup(rig.channels[axis], "law of this axis alone, instead of its bearing's",
                      present, [&] { Describe(v, own, nyquist_hz); });
      if (present) axes[axis] = own;
      if (!present && !for_both)
        without.append(without.empty() ? "" : ", ").append(rig.channels[axis]);
    }
  }
  v.RefuseIf(!without.empty(), "",
             fmt::format("no law for {}; give one for each bearing or axis of the rig", without));
}

// One law: of the whole file, or of one speed of its schedule.
void DescribeLaw(Visitor& v, std::vector<law::AxisLawConfig>& axes,
                 std::optional<law::StateSpaceConfig>& state_space, const RigNumbers& rig) {
  bool given = state_space.has_value();
  law::StateSpaceConfig blocks = state_space.value_or(law::StateSpaceConfig{});
  v.OptionalGroup("state_space", "one law of any order between all axes, instead of laws", given,
                  [&] { Describe(v, blocks, rig); });
  if (given) state_space = blocks;
  v.When(!given, "without state_space", [&] {
    v.Group("laws", "one for each bearing or axis of the rig", [&] { DescribeLaws(v, axes, rig); });
  });
}

/// What was refused already is not told twice: its number is none, its laws are empty.
bool WasRead(const law::LawAtSpeed& at) {
  return std::isfinite(at.speed_rad_per_s) &&
         (at.state_space || std::ranges::all_of(at.axes, [](const law::AxisLawConfig& axis) {
            return axis.derivative_hz > 0.0;
          }));
}

void DescribeSchedule(Visitor& v, law::LawConfig& law, const RigNumbers& rig) {
  constexpr std::size_t kMostSpeeds = 32;
  constexpr double kFastestRpm = 1e6;
  v.List(
      {"speeds", 1, kMostSpeeds,
       "rising; each with the filters or the blocks of the law before, save where it is exchanged"},
      law.schedule, [&](law::LawAtSpeed& at, std::size_t index) {
        v.Number({"speed", kRpm, 0, kFastestRpm, kRequired, "at which this law holds"},
                 at.speed_rad_per_s);
        DescribeSwitch(
            v, "exchange",
            "true: below this speed the law before stays as it is; here this one, of any "
            "structure, takes over while the rotor is levitated",
            at.exchange);
        DescribeLaw(v, at.axes, at.state_space, rig);
        const law::LawAtSpeed rest{0.0, law.axes, law.state_space};
        const law::LawAtSpeed& before = index == 0 ? rest : law.schedule[index - 1];
        const bool both = WasRead(before) && WasRead(at);
        const std::string why = both ? law::WhyNotAfter(before, at) : "";
        v.RefuseIf(!why.empty(), "speed", why);
      });
}

}  // namespace

void Describe(Visitor& v, ControllerFile& controller, const RigNumbers& rig) {
  v.Name({"name", "of the controller"}, controller.name);
  DescribeLaw(v, controller.law.axes, controller.law.state_space, rig);
  bool scheduled = !controller.law.schedule.empty();
  v.OptionalGroup(
      "schedule",
      "laws of higher speeds: the one above holds at rest, and between two speeds every "
      "number is on the straight line between its values",
      scheduled, [&] { DescribeSchedule(v, controller.law, rig); });
  Describe(v, controller.supervisor);
  bool synchronous = !controller.synchronous.empty();
  v.OptionalGroup("synchronous", "what turns with the rotor, kept out of currents or positions",
                  synchronous, [&] { Describe(v, controller.synchronous, rig); });
  bool saves = !controller.bias.empty();
  v.OptionalGroup("bias_saving",
                  "a bias current that falls while little force is asked for; without it the bias "
                  "stays at the rig's",
                  saves, [&] { Describe(v, controller.bias, rig); });
  controller.law.period_s = rig.period_s();
  controller.law.current_limit_a =
      std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
}

}  // namespace levitas::configuration
