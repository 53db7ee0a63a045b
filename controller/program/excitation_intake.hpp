#pragma once
// Makes the test signals that are asked for over the network and hands them to the operator's desk.
//
// Thread   Take: the command receiver's; it allocates. The desk plays what lies on the shelf.
// Failure  a request that cannot be met is told, and nothing else happens.

#include <functional>
#include <string>

#include "common/rig_numbers.hpp"
#include "common/spsc_ring.hpp"
#include "controller/loop/excitation_shelf.hpp"
#include "controller/loop/operator_desk.hpp"

namespace levitas::controller_program {

class ExcitationIntake {
 public:
  /// Keeps references to rig and commands. `refused` hears why.
  ExcitationIntake(const RigNumbers& rig, SpscRing<loop::RemoteCommand>& commands,
                   std::function<void(const std::string&)> refused);

  /// `step_yaml`: config/excitation_request.hpp.
  void Take(const std::string& step_yaml);

 private:
  [[nodiscard]] std::string Try(const std::string& step_yaml);

  const RigNumbers& rig_;
  SpscRing<loop::RemoteCommand>& commands_;
  std::function<void(const std::string&)> refused_;
  loop::ExcitationShelf shelf_;
};

}  // namespace levitas::controller_program
