#include "hil/can/dbc.hpp"

#include <fmt/core.h>

namespace levitas::can {
namespace {

constexpr const char* kHead = R"(VERSION ""

NS_ :
  CM_
  BA_DEF_
  BA_
  BA_DEF_DEF_

BS_:

BU_: Rig Controller

)";

const char* NodeOf(Sender sender) { return sender == Sender::kRig ? "Rig" : "Controller"; }
const char* OtherNode(Sender sender) { return sender == Sender::kRig ? "Controller" : "Rig"; }

/// Range of the raw numbers that are not "absent", in units of the signal.
struct Range {
  double low{};
  double high{};
};

Range RangeOf(const Signal& signal) {
  const auto steps = static_cast<double>((std::uint64_t{1} << signal.bits) - 1);
  if (!signal.is_signed) return {0.0, steps * signal.factor};
  const double high = (steps - 1.0) / 2.0;
  return {-high * signal.factor, high * signal.factor};
}

/// The protection's own two signals come first in every message.
std::vector<Signal> ProtectionSignals(Profile profile) {
  const bool short_one = profile == Profile::k11;
  return {{.name = "checksum",
           .bits = static_cast<std::uint8_t>(short_one ? 8 : 16),
           .meaning = short_one ? "CRC-8 SAE J1850 with Data ID" : "CRC-16 CCITT with Data ID"},
          {.name = "alive_counter",
           .start_bit = static_cast<std::uint16_t>(short_one ? 8 : 16),
           .bits = static_cast<std::uint8_t>(short_one ? 4 : 8),
           .meaning = short_one ? "0 to 14" : "0 to 255"}};
}

std::vector<Signal> AllSignals(const Message& message) {
  std::vector<Signal> signals = ProtectionSignals(message.profile);
  signals.insert(signals.end(), message.signals.begin(), message.signals.end());
  return signals;
}

const char* ProfileText(Profile profile) {
  return profile == Profile::k11 ? "E2E profile 11" : "E2E profile 5";
}

}  // namespace

std::string DbcText(const Layout& layout) {
  std::string text = kHead;
  std::string comments;
  std::string attributes;
  const bool fd = layout.format == Format::kFd;
  for (const Message& message : layout.messages) {
    text += fmt::format("BO_ {} {}: {} {}\n", message.id, message.name, message.bytes,
                        NodeOf(message.sender));
    comments += fmt::format("CM_ BO_ {} \"every {} periods of {} ns; {}, Data ID {}\";\n",
                            message.id, message.every, layout.period_ns,
                            ProfileText(message.profile), message.data_id());
    attributes += fmt::format("BA_ \"VFrameFormat\" BO_ {} {};\n", message.id, fd ? 14 : 0);
    for (const Signal& signal : AllSignals(message)) {
      const Range range = RangeOf(signal);
      text +=
          fmt::format(" SG_ {} : {}|{}@1{} ({},0) [{}|{}] \"{}\" {}\n", signal.name,
                      signal.start_bit, signal.bits, signal.is_signed ? '-' : '+', signal.factor,
                      range.low, range.high, signal.unit, OtherNode(message.sender));
      comments += fmt::format("CM_ SG_ {} {} \"{}\";\n", message.id, signal.name, signal.meaning);
    }
    text += '\n';
  }
  return text + comments +
         "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"reserved\","
         "\"J1939PG\",\"reserved\",\"reserved\",\"reserved\",\"reserved\",\"reserved\","
         "\"reserved\",\"reserved\",\"reserved\",\"reserved\",\"reserved\",\"StandardCAN_FD\","
         "\"ExtendedCAN_FD\";\nBA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN\";\n" +
         attributes;
}

std::string LayoutMarkdown(const Layout& layout) {
  std::string text;
  for (const Message& message : layout.messages) {
    text += fmt::format("**{}**, identifier 0x{:03X}, from {}, {} bytes, every {}, {}\n\n",
                        message.name, message.id,
                        message.sender == Sender::kRig ? "rig" : "controller", message.bytes,
                        message.every == 1 ? "period" : fmt::format("{} periods", message.every),
                        ProfileText(message.profile));
    text += "| signal | first bit | bits | step | range | meaning |\n|---|---|---|---|---|---|\n";
    for (const Signal& signal : AllSignals(message)) {
      const Range range = RangeOf(signal);
      text += fmt::format("| `{}` | {} | {}{} | {:.6g} {} | {:.6g} to {:.6g} | {} |\n", signal.name,
                          signal.start_bit, signal.bits, signal.is_signed ? ", signed" : "",
                          signal.factor, signal.unit, range.low, range.high, signal.meaning);
    }
    text += '\n';
  }
  return text;
}

}  // namespace levitas::can
