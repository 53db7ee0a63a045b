#include "diagnosis/report/named_values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "diagnosis/diagnose/diagnose_files.hpp"
#include "diagnosis/report/event_values.hpp"
#include "numerics/normal_distribution.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kProbe = 1e-3;  ///< of a term's scale: does a key depend on it?
constexpr double kTurnDeg = 360.0;

double Difference(const EntryValue& value, double other) {
  const double difference = other - value.number;
  return value.key == kPhaseKey ? std::remainder(difference, kTurnDeg) : difference;
}

/// Adds what a key becomes to either side.
void Widen(const EntryValue& value, double one, double other, double& low, double& high) {
  const double first = Difference(value, one);
  const double second = Difference(value, other);
  low = std::hypot(low, std::min({0.0, first, second}));
  high = std::hypot(high, std::max({0.0, first, second}));
}

/// One key of a cause with its bracket; nothing where the place alone says it.
class Bracket {
 public:
  Bracket(const DiagnosisResult& s, const PlacedEffect& at, std::size_t key)
      : s_(s), at_(at), key_(key), value_(ValuesOf(*s.view, at).at(key)) {}

  std::optional<NamedParameter> Find() {
    for (const auto& [parameter, theta] : at_.theta) AddEstimate(parameter, theta);
    AddForms();
    if (!depends_) return std::nullopt;
    const KeyUnit unit = UnitOfKey(value_.key);
    NamedParameter p;
    p.effect = at_.effect_name();
    p.name = fmt::format("{}[{}]", value_.key, at_.location.name);
    p.unit = unit.symbol;
    p.value = value_.number;
    if (value_.key == kPhaseKey) {
      low_ = std::min(low_, 0.5 * kTurnDeg);
      high_ = std::min(high_, 0.5 * kTurnDeg);
    }
    const bool size = at_.theta.contains("cosine") && value_.key != kPhaseKey;
    p.low = size && p.value < high_ ? 0.0 : p.value - low_;
    p.high = p.value + high_;
    p.key = value_.key;
    p.location = at_.location;
    p.form = form_;
    p.si = unit.si;
    AddOfFile(p);
    return p;
  }

 private:
  [[nodiscard]] double At(const PlacedEffect& other) const {
    const EntryValues values = ValuesOf(*s_.view, other);
    return key_ < values.size() ? values[key_].number : value_.number;
  }
  [[nodiscard]] double Moved(const std::string& parameter, double by) const {
    PlacedEffect other = at_;
    other.theta[parameter] += by;
    return At(other);
  }
  /// Effects of these kinds add to a value that the file has under its own key.
  void AddOfFile(NamedParameter& p) const {
    const double found = p.value * p.si;
    if (at_.effect == effect::Id::kExtraDelay) {
      const double file_s = s_.view->model->config().delay_samples * s_.view->period_s;
      if (file_s > 0.0) p.of_file = OfFile{file_s / p.si, (file_s + found) / p.si};
      return;
    }
    if (at_.effect != effect::Id::kUnbalance) return;
    const std::complex<double> file = UnbalanceOfFile(*s_.view, at_.location.z_m.value());
    if (file == 0.0) return;
    const std::complex<double> all = file + std::complex<double>(at_.At("cosine"), at_.At("sine"));
    p.of_file = p.key == kPhaseKey ? OfFile{std::arg(file) / p.si, std::arg(all) / p.si}
                                   : OfFile{std::abs(file) / p.si, std::abs(all) / p.si};
  }
  void AddEstimate(const std::string& parameter, double theta) {
    const std::size_t term = at_.term.at(parameter);
    const Estimate* estimate = EstimateOf(s_.answer.parameters, term);
    if (estimate == nullptr) return;
    const double probe = kProbe * std::max(std::abs(theta), s_.terms[term].scale());
    if (Moved(parameter, probe) == value_.number && Moved(parameter, -probe) == value_.number) {
      return;
    }
    depends_ = true;
    const double spread = numerics::kInterval90 * estimate->deviation;
    Widen(value_, Moved(parameter, -spread), Moved(parameter, spread), low_, high_);
  }
  void AddForms() {
    const Family& family = s_.terms[at_.term.begin()->second].family;
    for (std::size_t k = 0; k < family.log_width.size(); ++k) {
      const auto neighbour = [&](double side) {
        PlacedEffect other = at_;
        other.shape[k] *= std::exp(side * family.log_width[k]);
        return At(other);
      };
      const double below = neighbour(-1.0);
      const double above = neighbour(1.0);
      if (below == value_.number && above == value_.number) continue;
      depends_ = form_ = true;
      Widen(value_, below, above, low_, high_);
    }
  }

