#pragma once
// The live page of a run: listens to its telemetry, serves the page, passes commands on.
//
// Rate      kTick for figures, kSpectrumEvery for spectra, whatever the loop does; while nobody
//           looks nothing is built.
// Load      the loop never waits for any of this: it hears of viewers only through commands.
// Thread    construct and destroy from one thread; it has its own.
// Failure   Problem when the network cannot be joined or the address not be bound.

#include <chrono>
#include <memory>
#include <string>

#include "dashboard/commander.hpp"
#include "dashboard/web_server.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::dashboard {

inline constexpr std::chrono::milliseconds kTick{50};
inline constexpr std::chrono::milliseconds kSpectrumEvery{250};
inline constexpr double kHighestSpectrumHz = 500.0;  ///< until a viewer asks for another range

class Dashboard {
 public:
  /// `patience`: how long a command waits for the controller's word.
  Dashboard(const transport::LcmNetwork& network, const WebOptions& web,
            std::chrono::milliseconds patience = Commander::kPatience);
  ~Dashboard();
  Dashboard(const Dashboard&) = delete;
  Dashboard& operator=(const Dashboard&) = delete;

  [[nodiscard]] std::string Url() const;
  /// Tells viewers, also those to come, that no more follows. Any thread.
  void RunEnded(const std::string& how);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::dashboard
