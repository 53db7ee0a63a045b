#pragma once
// The rig of the run that is looked at, for the server's threads.
//
// Thread   any; Get copies under a lock.

#include <mutex>
#include <optional>

#include "common/rig_numbers.hpp"

namespace levitas::dashboard {

class AnnouncedRig {
 public:
  void Set(const RigNumbers& rig) {
    const std::lock_guard lock(mutex_);
    rig_ = rig;
  }
  /// Nothing before the first controller was heard.
  [[nodiscard]] std::optional<RigNumbers> Get() const {
    const std::lock_guard lock(mutex_);
    return rig_;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<RigNumbers> rig_;
};

}  // namespace levitas::dashboard