  const DiagnosisResult& s_;
  const PlacedEffect& at_;
  std::size_t key_;
  EntryValue value_;
  double low_{}, high_{};
  bool depends_{}, form_{};
};

/// What the data want beyond the least that the law allows, as a mode's damping below zero: its
/// size is that limit, and how well it is known cannot be said.
void AddAtItsLimit(const PlacedEffect& at, const EntryValues& values,
                   std::vector<NamedParameter>& out) {
  const effect::Words& words = effect::WordsOf(at.effect.value());
  for (const EntryValue& value : values) {
    if (!value.key.starts_with(words.size)) continue;
    const KeyUnit unit = UnitOfKey(value.key);
    NamedParameter p;
    p.effect = at.effect_name();
    p.key = value.key;
    p.name = fmt::format("{}[{}]", value.key, at.location.name);
    p.unit = unit.symbol;
    p.si = unit.si;
    p.value = p.low = p.high = value.number;
    p.location = at.location;
    out.push_back(p);
  }
}

/// A delay shorter than the file's, as the file has it: in samples, in all.
NamedParameter UnderOwnKey(const NamedParameter& added, const RigView& rig) {
  const double file = rig.model->config().delay_samples;
  const auto total = [&](double value) {
    return std::max(0.0, file + value * added.si / rig.period_s);
  };
  NamedParameter p = added;
  p.key = kDelaySamplesKey;
  p.name = fmt::format("{}[{}]", p.key, p.location.name);
  p.unit = "samples";
  p.si = rig.period_s;
  p.value = total(added.value);
  p.low = total(added.low);
  p.high = total(added.high);
  p.of_file = OfFile{file, p.value};
  return p;
}

}  // namespace

std::complex<double> UnbalanceOfFile(const RigView& rig, double z_m) {
  std::complex<double> sum;
  const auto add = [&](double at_m, double moment_kg_m, double phase_rad) {
    if (std::abs(at_m - z_m) < kSamePlaneM) sum += std::polar(moment_kg_m, phase_rad);
  };
  for (const auto& mass : rig.model->config().unbalance) {
    add(mass.z_m, mass.moment_kg_m, mass.phase_rad);
  }
  for (const effect::EffectConfig& entry : rig.model->config().effects) {
    if (entry.id != effect::Id::kUnbalance || entry.timed()) continue;
    add(entry.values[0], entry.strength * entry.values[1], entry.values[2]);
  }
  return sum;
}

std::vector<std::string> TakenByCauses(const DiagnosisResult& s) {
  std::vector<std::string> taken;
  for (const PlacedEffect& at : CausesByPlace(s)) {
    const bool calibrated = std::any_of(s.terms.begin(), s.terms.end(), [&at](const Term& t) {
      return t.effect == at.effect && t.location.name == at.location.name && t.nuisance();
    });
    if (calibrated) taken.push_back(fmt::format("{} {}", at.effect_name(), at.location.name));
  }
  return taken;
}

std::vector<NamedParameter> Parameters(const DiagnosisResult& s) {
  std::vector<NamedParameter> out;
  for (const PlacedEffect& at : CausesByPlace(s)) {
    const EntryValues values = ValuesOf(*s.view, at);
    const std::size_t before = out.size();
    for (std::size_t key = 0; key < values.size(); ++key) {
      const auto found = Bracket(s, at, key).Find();
      if (found) out.push_back(IsShorterDelay(at) ? UnderOwnKey(*found, *s.view) : *found);
    }
    if (out.size() == before) AddAtItsLimit(at, values, out);
  }
  const std::vector<NamedParameter> of_events = EventParameters(s);
  out.insert(out.end(), of_events.begin(), of_events.end());
  return out;
}

bool IsShorterDelay(const PlacedEffect& at) {
  return at.effect == effect::Id::kExtraDelay && at.At("samples") < 0.0;
}

}  // namespace levitas::diagnosis
