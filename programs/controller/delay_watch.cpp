#include "programs/controller/delay_watch.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "common/problem.hpp"
#include "hil/socketcan/socket_can.hpp"
#include "rt/thread_trouble.hpp"

namespace levitas::controller_program {
namespace {

constexpr auto kLookEvery = std::chrono::milliseconds(5);
constexpr int kMostPerLook = 4096;  // a bus that babbles keeps the thread from nothing else

}  // namespace

DelayWatch::DelayWatch(const socketcan::CanConnection& plan, double expected_periods)
    : meter_(plan.layout, plan.budget, plan.virtual_bus), expected_periods_(expected_periods) {
  try {
    access_ = std::make_unique<socketcan::SocketCan>(plan.layout, plan.buses, std::nullopt);
  } catch (const Problem& problem) {
    news_ = fmt::format("the delay of the buses is not measured: {}", problem.what());
    return;
  }
  thread_ = std::thread([this] { rt::Guarded("delay", [this] { Listen(); }); });
}

DelayWatch::~DelayWatch() {
  ends_.store(true);
  if (thread_.joinable()) thread_.join();
}

void DelayWatch::Listen() noexcept {
  while (!ends_.load()) {
    for (int look = 0; look < kMostPerLook; ++look) {
      const can::Reception got = access_->Next();
      if (got.event == can::BusEvent::kNothing) break;
      if (got.event == can::BusEvent::kFrame) meter_.Take(got.frame);
    }
    std::this_thread::sleep_for(kLookEvery);
  }
}

std::string DelayWatch::TakeNews() {
  if (!news_.empty()) return std::exchange(news_, {});
  if (judged_) return {};
  const can_port::DelayFigures acting = meter_.Acting();
  if (acting.count < kEnough) return {};
  judged_ = true;
  return DelayObjection(acting, expected_periods_);
}

std::string DelayObjection(const can_port::DelayFigures& acting, double expected_periods) {
  if (acting.count == 0) return {};
  if (std::abs(acting.median_periods - expected_periods) <= DelayWatch::kTolerance) return {};
  return fmt::format(
      "from sample to current {:.2f} periods were measured (median of {}), but margins and verdict "
      "take {:.2f}: correct delay_samples or current_acts in the rig's file",
      acting.median_periods, acting.count, expected_periods);
}

}  // namespace levitas::controller_program
