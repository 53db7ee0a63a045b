#include "dashboard/scope_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "dashboard/request_fields.hpp"

namespace levitas::dashboard {
namespace {

using nlohmann::json;

constexpr double kMicro = 1e-6;
constexpr double kMilli = 1e-3;
constexpr double kLongestMs = 60'000.0;
constexpr double kMostPercent = 95.0;
constexpr std::array kStateNames{"idle", "armed", "triggered", "captured"};

std::size_t AxisNamed(const std::string& channel, const RigNumbers& rig) {
  const auto at = std::find(rig.channels.begin(), rig.channels.end(), channel);
  if (at != rig.channels.end()) return static_cast<std::size_t>(at - rig.channels.begin());
  std::string names;
  for (const std::string& name : rig.channels) names += (names.empty() ? "" : ", ") + name;
  throw std::invalid_argument(fmt::format("no channel '{}'; there are {}", channel, names));
}

std::size_t SamplesIn(const json& request, const RigNumbers& rig) {
  const double length_s = NumberIn(request, "length_ms", 0.0, kLongestMs) * kMilli;
  const double samples = std::round(length_s / rig.period_s()) + 1.0;
  constexpr double kMost = Scope::kMostSamples;
  if (!(samples >= 2.0 && samples <= kMost)) {
    throw std::invalid_argument(fmt::format(
        "length_ms = {:.6g}: this rig's scope keeps 2 to {} samples, that is {:.4g} to {:.6g} ms",
        length_s / kMilli, Scope::kMostSamples, rig.period_s() / kMilli,
        (kMost - 1.0) * rig.period_s() / kMilli));
  }
  return static_cast<std::size_t>(samples);
}

/// Whole numbers of `unit`; what is no number is null.
void PutRow(std::string& text, const std::vector<float>& row, double unit) {
  text += '[';
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) text += ',';
    const double value = static_cast<double>(row[i]) / unit;
    if (std::isfinite(value) && std::abs(value) < 1e15) {
      fmt::format_to(std::back_inserter(text), "{}", std::llround(value));
    } else {
      text += "null";
    }
  }
  text += ']';
}

void PutRows(std::string& text, const char* key, const std::vector<std::vector<float>>& rows,
             double unit) {
  fmt::format_to(std::back_inserter(text), ",\"{}\":[", key);
  for (std::size_t axis = 0; axis < rows.size(); ++axis) {
    if (axis > 0) text += ',';
    PutRow(text, rows[axis], unit);
  }
  text += ']';
}

json SettingsJson(const ScopeSettings& settings, const std::vector<std::string>& channels) {
  constexpr std::array kSources{"position", "current", "trip", "now"};
  constexpr std::array kEdges{"rising", "falling", "either"};
  json about{{"source", kSources.at(static_cast<std::size_t>(settings.source))},
             {"samples", settings.samples},
             {"before", settings.before}};
  const bool level =
      settings.source == ScopeSource::kPosition || settings.source == ScopeSource::kCurrent;
  if (level && settings.axis < channels.size()) {
    about.update({{"channel", channels[settings.axis]},
                  {"level", settings.level},
                  {"edge", kEdges.at(static_cast<std::size_t>(settings.edge))}});
  }
  return about;
}

const HttpAnswer kNothingCaptured{kHttpNotFound,
                                  R"({"outcome":"nothing","text":"nothing was captured yet"})"};

}  // namespace

ScopeSettings UnderstandScope(const std::string& body, const RigNumbers& rig) {
  const json request = ParseRequest(body);
  RefuseUnknownKeys(request, {"do", "source", "channel", "level_um", "level_a", "edge", "length_ms",
                              "before_percent"});
  ScopeSettings settings;
  settings.source =
      static_cast<ScopeSource>(ChoiceIn(request, "source", {"position", "current", "trip", "now"}));
  if (settings.source == ScopeSource::kPosition || settings.source == ScopeSource::kCurrent) {
    settings.axis = AxisNamed(TextIn(request, "channel"), rig);
    settings.edge =
        static_cast<ScopeEdge>(ChoiceIn(request, "edge", {"rising", "falling", "either"}));
    const double reach_um = rig.SensorRangeOf(settings.axis / 2) / kMicro;
    settings.level =
        settings.source == ScopeSource::kPosition
            ? NumberIn(request, "level_um", -reach_um, reach_um) * kMicro
            : NumberIn(request, "level_a", -rig.max_coil_current_a, rig.max_coil_current_a);
  }
  settings.samples = SamplesIn(request, rig);
  const double share = NumberIn(request, "before_percent", 0.0, kMostPercent) / 100.0;
  settings.before = static_cast<std::size_t>(share * static_cast<double>(settings.samples - 1));
  return settings;
}

