#include "report/session/page_parts.hpp"

#include <fmt/format.h>

#include "report/svg/escaped_text.hpp"

namespace levitas::report {
namespace {

constexpr const char* kStyle = R"css(
body{font:16px/1.5 sans-serif;max-width:76em;margin:0 auto;padding:1em;color:#1f2430;background:#fff}
h1{font-size:1.5em;margin:.2em 0}h2{font-size:1.2em;margin:1.6em 0 .4em}
.verdict{padding:.7em 1em;margin:1em 0;border-left:8px solid #d55e00;background:#fbefe6;
font-size:1.1em}.verdict.good{border-color:#0072b2;background:#e8f2f9}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,28em),1fr));gap:1em}
figure{margin:0;border:1px solid #d9dee6;border-radius:4px;padding:.4em}
figure img{display:block;width:100%;height:auto}
figcaption{color:#4b5363;font-size:.85em;padding:.3em .4em}
.scroll{overflow-x:auto}pre{font-size:.8em;line-height:1.35;margin:.3em 0}
table{border-collapse:collapse}td,th{padding:.15em .8em .15em 0;text-align:left;
vertical-align:top;border-bottom:1px solid #e3e7ee}td{overflow-wrap:anywhere}td.n,th.n{text-align:right;
font-variant-numeric:tabular-nums;white-space:nowrap}tr.trip{font-weight:bold}
summary{cursor:pointer;font-weight:bold;padding:.3em 0}
@media print{figure{break-inside:avoid}details{display:none}}
)css";

/// A picture as an address that holds it. As an image of its own its names collide with no other's.
std::string DataAddress(const std::string& svg) {
  std::string address = "data:image/svg+xml,";
  address.reserve(svg.size() + svg.size() / 8);
  for (const char c : svg) {
    if (c == '%' || c == '#' || c == '&' || c == '"' || c == '<' || c == '>' || c == '\n') {
      address += fmt::format("%{:02X}", static_cast<unsigned>(c));
    } else {
      address += c;
    }
  }
  return address;
}

}  // namespace

std::string PageStart(const std::string& title) {
  return fmt::format(
      "<!doctype html>\n<html lang=en><head><meta charset=utf-8>\n<meta name=viewport "
      "content='width=device-width,initial-scale=1'>\n<title>{0}</title>\n<style>{1}</style></head>"
      "\n<body>\n<h1>{0}</h1>\n",
      svg::Escaped(title), kStyle);
}

std::string PageEnd() { return "</body></html>\n"; }

std::string Gallery(const std::vector<NamedPicture>& pictures) {
  std::string html = "<h2>Pictures</h2>\n<div class=pictures>\n";
  for (const NamedPicture& picture : pictures) {
    html += fmt::format(
        "<figure id=\"{}\"><img alt=\"{}\" src=\"{}\"><figcaption>{}</figcaption></figure>\n",
        svg::Escaped(picture.name), svg::Escaped(picture.caption),
        DataAddress(svg::Draw(picture.figure)), svg::Escaped(picture.caption));
  }
  return html + "</div>\n";
}

}  // namespace levitas::report
