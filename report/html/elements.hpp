#pragma once
// Parts of a page that are made of text: what is given is text, and stands in the page escaped.
//
// Empty    an element without text is left out, but for FoldedMarkup.
// Thread   any. Failure: none.

#include <string>
#include <vector>

namespace levitas::html {

/// `style_class`: of the style of the page; empty: none.
[[nodiscard]] std::string Paragraph(const std::string& text, const std::string& style_class = {});
[[nodiscard]] std::string Paragraphs(const std::vector<std::string>& texts,
                                     const std::string& style_class = {});
/// Of one sentence each.
[[nodiscard]] std::string List(const std::vector<std::string>& texts,
                               const std::string& style_class);
/// Text whose lines stay as they are, below a line that opens it.
[[nodiscard]] std::string Folded(const std::string& title, const std::string& text);
/// Markup below a line that opens it.
[[nodiscard]] std::string FoldedMarkup(const std::string& title, const std::string& markup);

}  // namespace levitas::html
