#pragma once
// The port that --port names, with everything it stands on.
//
// Failure  Problem: 2 for a port that cannot be read, or lockstep on a bus that is no virtual one,
//          3 for a rig whose buses do not carry the loop, 1 when sockets cannot be made.

#include <memory>
#include <string>

#include "common/rig_port.hpp"
#include "configuration/rig_file.hpp"
#include "programs/controller/controller_options.hpp"
#include "programs/controller/delay_watch.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::controller_program {

class RigConnection {
 public:
  virtual ~RigConnection() = default;
  [[nodiscard]] virtual port::RigPort& port() noexcept = 0;
  /// For people: where the rig should be, and the program that simulates one there.
  [[nodiscard]] virtual std::string Where() const = 0;
  [[nodiscard]] virtual const char* SimulatedRig() const noexcept = 0;
  /// Only a simulated rig can be there: LCM, or virtual buses. False: magnets may be energised.
  [[nodiscard]] virtual bool virtual_rig() const noexcept = 0;
  /// What people should hear at once, each thing once. Main thread.
  [[nodiscard]] virtual std::string TakeNews() { return port().TakeNews(); }
  /// The measured delay of the path; null: it is not measured.
  [[nodiscard]] virtual const DelayWatch* delay() const noexcept { return nullptr; }
  /// [ns] from the rig's sampling instant until its frame is here, for the grid in real time.
  [[nodiscard]] virtual std::int64_t phase_ns() const noexcept = 0;
};

/// Of the port with LCM, else of --telemetry; with the key, and refused where frames need one.
[[nodiscard]] transport::LcmNetwork TelemetryNetwork(const ControllerOptions& options);

/// What the port changes of the rig's description: from sample to current on its buses.
void ApplyPort(const ControllerOptions& options, configuration::RigFile& rig);

[[nodiscard]] std::unique_ptr<RigConnection> Connect(const ControllerOptions& options,
                                                     const configuration::RigFile& rig);

}  // namespace levitas::controller_program
