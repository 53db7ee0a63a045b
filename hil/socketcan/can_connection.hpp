#pragma once
// From --port can:IF and the rig's file to buses that carry the loop, or the reason why not.
//
//   can                  the interfaces that the rig's file names
//   can:vcan0,vcan1      one for each bus of the file, in its order
//   can:vcan0            fewer: the rest shares the last one
//
// Shared     buses on one real interface are one bus, and are budgeted as one. A virtual interface
//            (vcan) has no bit rate: it stands for as many buses as the file describes, and each of
//            these must carry its own load.
// Delay      the time on the wire is part of the rig's delay from sample to current: where it is
//            longer than `delay_samples`, it lengthens it.
// Failure    Problem (exit status 2) for a port that cannot be read; BadInput (3) for a rig without
//            buses or with more load than they carry, with the rate that fits.
// Thread     any; not for the loop.

#include <string>
#include <vector>

#include "config/rig_file.hpp"
#include "hil/can/budget.hpp"

namespace levitas::socketcan {

/// True for "can" and "can:...".
[[nodiscard]] bool IsCanPort(const std::string& port);

struct CanConnection {
  can::Layout layout;
  std::vector<can::BusConfig> buses;  ///< with the interfaces that are used
  can::Budget budget;
  bool virtual_bus{};  ///< every interface is virtual
  std::string text;    ///< for people: "can:vcan0 (positions), ..."
};

/// Whether an interface is a virtual one of this kernel.
[[nodiscard]] bool IsVirtual(const std::string& interface);

/// `is_virtual` is asked once for each interface.
[[nodiscard]] CanConnection PlanConnection(const config::RigFile& rig, const std::string& rig_name,
                                           const std::string& port,
                                           bool (*is_virtual)(const std::string&) = IsVirtual);

/// Lengthens the delay of the simulated rig to the time on the wire where that is longer.
void ApplyWireDelay(config::RigFile& rig, const can::Budget& budget);

}  // namespace levitas::socketcan
