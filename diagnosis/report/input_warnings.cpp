#include "diagnosis/report/input_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <optional>

namespace levitas::diagnosis {
namespace {

constexpr double kMoved = 0.5;  ///< tolerances of the file; less is not listed
constexpr std::size_t kListed = 3;

std::string Unit(const CalibratedValue& v) { return v.unit.empty() ? "" : " " + v.unit; }

std::string At(const std::optional<double>& phase_rad) {
  return phase_rad ? fmt::format(" at {:.1f} deg", 180.0 / std::numbers::pi * *phase_rad) : "";
}

std::string LearnedText(const CalibratedValue& v) {
  return fmt::format("{} {} of {} from {:.4g}{} to {:.4g}{}{} ({:.1f} tolerances)", v.effect, v.key,
                     v.place, v.nominal, At(v.nominal_phase_rad), v.expected, Unit(v),
                     At(v.expected_phase_rad), v.learned);
}

std::string ChangedText(const CalibratedValue& v) {
  return fmt::format("{} {} of {} is {:.4g}{}{}, {:.1f} of the tolerances that they leave away",
                     v.effect, v.key, v.place, v.calibrated, Unit(v), At(v.phase_rad), v.moved);
}

template <class Text>
std::string List(const std::vector<CalibratedValue>& values, Text text) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(kListed, values.size()); ++i)
    texts.push_back(text(values[i]));
  const std::string more =
      values.size() > kListed ? fmt::format(", and {} more", values.size() - kListed) : "";
  return fmt::format("{}{}", fmt::join(texts, ", "), more);
}

}  // namespace

std::string InputWarning(const DiagnosisReport& s) {
  const std::string doubt = ": units, signs or the rig file are likelier wrong than the rig.";
  const double ceiling = std::min(s.fitted.ceiling_percent, s.validation.ceiling_percent);
  if (ceiling < kNoMotion) {
    return fmt::format("The noise is larger than the motion (ceiling of the fit {:.3g} %){}",
                       ceiling, doubt);
  }
  const auto& values = s.calibrated;
  const auto worst =
      std::max_element(values.begin(), values.end(),
                       [](const auto& a, const auto& b) { return a.from_file < b.from_file; });
  if (worst == values.end() || worst->from_file <= kFarOut) return {};
  return fmt::format("{} {} of {} would have to be {:.4g}{}, {:.0f} tolerances off the rig file{}",
                     worst->effect, worst->key, worst->place, worst->calibrated, Unit(*worst),
                     worst->from_file, doubt);
}

std::vector<CalibratedValue> ChangedSince(const std::vector<CalibratedValue>& calibrated) {
  std::vector<CalibratedValue> changed;
  std::copy_if(calibrated.begin(), calibrated.end(), std::back_inserter(changed),
               [](const auto& v) { return v.moved > kChanged && v.proven > kChanged; });
  return changed;
}

std::string HealthySentence(const std::vector<CalibratedValue>& calibrated) {
  auto learned = calibrated;
  std::erase_if(learned, [](const auto& v) { return v.learned < kMoved; });
  std::stable_sort(learned.begin(), learned.end(),
                   [](const auto& a, const auto& b) { return a.learned > b.learned; });
  std::string text = learned.empty()
                         ? "The healthy records move nothing by more than half a tolerance."
                         : fmt::format("The healthy records move {}.", List(learned, LearnedText));
  const auto changed = ChangedSince(calibrated);
  if (changed.empty()) return text;
  return fmt::format("{} Here {}: another rig, or changed since?", text,
                     List(changed, ChangedText));
}

}  // namespace levitas::diagnosis
