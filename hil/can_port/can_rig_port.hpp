#pragma once
// The controller's port to a rig on CAN buses: position messages in, current messages out.
//
// Sampling    lockstep: cycle x period. Real time: the kernel's time stamp of the reception less
//             the time the messages were on the wire.
// Bounded     one Read takes at most kMostPerRead frames. When more are waiting it returns none:
//             what it found may not be the newest. In real time a frame that has waited for two
//             periods is no news either.
// Results of faults docs/real_rig.md, tested in tests/unit/can_port and, on a kernel's bus, in
//             tests/hardware/can. The rest (thread, blocking, staleness, failure) is the contract
//             of common/rig_port.hpp.

#include <string>
#include <vector>

#include "common/rig_port.hpp"
#include "hil/can/assemblers.hpp"
#include "hil/can/bus_access.hpp"
#include "hil/can_port/bus_watch.hpp"

namespace levitas::can_port {

inline constexpr int kMostPerRead = 64;

struct CanPortOptions {
  bool realtime{};
  std::int64_t wire_ns{};  ///< time of the positions on the wire; 0 on a virtual bus
};

class CanRigPort final : public port::RigPort {
 public:
  /// Keeps a reference to `access`.
  CanRigPort(const can::Layout& layout, const std::vector<can::BusConfig>& buses,
             const CanPortOptions& options, can::BusAccess& access);

  port::ReadResult Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept override;
  bool Write(const CurrentFrame& frame) noexcept override;
  [[nodiscard]] port::PortCounters counters() const noexcept override;
  void SayGoodbye(const CurrentFrame& last) noexcept override;
  [[nodiscard]] std::string Trouble() const override;

  [[nodiscard]] const BusCounters& bus_counters() const noexcept { return watch_.counters(); }
  [[nodiscard]] const can::OutcomeCounters& outcomes() const noexcept {
    return assembler_.outcomes();
  }

 private:
  struct Outgoing {
    can::MessageCodec codec;
    std::size_t bus{};
  };
  [[nodiscard]] bool Accept(const can::Reception& reception, std::int64_t newest_ns,
                            SensorFrame& frame) noexcept;
  bool Send(Outgoing& outgoing, const can::Values& values) noexcept;

  CanPortOptions options_;
  std::int64_t period_ns_;
  can::BusAccess& access_;
  can::RigAssembler assembler_;
  std::vector<Outgoing> fast_;
  std::vector<Outgoing> slow_;
  can::DriveSchedule schedule_;
  bool drive_owed_{false};
  BusWatch watch_;
  port::PortCounters counters_;
};

}  // namespace levitas::can_port
