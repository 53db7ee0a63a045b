#include "cli/run/telemetry.hpp"

#include <fmt/core.h>

#include <lcm/lcm-cpp.hpp>
#include <levitas_msg/controller_state_t.hpp>

#include "common/problem.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::cli {

struct Telemetry::Impl {
  explicit Impl(const std::string& url) : lcm(url) {}

  void Take(const lcm::ReceiveBuffer* /*buffer*/, const std::string& /*channel*/,
            const levitas_msg::controller_state_t* state) {
    newest =
        ProgressSample{static_cast<std::uint64_t>(state->cycle), static_cast<Mode>(state->mode),
                       state->speed_rad_per_s, state->position_m};
  }

  lcm::LCM lcm;
  std::optional<ProgressSample> newest;
};

Telemetry::Telemetry(const std::string& url) : impl_(std::make_unique<Impl>(url)) {
  if (impl_->lcm.good()) {
    impl_->lcm.subscribe(transport::channel::kState, &Impl::Take, impl_.get());
    return;
  }
  throw Problem(ExitStatus::kOther,
                fmt::format("LCM multicast cannot be received on {}: it needs a multicast route, "
                            "for example: ip link set lo up; ip route add 224.0.0.0/4 dev lo",
                            url));
}

Telemetry::~Telemetry() = default;

std::optional<ProgressSample> Telemetry::Wait(std::chrono::milliseconds limit) {
  impl_->newest.reset();
  impl_->lcm.handleTimeout(static_cast<int>(limit.count()));
  while (impl_->lcm.handleTimeout(0) > 0) {
  }
  return impl_->newest;
}

}  // namespace levitas::cli
