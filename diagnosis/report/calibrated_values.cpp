#include "diagnosis/report/named_values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "diagnosis/diagnose/diagnose_files.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kProbe = 1e-3;  ///< does a key depend on it?

/// The key of a harmonic's size, and its phase.
void TakeKeyAndPhase(const EntryValues& values, CalibratedValue& v) {
  for (const EntryValue& value : values) {
    const bool size = value.key != "order" && value.key != "z_mm" && value.key != "frequency_hz";
    if (value.key == kPhaseKey) {
      v.phase_rad = value.number * UnitOfKey(kPhaseKey).si;
    } else if (size) {
      v.key = value.key;
    }
  }
}

/// Standard deviations and tolerances of the terms at one place.
class Calibrated {
 public:
  Calibrated(const DiagnosisResult& s, const PlacedEffect& at) : s_(s), at_(at) {}

  void AddTo(std::vector<CalibratedValue>& out) const {
    if (at_.theta.contains("cosine")) {
      AddHarmonic(out);
      return;
    }
    for (const auto& [parameter, theta] : at_.theta) {
      const std::size_t index = at_.term.at(parameter);
      const Term* term = &s_.terms[index];
      const Estimate* estimate = EstimateOf(s_.answer.calibration, index);
      if (estimate == nullptr) continue;
      CalibratedValue v = Named(parameter);
      const auto value = Law(parameter, v);
      v.nominal = value(0.0);
      v.expected = value(term->healthy_mean);
      v.calibrated = value(theta);
      v.deviation =
          0.5 * std::abs(value(theta + estimate->deviation) - value(theta - estimate->deviation));
      v.tolerance = 0.5 * std::abs(value(term->healthy_mean + term->tolerance) -
                                   value(term->healthy_mean - term->tolerance));
      v.moved = std::abs(theta - term->healthy_mean) / term->tolerance;
      v.proven = estimate->deviation > 0.0
                     ? std::abs(theta - term->healthy_mean) / estimate->deviation
                     : 0.0;
      v.from_file = std::abs(theta) / FileTolerance(*term);
      v.learned = std::abs(term->healthy_mean) / FileTolerance(*term);
      out.push_back(v);
    }
  }

 private:
  [[nodiscard]] CalibratedValue Named(const std::string& parameter) const {
    CalibratedValue v;
    v.effect = at_.effect_name();
    v.place = at_.location.name;
    if (!at_.effect) {
      v.effect = parameter == "shape" ? "modal_shape" : "shaft_" + parameter;
      v.key = parameter == "shape" ? "share" : "ratio";
    }
    return v;
  }

  /// Before healthy records narrowed it.
  [[nodiscard]] double FileTolerance(const Term& term) const {
    const auto at = static_cast<std::size_t>(&term - s_.terms.data());
    return at < s_.file_tolerance.size() ? s_.file_tolerance[at] : term.tolerance;
  }

  /// theta to the number under its key; names the key.
  [[nodiscard]] std::function<double(double)> Law(const std::string& parameter,
                                                  CalibratedValue& v) const {
    if (!at_.effect) {
      return [base = v.key == "share" ? 0.0 : 1.0](double theta) { return base + theta; };
    }
    if (at_.effect == effect::Id::kExtraDelay) {
      v.key = "delay_samples";
      v.unit = "samples";
      return [file = s_.view->model->config().delay_samples](double theta) { return file + theta; };
    }
    const std::size_t key = KeyOf(parameter);
    v.key = ValuesOf(*s_.view, at_).at(key).key;
    v.unit = UnitOfKey(v.key).symbol;
    return [this, parameter, key](double theta) { return ValueAt(parameter, theta, key); };
  }

  [[nodiscard]] double ValueAt(const std::string& parameter, double theta, std::size_t key) const {
    PlacedEffect other = at_;
    other.theta[parameter] = theta;
    return ValuesOf(*s_.view, other).at(key).number;
  }

  /// The first key that the parameter moves.
  [[nodiscard]] std::size_t KeyOf(const std::string& parameter) const {
    const EntryValues values = ValuesOf(*s_.view, at_);
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (ValueAt(parameter, at_.theta.at(parameter) + kProbe, k) != values[k].number) {
        return k;
      }
    }
    return values.size() - 1;
  }

  void AddHarmonic(std::vector<CalibratedValue>& out) const {
    const std::size_t index = at_.term.at("cosine");
    const Term* term = &s_.terms[index];
    const Estimate* cosine = EstimateOf(s_.answer.calibration, index);
    const EntryValues values = ValuesOf(*s_.view, at_);
    if (cosine == nullptr || values.empty()) return;
    CalibratedValue v;
    v.effect = at_.effect_name();
    v.place = at_.location.name;
    TakeKeyAndPhase(values, v);
    const KeyUnit unit = UnitOfKey(v.key);
    v.unit = unit.symbol;
    const std::complex<double> found{at_.At("cosine"), at_.At("sine")};
    const std::complex<double> file = at_.effect == effect::Id::kUnbalance
                                          ? UnbalanceOfFile(*s_.view, at_.location.z_m.value())
                                          : 0.0;
    v.nominal = v.expected = std::abs(file) / unit.si;
    v.calibrated = std::abs(file + found) / unit.si;
    if (file != 0.0) {
      v.nominal_phase_rad = std::arg(file);
      v.phase_rad = std::arg(file + found);
    }
    v.deviation = cosine->deviation / unit.si;
    v.tolerance = term->tolerance / unit.si;
    const std::complex<double> healthy_mean{term->healthy_mean,
                                            s_.terms[at_.term.at("sine")].healthy_mean};
    if (healthy_mean != 0.0) {
      v.expected = std::abs(file + healthy_mean) / unit.si;
      v.expected_phase_rad = std::arg(file + healthy_mean);
    }
    v.moved = std::abs(found - healthy_mean) / term->tolerance;
    v.proven = cosine->deviation > 0.0 ? std::abs(found - healthy_mean) / cosine->deviation : 0.0;
    v.from_file = std::abs(found) / FileTolerance(*term);
    v.learned = std::abs(healthy_mean) / FileTolerance(*term);
    out.push_back(v);
  }

  const DiagnosisResult& s_;
  const PlacedEffect& at_;
};

}  // namespace

std::vector<CalibratedValue> CalibratedValues(const DiagnosisResult& s) {
  std::vector<CalibratedValue> out;
  for (const PlacedEffect& at : CalibrationByPlace(s)) Calibrated(s, at).AddTo(out);
  std::stable_sort(out.begin(), out.end(), [](const CalibratedValue& a, const CalibratedValue& b) {
    return a.moved > b.moved;
  });
  return out;
}

}  // namespace levitas::diagnosis
