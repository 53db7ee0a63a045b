#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "rt/say.hpp"

namespace levitas::rt {
namespace {

unsigned At(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// Bytes of the character of UTF-8 that begins the text; 0 where none does, and for C1 controls.
std::size_t CharacterBytes(std::string_view text) {
  const unsigned lead = At(text, 0);
  const std::size_t size = lead < 0xc2   ? 0
                           : lead < 0xe0 ? 2
                           : lead < 0xf0 ? 3
                           : lead < 0xf5 ? 4
                                         : 0;
  if (size == 0 || text.size() < size) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((At(text, i) & 0xc0U) != 0x80U) return 0;
  }
  // Overlong forms, surrogates, beyond Unicode, and U+0080 to U+009F.
  const unsigned next = At(text, 1);
  const bool bad = (lead == 0xe0 && next < 0xa0) || (lead == 0xed && next > 0x9f) ||
                   (lead == 0xf0 && next < 0x90) || (lead == 0xf4 && next > 0x8f) ||
                   (lead == 0xc2 && next < 0xa0);
  return bad ? 0 : size;
}

std::string Shown(std::string_view text, std::string_view line_break,
                  std::string_view tabulator = "\t") {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const unsigned first = At(text, 0);
    std::size_t bytes = 1;
    if (first == '\n') {
      shown += line_break;
    } else if (first == '\t') {
      shown += tabulator;
    } else if (first >= 0x20 && first < 0x7f) {
      shown += text[0];
    } else if (const std::size_t size = first < 0x80 ? 0 : CharacterBytes(text); size > 0) {
      shown += text.substr(0, size);
      bytes = size;
    } else {
      shown += fmt::format("\\x{:02x}", first);
    }
    text.remove_prefix(bytes);
  }
  return shown;
}

}  // namespace

std::string Printable(std::string_view text) { return Shown(text, "\n"); }

std::string Quoted(std::string_view text) { return Shown(text, "\n  "); }

std::string OneLine(std::string_view text) { return Shown(text, "\\x0a", "\\x09"); }

}  // namespace levitas::rt
