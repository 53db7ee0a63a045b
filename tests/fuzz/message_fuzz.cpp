// A datagram's payload as every type of message: what passes the guard is a message, and the page
// takes it or counts it. The first byte of the input chooses the type.

#include "dashboard/live_run.hpp"
#include "lcmtypes/checked_decode.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/verify.hpp"
#include "tests/unit/dashboard/announced_run.hpp"
#include "tests/unit/messages/samples.hpp"

namespace levitas::fuzz {
namespace {

using message::testing::EveryMessage;
using message::testing::kEveryMessageCount;

template <std::size_t Type>
void Decode(std::span<const std::uint8_t> payload) {
  using Message = std::tuple_element_t<Type, EveryMessage>;
  // The hash is the type's own: without it nothing behind it would be reached.
  auto bytes = message::testing::Encoded(message::testing::Sample<Message>());
  bytes.resize(message::kHashBytes);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  Message read{};
  if (message::DecodeChecked(bytes, read)) {
    Verify(message::testing::Encoded(read) == bytes, "what is decoded is what was sent");
  }
}

template <std::size_t... Types>
void DecodeAs(std::size_t type, std::span<const std::uint8_t> payload,
              std::index_sequence<Types...> /*all*/) {
  (void)((type == Types ? (Decode<Types>(payload), true) : false) || ...);
}

/// A page that has seen its rig, and then hears this.
void Show(std::size_t type, std::span<const std::uint8_t> payload) {
  namespace channel = transport::channel;
  static constexpr std::array<const char*, 6> kHeard{channel::kHeader, channel::kState,
                                                     channel::kTiming, channel::kHistogram,
                                                     channel::kEvent,  channel::kSamples};
  static const session::Bytes kHeader = dashboard::EncodedHeader(1);
  static dashboard::LiveRun run;
  if (run.run_number() != 1) {
    run = dashboard::LiveRun();
    run.Take(channel::kHeader, kHeader, 0);
  }
  run.Take(kHeard[type % kHeard.size()], payload, 0);
}

template <std::size_t... Types>
std::vector<std::string> SeedsOf(std::index_sequence<Types...> /*all*/) {
  const auto seed = [](std::size_t type, const message::testing::Bytes& bytes) {
    return std::string(1, static_cast<char>(type)) +
           std::string(bytes.begin() + message::kHashBytes, bytes.end());
  };
  return {
      seed(Types, message::testing::Encoded(
                      message::testing::Sample<std::tuple_element_t<Types, EveryMessage>>()))...};
}

}  // namespace

std::vector<std::string> Seeds() { return SeedsOf(std::make_index_sequence<kEveryMessageCount>()); }

}  // namespace levitas::fuzz

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return -1;
  const std::span<const std::uint8_t> payload(data + 1, size - 1);
  using levitas::message::testing::kEveryMessageCount;
  levitas::fuzz::DecodeAs(data[0] % kEveryMessageCount, payload,
                          std::make_index_sequence<kEveryMessageCount>());
  levitas::fuzz::Show(data[0], payload);
  return 0;
}
