#pragma once
// The one scope of the page, shared by its viewers: requests come in, its state and captures go
// out.
//
//   POST /api/scope      {"do": "arm", "source": "position", "channel": "de_x", "level_um": 20,
//                         "edge": "rising", "length_ms": 200, "before_percent": 25}
//                        source current: level_a; sources trip and now: neither channel nor level
//                        {"do": "stop"}
//   GET  /api/scope.json the newest capture for the page: whole nanometres, microamperes
//   GET  /api/scope.csv  the same in SI units, every digit
//
// Thread    any; locks, never for long: captures become text outside the lock.
// Failure   400 with the one thing that is wrong; 404 while nothing was captured.

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "dashboard/http_answer.hpp"
#include "dashboard/scope.hpp"

namespace levitas::dashboard {

class ScopeController {
 public:
  void RunIs(const RigNumbers& rig);
  void Tripped(std::uint64_t cycle);
  /// After samples were added.
  void Advance(const SampleStore& store);
  /// What the page is to be told, when something has changed since the last call.
  [[nodiscard]] std::optional<std::string> News();

  [[nodiscard]] HttpAnswer Ask(const std::string& body);
  [[nodiscard]] HttpAnswer CaptureJson() const;
  [[nodiscard]] HttpAnswer CaptureCsv() const;

 private:
  struct Kept {
    std::shared_ptr<const Capture> capture;
    std::vector<std::string> channels;
  };
  [[nodiscard]] Kept Newest() const;
  [[nodiscard]] std::string StateJson() const;

  mutable std::mutex mutex_;
  std::optional<RigNumbers> rig_;
  std::vector<std::string> captured_channels_;  ///< of the run that was captured
  Scope scope_;
  bool changed_{true};
};

/// What is asked for, in samples of the rig. Throws std::invalid_argument with one sentence.
[[nodiscard]] ScopeSettings UnderstandScope(const std::string& body, const RigNumbers& rig);

}  // namespace levitas::dashboard
