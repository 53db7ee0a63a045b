#include "hil/can_port/bus_watch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace levitas::can_port {

using can::BusEvent;

void BusWatch::Note(const can::Reception& reception) noexcept {
  switch (reception.event) {
    case BusEvent::kNothing:
    case BusEvent::kFrame:
      break;
    case BusEvent::kBusOff:
      ++counters_.bus_off;
      off_[reception.socket] = true;
      unheard_[reception.socket] = 0;
      break;
    case BusEvent::kRestarted:
      ++counters_.restarts;
      Back(reception.socket);
      break;
    case BusEvent::kErrorActive:
      Back(reception.socket);
      break;
    case BusEvent::kErrorPassive:
      ++counters_.error_passive;
      break;
    case BusEvent::kProtocolError:
      ++counters_.protocol_errors;
      break;
    case BusEvent::kChipOverrun:
      ++counters_.chip_overruns;
      break;
    case BusEvent::kLinkDown:
      ++counters_.link_down;
      Back(reception.socket);
      break;
  }
}

bool BusWatch::Hears(std::size_t socket) noexcept {
  if (!off_[socket]) return true;
  ++counters_.unheard;
  if (++unheard_[socket] < kBackAfter) return false;
  ++counters_.returns;
  Back(socket);
  return true;
}

void BusWatch::Note(can::SendResult result) noexcept {
  if (result == can::SendResult::kFull) ++counters_.full;
  if (result == can::SendResult::kDown) ++counters_.down;
}

bool BusWatch::AnyOff() const noexcept {
  return std::any_of(off_.begin(), off_.end(), [](bool off) { return off; });
}

std::string Text(const BusCounters& counters, std::uint64_t dropped) {
  const std::array<std::pair<std::uint64_t, const char*>, 13> kinds{
      {{counters.bus_off, "bus off"},
       {counters.restarts, "bus restarted"},
       {counters.returns, "bus back without a word of its chip"},
       {counters.error_passive, "error passive"},
       {counters.protocol_errors, "error on the wire"},
       {counters.chip_overruns, "frames lost in the chip"},
       {counters.link_down, "link down"},
       {counters.unheard, "frame from a bus that is off, ignored"},
       {counters.read_limit, "more frames waiting than one period may read (a babbling node)"},
       {counters.stale, "frame too old to be used"},
       {counters.full, "frame the bus could not take (ENOBUFS)"},
       {counters.down, "frame without a link"},
       {dropped, "frame dropped by the kernel, read too late"}}};
  std::string text;
  for (const auto& [count, name] : kinds) {
    if (count == 0) continue;
    if (!text.empty()) text += "; ";
    text += fmt::format("{} x {}", count, name);
  }
  return text;
}

}  // namespace levitas::can_port
