#include "session/replay/output_difference.hpp"

#include <fmt/core.h>

#include <bit>
#include <cstdint>

#include "common/enums.hpp"

namespace levitas::session {
namespace {

/// Looks at one field after the other and keeps the first difference.
class Comparison {
 public:
  void Number(const char* field, double recorded, double computed) {
    if (std::bit_cast<std::uint64_t>(recorded) == std::bit_cast<std::uint64_t>(computed)) return;
    Keep(field, fmt::format("{}", recorded), fmt::format("{}", computed));
  }
  template <class Integer>
  void Count(const char* field, Integer recorded, Integer computed) {
    if (recorded != computed) Keep(field, fmt::format("{}", recorded), fmt::format("{}", computed));
  }
  template <class Enum>
  void Word(const char* field, Enum recorded, Enum computed) {
    if (recorded != computed) Keep(field, std::string(Name(recorded)), std::string(Name(computed)));
  }
  void Axes(const char* field, const AxisArray& recorded, const AxisArray& computed,
            const std::vector<std::string>& channels) {
    for (std::size_t axis = 0; axis < channels.size() && axis < kMaxAxes && !found_; ++axis) {
      Number(field, recorded[axis], computed[axis]);
      if (found_) found_->field += " " + channels[axis];
    }
  }
  [[nodiscard]] std::optional<OutputDifference> found() && { return std::move(found_); }

 private:
  void Keep(const char* field, std::string recorded, std::string computed) {
    if (!found_) found_ = {field, std::move(recorded), std::move(computed)};
  }
  std::optional<OutputDifference> found_;
};

}  // namespace

std::optional<OutputDifference> FirstDifference(const cycle::CycleOutputs& recorded,
                                                const cycle::CycleOutputs& computed,
                                                const std::vector<std::string>& channels) {
  Comparison compare;
  const CurrentFrame& r = recorded.current;
  const CurrentFrame& c = computed.current;
  compare.Word("mode", recorded.mode, computed.mode);
  compare.Word("fault", recorded.fault, computed.fault);
  compare.Count("fault_axis", recorded.fault_axis, computed.fault_axis);
  compare.Number("fault_value", recorded.fault_value, computed.fault_value);
  compare.Number("fault_limit", recorded.fault_limit, computed.fault_limit);
  compare.Count("command_refused", recorded.command_refused, computed.command_refused);
  compare.Axes("reference_m", recorded.reference_m, computed.reference_m, channels);
  compare.Axes("control_current_a", r.control_current_a, c.control_current_a, channels);
  compare.Count("saturated_axes", recorded.saturated_axes, computed.saturated_axes);
  compare.Count("current_cycle", r.cycle, c.cycle);
  compare.Count("current_axes", r.axes, c.axes);
  compare.Number("bias_current_a", r.bias_current_a, c.bias_current_a);
  compare.Number("speed_set_point_rad_per_s", r.speed_set_point_rad_per_s,
                 c.speed_set_point_rad_per_s);
  compare.Number("acceleration_limit_rad_per_s2", r.acceleration_limit_rad_per_s2,
                 c.acceleration_limit_rad_per_s2);
  compare.Count("amplifiers_enabled", r.amplifiers_enabled, c.amplifiers_enabled);
  compare.Count("drive_enabled", r.drive_enabled, c.drive_enabled);
  return std::move(compare).found();
}

}  // namespace levitas::session
