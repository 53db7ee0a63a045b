#include "diagnosis/report/input_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "diagnosis/report/diagnose_files.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kMoved = 0.5;  ///< tolerances of the file; less is not told
constexpr std::size_t kTold = 3;

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
  std::vector<std::string> told;
  for (std::size_t i = 0; i < std::min(kTold, values.size()); ++i) told.push_back(text(values[i]));
  const std::string more =
      values.size() > kTold ? fmt::format(", and {} more", values.size() - kTold) : "";
  return fmt::format("{}{}", fmt::join(told, ", "), more);
}

}  // namespace

std::string DoubtSentence(const DiagnosisResult& s) {
  if (s.own_words) return {};
  const std::string doubt = ": units, signs or the rig file are likelier wrong than the rig.";
  const double ceiling = std::min(s.fitted.ceiling_percent, s.validation.ceiling_percent);
  if (ceiling < kNoMotion) {
    return fmt::format("The noise is larger than the motion (ceiling of the fit {:.3g} %){}",
                       ceiling, doubt);
  }
  const auto values = CalibratedValues(s);
  const auto worst =
      std::max_element(values.begin(), values.end(),
                       [](const auto& a, const auto& b) { return a.from_file < b.from_file; });
  if (worst == values.end() || worst->from_file <= kFarOut) return {};
  return fmt::format("{} {} of {} would have to be {:.4g}{}, {:.0f} tolerances off the rig file{}",
                     worst->effect, worst->key, worst->place, worst->calibrated, Unit(*worst),
                     worst->from_file, doubt);
}

std::vector<CalibratedValue> ChangedSince(const DiagnosisResult& s) {
  std::vector<CalibratedValue> changed;
  if (s.file_tolerance.empty()) return changed;
  const auto values = CalibratedValues(s);
  std::copy_if(values.begin(), values.end(), std::back_inserter(changed),
               [](const auto& v) { return v.moved > kChanged && v.proven > kChanged; });
  return changed;
}

std::string HealthySentence(const DiagnosisResult& s) {
  if (s.file_tolerance.empty()) return {};
  auto learned = CalibratedValues(s);
  std::erase_if(learned, [](const auto& v) { return v.learned < kMoved; });
  std::stable_sort(learned.begin(), learned.end(),
                   [](const auto& a, const auto& b) { return a.learned > b.learned; });
  std::string text = learned.empty()
                         ? "The healthy records move nothing by more than half a tolerance."
                         : fmt::format("The healthy records move {}.", List(learned, LearnedText));
  const auto changed = ChangedSince(s);
  if (changed.empty()) return text;
  return fmt::format("{} Here {}: another rig, or changed since?", text,
                     List(changed, ChangedText));
}

}  // namespace levitas::diagnosis
