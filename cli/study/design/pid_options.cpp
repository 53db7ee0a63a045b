#include "cli/study/design/pid_options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "cli/study/design/judged_law.hpp"
#include "common/problem.hpp"

namespace levitas::cli {

using design::Limit;

namespace {

void AddLimitOptions(CLI::App& command, PidCommandOptions& options) {
  const auto add = [&](const char* name, double& value, const char* text, double most) {
    return command.add_option(name, value, text)->check(CLI::Range(0.0, most));
  };
  command.add_option("--sensitivity", options.sensitivity, "Limit: |S| of an axis at every speed")
      ->check(CLI::Range(1.0, 100.0))
      ->capture_default_str();
  add("--corner-sensitivity", options.corner_sensitivity,
      "Limit: |S| at the corners of the uncertainty; default: what the check allows", 100.0);
  add("--complementary", options.complementary, "Limit: |T| of an axis; default: 3", 100.0);
  add("--control", options.control_a_per_m, "Limit: |K S| of an axis [A/m]", 1e9);
  add("--singular-value", options.singular, "Limit: largest singular value of S; default: 4",
      100.0);
  add("--damping", options.damping_percent,
      "Limit: least damping of every mode [%], corners of the uncertainty included; default: 0.15, "
      "or 0.4 of the rig's own",
      100.0);
  add("--standing-orbit", options.standing_um,
      "Limit [um]: three deviations of what noise moves; default: the rig's objective", 1e6);
  add("--spinning-orbit", options.spinning_um,
      "Limit [um]: orbit of the unbalance and the same; default: the rig's objective", 1e6);
  add("--current", options.current_a,
      "Limit [A]: static, synchronous, three deviations of noise; default: what the coils allow",
      1e4);
  add("--noise-current", options.noise_a,
      "Limit [A]: rms of noise; default: a quarter of what the coils allow", 1e4);
  add("--stiffness", options.stiffness_n_per_m,
      "Limit [N/m]: least static stiffness of an axis, without its integrator", 1e12);
  add("--compliance", options.compliance_um_per_n,
      "Limit [um/N]: what a force at a magnet moves at any frequency; default: none, or a fifth "
      "of what it moves without control where the rig stands without",
      1e9);
}

}  // namespace

design::PidLimits LimitsOf(const PidCommandOptions& options, const configuration::RigFile& rig) {
  auto out = design::UsualLimits(rig, options.search.current_limit_a);
  out[Limit::kSensitivity] = options.sensitivity;
  out[Limit::kCornerSensitivity] = options.gate.sensitivity;
  const auto ask = [&](Limit limit, double value) {
    if (value > 0.0) out[limit] = value;
  };
  ask(Limit::kCornerSensitivity, options.corner_sensitivity);
  ask(Limit::kDamping, 0.01 * options.damping_percent);
  ask(Limit::kComplementary, options.complementary);
  ask(Limit::kControl, options.control_a_per_m);
  ask(Limit::kSingular, options.singular);
  ask(Limit::kStanding, 1e-6 * options.standing_um);
  ask(Limit::kSpinning, 1e-6 * options.spinning_um);
  ask(Limit::kCurrent, options.current_a);
  ask(Limit::kNoise, options.noise_a);
  ask(Limit::kStiffness, options.stiffness_n_per_m);
  ask(Limit::kCompliance, 1e-6 * options.compliance_um_per_n);
  if (options.search.first_levitation)
    out[Limit::kAnyMode] = 0.01 * options.unknown_damping_percent;
  return out;
}

namespace {

/// Held filters lie where a search may put filters, and belong to those that were asked for.
void RefuseHeld(const char* option, const std::vector<double>& at_hz, const char* many,
                std::size_t most, double period_s) {
  if (at_hz.size() > most)
    throw Problem(ExitStatus::kUsage, fmt::format("{} names {} filters, but there are {} ({})",
                                                  option, at_hz.size(), most, many));
  const double highest_hz = design::kHighestCornerShare / period_s;
  for (const double hz : at_hz)
    if (!(hz >= design::kLowestCornerHz && hz <= highest_hz))
      throw Problem(ExitStatus::kUsage,
                    fmt::format("{}: found {:g} Hz, allowed {:g} to {:g} Hz at this sampling rate",
                                option, hz, design::kLowestCornerHz, highest_hz));
}

}  // namespace

void CompleteSearch(const configuration::RigFile& rig, PidCommandOptions& options) {
  const auto& search = options.search;
  const double period_s = rig.numbers.period_s();
  RefuseHeld("--lead-lag-hz", search.lead_lags_at_hz, "--lead-lags", search.lead_lags, period_s);
  RefuseHeld("--notch-hz", search.notches_at_hz, "--notches", search.notches, period_s);
  options.search.current_limit_a = ControlLimitA(rig.numbers);
  options.search.seed = options.gate.seed;
  options.search.third_n = options.gate.third_n;
  options.search.own_filters = !options.shared_filters;
}

void AddPidSearchOptions(CLI::App& command, PidCommandOptions& options) {
  AddLimitOptions(command, options);
  command
      .add_option("--evaluations", options.search.evaluations,
                  "Laws tried; of a schedule for each entry")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  command.add_option("--lead-lags", options.search.lead_lags, "Of each axis")
      ->check(CLI::Range(0, 4))
      ->capture_default_str();
  command.add_option("--notches", options.search.notches, "Of each axis")
      ->check(CLI::Range(0, 4))
      ->capture_default_str();
  command
      .add_option("--lead-lag-hz", options.search.lead_lags_at_hz,
                  "Hold a lead-lag about this frequency [Hz], where its lead or lag is largest; "
                  "several by commas, no more than --lead-lags")
      ->delimiter(',');
  command
      .add_option("--notch-hz", options.search.notches_at_hz,
                  "Hold a notch at this frequency [Hz]; several by commas, no more than --notches")
      ->delimiter(',');
  command.add_flag("--shared-filters", options.shared_filters,
                   "One derivative corner, lead-lag and set of notches for all bearings");
}

}  // namespace levitas::cli
