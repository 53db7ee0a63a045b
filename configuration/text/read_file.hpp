#pragma once
// Reads one kind of file into a struct by its table (schema/visitor.hpp).
//
// Failure  BadInput: the file cannot be read, is another kind, or the whole list of its problems.
// Thread   any; not for the control cycle.

#include <string>
#include <string_view>

#include "configuration/text/reader.hpp"

namespace levitas::configuration {

/// The text of a file of at most kMostBytes (document.hpp); a longer one is refused when parsed.
[[nodiscard]] std::string ReadText(const std::string& path);

/// `describe(visitor, value)` is the table; `kind` is what the file has to name itself.
template <class Value, class Describe>
[[nodiscard]] Value ReadAs(const std::string& text, const std::string& file_name,
                           std::string_view kind, Describe describe) {
  const Document document = ReadDocument(text);
  Reader reader(document, file_name);
  Value value{};
  if (reader.WrongKind(kind)) {
    reader.FinishEarly();
  } else {
    describe(reader, value);
    reader.Finish();
  }
  return value;
}

}  // namespace levitas::configuration
