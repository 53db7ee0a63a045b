#include "diagnosis/levitator/report_values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "diagnosis/levitator/origin.hpp"
#include "diagnosis/report/effect_entry.hpp"
#include "numerics/normal_distribution.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::levitator {
namespace {

/// A key of the rig file, and the value under it as a function of a parameter of the table.
struct FileKey {
  std::string key;
  std::function<double(double)> value;
};

FileKey Scaled(std::string key, double by) {
  return {std::move(key), [by](double t) { return by * t; }};
}

FileKey KeyOf(const configuration::RigFile& rig, std::size_t i) {
  const Row& row = Table()[i];
  switch (static_cast<Parameter>(i)) {
    case kDelay:
      return {"delay_samples", [file = rig.plant.delay_samples](double t) { return file + t; }};
    case kForceKnee:
      return {"knee_a", [](double t) { return 1.0 / std::sqrt(std::max(1e-9, t)); }};
    case kForceLag:
      return Scaled("tau_us", 1e6);
    case kSensorOffset:
      return Scaled("offset_um", 1e6);
    case kSensorSquare:
      return Scaled("a2_1_per_m", 1.0);
    case kSensorCube:
      return Scaled("a3_1_per_m2", 1.0);
    case kSensorLag:
      return {"bandwidth_hz", [hz = rig.plant.bearings.at(0).sensor.bandwidth_hz](double t) {
                const double lag_s = 1.0 / (2.0 * std::numbers::pi * hz) + t;
                return 1.0 / (2.0 * std::numbers::pi * std::max(1e-9, lag_s));
              }};
    case kLoad:
      return Scaled("force_x_n", 1.0);
    case kSpring:
      return Scaled("direct_n_per_m", 1.0);
    case kSupply:
    case kResistance:
    case kInductance:
    case kProfile:
    case kIronInductance:
    case kDeadBand:
    case kCommandUpper:
    case kCommandLower:
    case kDriveCurve:
    case kHeating:
    case kMotionEmf:
    case kEddyShare:
    case kMutual:
    case kAwaySupply:
    case kAwayInductance:
    case kProbeGain:
    case kProbeOffset:
    case kProbeLag:
    case kForce:
    case kForceDecay:
    case kForceExponent:
    case kForceAway:
    case kSensorGain:
    case kMass:
    case kDamping:
    case kDryFriction:
      break;  // as the table names it
    case kParameters:
      throw std::logic_error("no parameter of the levitator");
  }
  const double base = row.name.starts_with("ratio") ? 1.0 : 0.0;
  return {std::string(row.name), [base](double t) { return base + t; }};
}

/// The same for a parameter that was fitted relative to an origin.
FileKey KeyBeside(const configuration::RigFile& rig, const Theta& origin, std::size_t i) {
  FileKey whole = KeyOf(rig, i);
  const auto beside = [value = whole.value, i, from = origin[i]](double t) {
    return value(ComposedWith(i, from, t));
  };
  return {whole.key, beside};
}

std::string UnitOf(const FileKey& file_key, const Row& row) {
  const std::string symbol = diagnosis::UnitOfKey(file_key.key).symbol;
  return symbol.empty() ? std::string(row.unit) : symbol;
}

diagnosis::NamedParameter ParameterOf(const configuration::RigFile& rig, const Theta& origin,
                                      std::size_t i, const Fitted& fit) {
  const Row& row = Table()[i];
  const FileKey file_key = KeyBeside(rig, origin, i);
  const double spread = numerics::kInterval90 * fit.deviation[i];
  diagnosis::NamedParameter p;
  p.effect = effect::At(row.effect).name;
  p.key = file_key.key;
  p.location = diagnosis::AtAxis(rig.numbers, 0);
  p.name = fmt::format("{}[{}]", p.key, p.location.name);
  p.unit = UnitOf(file_key, row);
  p.si = diagnosis::UnitOfKey(p.key).si;
  p.value = file_key.value(fit.theta[i]);
  const double one = file_key.value(fit.theta[i] - spread);
  const double other = file_key.value(fit.theta[i] + spread);
  p.low = std::min(one, other);
  p.high = std::max(one, other);
  if (i == kDelay) p.of_file = diagnosis::OfFile{rig.plant.delay_samples, p.value};
  return p;
}

diagnosis::CalibratedValue CalibratedOf(const configuration::RigFile& rig, const Theta& origin,
                                        std::size_t i, const Fitted& fit) {
  const Row& row = Table()[i];
  const FileKey file_key = KeyBeside(rig, origin, i);
  const double theta = fit.theta[i];
  const double deviation = fit.deviation[i];
  diagnosis::CalibratedValue v;
  v.effect = effect::At(row.effect).name;
  v.place = rig.numbers.channels.front();
  v.key = file_key.key;
  v.unit = UnitOf(file_key, row);
  v.nominal = v.expected = file_key.value(0.0);
  v.calibrated = file_key.value(theta);
  v.deviation =
      0.5 * std::abs(file_key.value(theta + deviation) - file_key.value(theta - deviation));
  v.tolerance = 0.5 * std::abs(file_key.value(row.tolerance) - file_key.value(-row.tolerance));
  v.moved = v.from_file = std::abs(theta) / row.tolerance;
  v.proven = deviation > 0.0 ? std::abs(theta) / deviation : 0.0;
  return v;
}

}  // namespace

std::vector<diagnosis::NamedParameter> ReportParameters(const configuration::RigFile& rig,
                                                        const Theta& origin, const Found& found) {
  std::vector<diagnosis::NamedParameter> parameters;
  for (const diagnosis::Hypothesis& cause : found.causes) {
    for (const std::size_t i : cause.terms) {
      parameters.push_back(ParameterOf(rig, origin, i, found.extended));
    }
  }
  return parameters;
}

std::vector<diagnosis::CalibratedValue> ReportCalibration(const configuration::RigFile& rig,
                                                          const Theta& origin, const Found& found) {
  std::vector<bool> named(kParameters, false);
  for (const diagnosis::Hypothesis& cause : found.causes) {
    for (const std::size_t i : cause.terms) named[i] = true;
  }
  std::vector<diagnosis::CalibratedValue> calibrated;
  for (std::size_t i = 0; i < kParameters; ++i) {
    if (Table()[i].tolerance > 0.0 && !named[i]) {
      calibrated.push_back(CalibratedOf(rig, origin, i, found.extended));
    }
  }
  std::stable_sort(calibrated.begin(), calibrated.end(),
                   [](const auto& a, const auto& b) { return a.moved > b.moved; });
  return calibrated;
}

}  // namespace levitas::levitator