void ScopeController::RunIs(const RigNumbers& rig) {
  const std::lock_guard lock(mutex_);
  rig_ = rig;
  scope_.Stop();
  changed_ = true;
}

void ScopeController::Tripped(std::uint64_t cycle) {
  const std::lock_guard lock(mutex_);
  scope_.Tripped(cycle);
}

void ScopeController::Advance(const SampleStore& store) {
  const std::lock_guard lock(mutex_);
  if (!scope_.Advance(store)) return;
  changed_ = true;
  if (scope_.state() == ScopeState::kCaptured && rig_) captured_channels_ = rig_->channels;
}

std::optional<std::string> ScopeController::News() {
  const std::lock_guard lock(mutex_);
  if (!changed_) return std::nullopt;
  changed_ = false;
  return StateJson();
}

std::string ScopeController::StateJson() const {
  json state{{"state", kStateNames.at(static_cast<std::size_t>(scope_.state()))},
             {"given_up", scope_.given_up()},
             {"capture", scope_.newest() ? scope_.newest()->number : 0}};
  if (rig_) state["settings"] = SettingsJson(scope_.settings(), rig_->channels);
  return state.dump();
}

HttpAnswer ScopeController::Ask(const std::string& body) {
  const std::lock_guard lock(mutex_);
  try {
    const json request = ParseRequest(body);
    if (ChoiceIn(request, "do", {"arm", "stop"}) == 1) {
      scope_.Stop();
      changed_ = true;
      return Answer(kHttpOk, "accepted", "the scope is stopped");
    }
    if (!rig_) return Answer(kHttpConflict, "refused", "no controller was heard yet");
    scope_.Arm(UnderstandScope(body, *rig_));
  } catch (const std::exception& problem) {
    return Answer(kHttpBadRequest, "not understood", problem.what());
  }
  changed_ = true;
  return Answer(kHttpOk, "accepted", "the scope is armed");
}

ScopeController::Kept ScopeController::Newest() const {
  const std::lock_guard lock(mutex_);
  return {scope_.newest(), captured_channels_};
}

HttpAnswer ScopeController::CaptureJson() const {
  const Kept kept = Newest();  // made into text without the lock
  if (!kept.capture) return kNothingCaptured;
  const Capture& capture = *kept.capture;
  const json about{{"number", capture.number},
                   {"trigger_cycle", capture.trigger_cycle},
                   {"period_s", capture.period_s},
                   {"channels", kept.channels},
                   {"settings", SettingsJson(capture.settings, kept.channels)}};
  std::string text = about.dump();
  text.pop_back();
  PutRows(text, "position_nm", capture.position_m, 1e-9);
  PutRows(text, "current_ua", capture.current_a, kMicro);
  return {kHttpOk, text + '}'};
}

HttpAnswer ScopeController::CaptureCsv() const {
  const Kept kept = Newest();
  if (!kept.capture) return kNothingCaptured;
  const Capture& capture = *kept.capture;
  std::string text = "cycle,time_s,speed_rad_per_s";
  for (const std::string& name : kept.channels) text += ",position_" + name + "_m";
  for (const std::string& name : kept.channels) text += ",control_current_" + name + "_a";
  text += '\n';
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < capture.settings.samples; ++i) {
    // From the trigger on; before it, time is negative.
    const auto from_trigger =
        static_cast<std::int64_t>(i) - static_cast<std::int64_t>(capture.settings.before);
    fmt::format_to(
        out, "{},{:.9g},{}", static_cast<std::int64_t>(capture.trigger_cycle) + from_trigger,
        static_cast<double>(from_trigger) * capture.period_s, capture.speed_rad_per_s[i]);
    for (const auto& row : capture.position_m) fmt::format_to(out, ",{}", row[i]);
    for (const auto& row : capture.current_a) fmt::format_to(out, ",{}", row[i]);
    text += '\n';
  }
  return {kHttpOk, std::move(text), "text/csv"};
}

}  // namespace levitas::dashboard
