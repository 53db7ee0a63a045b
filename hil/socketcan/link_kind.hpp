#pragma once
// Whether an interface of this kernel is a bus on a wire or a virtual one.
//
// Virtual  what the kernel's drivers vcan and vxcan make: nothing but programs can be on it. All
//          else counts as a wire, a serial adapter (slcan) too, whose device lies among the virtual
//          ones in sysfs; and so does an interface of which the kernel does not say what it is.
// Source   rtnetlink, RTM_GETLINK, IFLA_INFO_KIND; no privilege is needed.
// Thread   any; not for the loop.

#include <cstdint>
#include <string>
#include <string_view>

namespace levitas::socketcan {

enum class LinkKind : std::uint8_t {
  kAbsent,   ///< no interface of this name
  kVirtual,  ///< vcan, vxcan
  kReal,     ///< everything else
};

/// Of an interface that is there, by its driver's name in IFLA_INFO_KIND; empty: it names none.
[[nodiscard]] constexpr LinkKind KindOf(std::string_view driver) noexcept {
  return driver == "vcan" || driver == "vxcan" ? LinkKind::kVirtual : LinkKind::kReal;
}

[[nodiscard]] LinkKind FindLink(const std::string& interface);

}  // namespace levitas::socketcan
