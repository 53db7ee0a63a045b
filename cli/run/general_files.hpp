#pragma once
// What `amb run` takes where neither the user nor the rig file names anything.

namespace levitas::cli {

inline constexpr const char* kGeneralController = "flexible_rotor_commissioned";
inline constexpr const char* kGeneralScenario = "default";

}  // namespace levitas::cli
