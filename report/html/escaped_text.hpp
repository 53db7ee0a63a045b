#pragma once
// Text as it may stand in HTML and SVG: between tags, or inside an attribute in double quotes.
// Thread   any. Failure: none.

#include <string>
#include <string_view>

namespace levitas::html {

/// With entities for & < > and the double quote.
[[nodiscard]] std::string Escaped(std::string_view text);

}  // namespace levitas::html
