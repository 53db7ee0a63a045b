#include "session/exchange/protobuf_schema.hpp"

#include <bit>
#include <cstdint>

namespace levitas::session {
namespace {

enum WireType : unsigned { kVarint = 0, kFixed64 = 1, kBytes = 2 };

void AppendVarint(std::uint64_t value, std::string& out) {
  while (value > 0x7FU) {
    out += static_cast<char>((value & 0x7FU) | 0x80U);
    value >>= 7U;
  }
  out += static_cast<char>(value);
}

void AppendTag(int number, WireType type, std::string& out) {
  AppendVarint(static_cast<std::uint64_t>(number) << 3U | type, out);
}

void AppendNumber(int number, std::uint64_t value, std::string& out) {
  AppendTag(number, kVarint, out);
  AppendVarint(value, out);
}

// Numbers of descriptor.proto.
constexpr int kFileOfSet = 1;
constexpr int kFileName = 1, kFilePackage = 2, kFileMessage = 4, kFileSyntax = 12;
constexpr int kMessageName = 1, kMessageField = 2;
constexpr int kFieldName = 1, kFieldNumber = 3, kFieldLabel = 4, kFieldType = 5;
constexpr std::uint64_t kLabelOptional = 1;
constexpr std::uint64_t kTypeDouble = 1, kTypeString = 9;

}  // namespace

void AppendText(int number, std::string_view text, std::string& message) {
  AppendTag(number, kBytes, message);
  AppendVarint(text.size(), message);
  message += text;
}

void AppendDoubles(std::span<const double> values, std::string& message) {
  int number = 0;
  for (const double value : values) {
    AppendTag(++number, kFixed64, message);
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (unsigned i = 0; i < 8; ++i) message += static_cast<char>(bits >> (8 * i) & 0xFFU);
  }
}

std::string ProtobufSchema(const std::string& message, std::span<const ProtobufField> fields) {
  std::string type;
  AppendText(kMessageName, message, type);
  int number = 0;
  for (const ProtobufField& field : fields) {
    std::string about;
    AppendText(kFieldName, field.name, about);
    AppendNumber(kFieldNumber, static_cast<std::uint64_t>(++number), about);
    AppendNumber(kFieldLabel, kLabelOptional, about);
    AppendNumber(kFieldType, field.text ? kTypeString : kTypeDouble, about);
    AppendText(kMessageField, about, type);
  }
  std::string file;
  AppendText(kFileName, "levitas/" + message + ".proto", file);
  AppendText(kFilePackage, "levitas", file);
  AppendText(kFileMessage, type, file);
  AppendText(kFileSyntax, "proto3", file);
  std::string set;
  AppendText(kFileOfSet, file, set);
  return set;
}

}  // namespace levitas::session
