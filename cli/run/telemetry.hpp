#pragma once
// Follows the controller's decimated telemetry (channel LEVITAS_STATE).
//
// Thread   one; liblcm keeps a receiving thread of its own behind it.
// Failure  Problem (exit status 1) when this machine cannot receive LCM multicast.
// Lost     telemetry may drop messages; nothing here depends on a single one.

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "cli/run/progress.hpp"

namespace levitas::cli {

class Telemetry {
 public:
  /// `url` as LCM's tools take it, of the telemetry direction.
  explicit Telemetry(const std::string& url);
  ~Telemetry();

  /// The newest state, waiting for at most `limit`; nothing when none came.
  [[nodiscard]] std::optional<ProgressSample> Wait(std::chrono::milliseconds limit);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::cli
