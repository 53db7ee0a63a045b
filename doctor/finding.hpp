#pragma once
// What one check of this machine found, and what follows for the uses of the program.
//
// State    kOk: as it should be. kDegraded: works, with the limit that `found` names.
//          kMissing: the use that needs it is not possible.
// Remedy   a command to paste, or one sentence; empty when the state is kOk.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace levitas::doctor {

enum class State : std::uint8_t { kOk, kDegraded, kMissing };

/// What the machine is asked to be fit for; also the groups of the printed table.
enum class Area : std::uint8_t { kRealTime, kLcm, kCan, kGpio, kStorage };

struct Finding {
  Area area{};
  std::string check;  ///< short name, unique within its area
  State state{};
  std::string found;
  std::string remedy;
};

[[nodiscard]] constexpr std::string_view Name(State state) noexcept {
  switch (state) {
    case State::kOk:
      return "ok";
    case State::kDegraded:
      return "degraded";
    case State::kMissing:
      return "missing";
  }
  return "invalid";
}

[[nodiscard]] constexpr std::string_view Name(Area area) noexcept {
  switch (area) {
    case Area::kRealTime:
      return "real time";
    case Area::kLcm:
      return "LCM";
    case Area::kCan:
      return "CAN";
    case Area::kGpio:
      return "GPIO";
    case Area::kStorage:
      return "storage";
  }
  return "invalid";
}

/// The worst state of an area's findings; kOk when there are none.
[[nodiscard]] State Worst(const std::vector<Finding>& findings, Area area) noexcept;

/// Names of the checks of an area that are in `state`, in the order found.
[[nodiscard]] std::vector<std::string> ChecksIn(const std::vector<Finding>& findings, Area area,
                                                State state);

/// Lockstep needs no real time: only messages between two processes and room for a session.
[[nodiscard]] bool FitForLockstep(const std::vector<Finding>& findings) noexcept;

}  // namespace levitas::doctor
