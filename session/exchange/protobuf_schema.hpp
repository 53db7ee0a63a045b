#pragma once
// A protobuf message type as data, and messages of it: what viewers of MCAP files read.
//
// Source   developers.google.com/protocol-buffers, "Encoding"; descriptor.proto (proto3).
// Fields   doubles and texts only, numbered from 1 in the order given.
// Thread   any. Failure: none.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace levitas::session {

struct ProtobufField {
  std::string name;
  bool text{};  ///< else a double
};

/// Serialized FileDescriptorSet that holds package `levitas` with one message type.
[[nodiscard]] std::string ProtobufSchema(const std::string& message,
                                         std::span<const ProtobufField> fields);

/// One message of doubles; field i is `values[i]`.
void AppendDoubles(std::span<const double> values, std::string& message);
/// Field `number` of a message, as text.
void AppendText(int number, std::string_view text, std::string& message);

}  // namespace levitas::session
