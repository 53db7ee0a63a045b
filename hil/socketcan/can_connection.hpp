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
// Delay      from sample to current on these buses (can::DelayOf): where it is longer than the
//            `delay_samples` of the rig's file, it takes that number's place.
// Lockstep   is for rigs that wait. A real one does not: refused where an interface is no virtual
//            one.
// Failure    Problem (exit status 2) for a port that cannot be read; BadInput (3) for a rig without
//            buses or with more load than they carry, with the rate that fits.
// Thread     any; not for the loop.

#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "hil/can/budget.hpp"
#include "hil/can/bus_config.hpp"
#include "hil/socketcan/link_kind.hpp"

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

/// Whether an interface is there and a virtual one of this kernel (link_kind.hpp).
[[nodiscard]] bool IsVirtual(const std::string& interface);

/// The first interface of a CAN port that is there and no virtual one: a real rig may stand behind
/// it, and no simulated one belongs there. Empty: there is none. `find` is asked once for each.
[[nodiscard]] std::string RealInterface(const std::vector<can::BusConfig>& buses,
                                        const std::string& port,
                                        LinkKind (*find)(const std::string&) = FindLink);

/// Refuses (exit status 2) the lockstep pace where RealInterface names one.
void RefuseLockstep(const std::vector<can::BusConfig>& buses, const std::string& port,
                    LinkKind (*find)(const std::string&) = FindLink);

/// `is_virtual` is asked once for each interface.
[[nodiscard]] CanConnection PlanConnection(const RigNumbers& rig,
                                           const std::vector<can::BusConfig>& buses,
                                           const std::string& rig_name, const std::string& port,
                                           bool (*is_virtual)(const std::string&) = IsVirtual);

/// Why the loop would not fit if each interface named were one real wire; empty: it would.
[[nodiscard]] std::string RealWireRefusal(const RigNumbers& rig,
                                          const std::vector<can::BusConfig>& buses,
                                          const std::string& rig_name, const std::string& port);

/// The delay of the rig's file, or that of the loop on its buses where that is longer. In periods.
[[nodiscard]] double DelayOnBuses(double of_file, const RigNumbers& rig, const can::Budget& budget);

}  // namespace levitas::socketcan
