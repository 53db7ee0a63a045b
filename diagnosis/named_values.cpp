#include "diagnosis/named_values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/session.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kInterval = 1.645;  ///< standard deviations of 5 and 95 %
constexpr double kProbe = 1e-3;      ///< of a term's scale: does a key depend on it?

double Difference(const EntryValue& value, double other) {
  const double difference = other - value.number;
  return value.key == "phase_rad" ? std::remainder(difference, 2.0 * std::numbers::pi) : difference;
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
  Bracket(const SessionAnswer& s, const PlacedEffect& at, std::size_t key)
      : s_(s), at_(at), key_(key), value_(ValuesOf(*s.view, at).at(key)) {}

  std::optional<NamedParameter> Find() {
    for (const auto& [parameter, theta] : at_.theta) AddEstimate(parameter, theta);
    AddForms();
    if (!depends_) return std::nullopt;
    const KeyUnit unit = UnitOfKey(value_.key);
    NamedParameter p;
    p.effect = at_.effect;
    p.name = fmt::format("{}[{}]", value_.key, at_.place);
    p.unit = unit.symbol;
    p.value = value_.number;
    if (value_.key == "phase_rad") {
      low_ = std::min(low_, std::numbers::pi);
      high_ = std::min(high_, std::numbers::pi);
    }
    const bool size = at_.theta.contains("cosine") && value_.key != "phase_rad";
    p.low = size && p.value < high_ ? 0.0 : p.value - low_;
    p.high = p.value + high_;
    p.key = value_.key;
    p.place = at_.place;
    p.form = form_;
    p.si = unit.si;
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
  void AddEstimate(const std::string& parameter, double theta) {
    const Estimate* estimate = EstimateOf(s_.answer.parameters, at_, parameter);
    const Term* term = TermOf(s_.terms, at_, parameter);
    if (estimate == nullptr || term == nullptr) return;
    const double probe = kProbe * std::max(std::abs(theta), term->scale());
    if (Moved(parameter, probe) == value_.number && Moved(parameter, -probe) == value_.number) {
      return;
    }
    depends_ = true;
    const double spread = kInterval * estimate->deviation;
    Widen(value_, Moved(parameter, -spread), Moved(parameter, spread), low_, high_);
  }
  void AddForms() {
    const auto term = std::find_if(s_.terms.begin(), s_.terms.end(), [this](const Term& t) {
      return t.effect == at_.effect && t.place == at_.place && t.family.member;
    });
    if (term == s_.terms.end()) return;
    for (std::size_t k = 0; k < term->family.log_width.size(); ++k) {
      const auto neighbour = [&](double side) {
        Family::Shape shape = term->family.shape;
        shape[k] *= std::exp(side * term->family.log_width[k]);
        PlacedEffect other = at_;
        other.place = term->family.member(shape).place;
        return At(other);
      };
      const double below = neighbour(-1.0);
      const double above = neighbour(1.0);
      if (below == value_.number && above == value_.number) continue;
      depends_ = form_ = true;
      Widen(value_, below, above, low_, high_);
    }
  }

  const SessionAnswer& s_;
  const PlacedEffect& at_;
  std::size_t key_;
  EntryValue value_;
  double low_{}, high_{};
  bool depends_{}, form_{};
};

}  // namespace

std::vector<NamedParameter> Parameters(const SessionAnswer& s) {
  if (s.own_words) return s.own_words->parameters;
  std::vector<NamedParameter> out;
  for (const PlacedEffect& at : CausesByPlace(s)) {
    const EntryValues values = ValuesOf(*s.view, at);
    for (std::size_t key = 0; key < values.size(); ++key) {
      if (!values[key].is_number()) continue;
      if (const auto found = Bracket(s, at, key).Find()) out.push_back(*found);
    }
  }
  return out;
}

}  // namespace levitas::diagnosis
