#pragma once
// What the pages of this folder have in common: head and style, and the gallery of pictures.
// Every picture is inside, as SVG in an address of its own, so that a page needs nothing beside it.
// Script   of a page that has Cursor(): the values under the pointer, zoom by dragging a rectangle.
//          Without it the pictures stand as they are.
// Thread   any. Failure: none; text of others is escaped.

#include <string>
#include <vector>

#include "report/session/pictures.hpp"

namespace levitas::report {

/// To the title at the top of the body.
[[nodiscard]] std::string PageStart(const std::string& title);
[[nodiscard]] std::string PageEnd();
/// The script; at the end of the body.
[[nodiscard]] std::string Cursor();
/// With a heading, each picture with its caption.
[[nodiscard]] std::string Gallery(const std::vector<NamedPicture>& pictures);

}  // namespace levitas::report
