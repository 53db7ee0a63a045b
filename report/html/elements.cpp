#include "report/html/elements.hpp"

#include <fmt/core.h>

#include "report/html/escaped_text.hpp"

namespace levitas::html {
namespace {

std::string ClassOf(const std::string& style_class) {
  return style_class.empty() ? "" : fmt::format(" class=\"{}\"", Escaped(style_class));
}

}  // namespace

std::string Paragraph(const std::string& text, const std::string& style_class) {
  if (text.empty()) return {};
  return fmt::format("<p{}>{}</p>\n", ClassOf(style_class), Escaped(text));
}

std::string Paragraphs(const std::vector<std::string>& texts, const std::string& style_class) {
  std::string html;
  for (const std::string& text : texts) html += Paragraph(text, style_class);
  return html;
}

std::string List(const std::vector<std::string>& texts, const std::string& style_class) {
  if (texts.empty()) return {};
  std::string html = fmt::format("<ul{}>\n", ClassOf(style_class));
  for (const std::string& text : texts) html += fmt::format("<li>{}</li>\n", Escaped(text));
  return html + "</ul>\n";
}

std::string Folded(const std::string& title, const std::string& text) {
  if (text.empty()) return {};
  return FoldedMarkup(title, fmt::format("<div class=scroll><pre>{}</pre></div>", Escaped(text)));
}

std::string FoldedMarkup(const std::string& title, const std::string& markup) {
  return fmt::format("<details><summary>{}</summary>{}</details>\n", Escaped(title), markup);
}

}  // namespace levitas::html
