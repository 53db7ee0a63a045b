#include "report/session/page_parts.hpp"

#include <fmt/format.h>

#include "report/html/escaped_text.hpp"

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
vertical-align:top;border-bottom:1px solid #e3e7ee}td{overflow-wrap:anywhere}td.k{font-weight:bold;
white-space:nowrap}td.n,th.n{text-align:right;
font-variant-numeric:tabular-nums;white-space:nowrap}tr.trip{font-weight:bold}
summary{cursor:pointer;font-weight:bold;padding:.3em 0}
.tables{display:flex;flex-wrap:wrap;gap:1em 3em;align-items:flex-start}
nav{margin:1em 0}nav a{margin-right:1em}.objections{font-weight:bold}
figure.live img{cursor:crosshair;touch-action:pan-y}figure{position:relative}
figure output{display:block;min-height:1.4em;font-size:.85em;padding:0 .4em;
font-variant-numeric:tabular-nums}
.drag{position:absolute;border:1px dashed #444;background:#0072b21a;pointer-events:none}
@media print{figure{break-inside:avoid}details{display:none}}
)css";

// Cursor: the values of the axes under the pointer. Zoom: a rectangle is dragged, which becomes the
// view of the drawing; a double click shows all of it again. data-panels has, per panel, its frame
// in the drawing and its axes: [left, right, top, bottom, x low, x high, x logarithmic, ...].
constexpr const char* kScript = R"js(
for(const f of document.querySelectorAll('figure[data-panels]')){
const img=f.querySelector('img'),panels=JSON.parse(f.dataset.panels),
all=f.dataset.view.split(' ').map(Number),out=f.appendChild(document.createElement('output'));
let view=all,from=null,box=null;f.classList.add('live');img.draggable=false;
const help='move: values; drag: zoom; double click: all of it';out.textContent=help;
const at=e=>{const r=img.getBoundingClientRect();return[view[0]+(e.clientX-r.left)/r.width*view[2],
view[1]+(e.clientY-r.top)/r.height*view[3]]};
const value=(share,low,high,log)=>log?low*Math.pow(high/low,share):low+share*(high-low);
const text=v=>Number(v.toPrecision(4)).toString();
const show=v=>{view=v;img.setAttribute('src',img.getAttribute('src').replace(/viewBox='[^']*'/,"viewBox='"+v.map(n=>n.toFixed(1)).join(' ')+"'"))};
img.addEventListener('pointermove',e=>{const[x,y]=at(e),p=panels.find(p=>x>=p.f[0]&&x<=p.f[1]&&y>=p.f[2]&&y<=p.f[3]);
out.textContent=p?p.n[0]+' '+text(value((x-p.f[0])/(p.f[1]-p.f[0]),...p.x))+'   '+p.n[1]+' '+
text(value((p.f[3]-y)/(p.f[3]-p.f[2]),...p.y)):help;
if(box){const o=f.getBoundingClientRect();box.style.cssText='left:'+(Math.min(from[0],e.clientX)-o.left)+'px;top:'+
(Math.min(from[1],e.clientY)-o.top)+'px;width:'+Math.abs(e.clientX-from[0])+'px;height:'+Math.abs(e.clientY-from[1])+'px'}});
img.addEventListener('pointerdown',e=>{if(e.pointerType!='mouse'||e.button)return;e.preventDefault();
img.setPointerCapture(e.pointerId);
from=[e.clientX,e.clientY,...at(e)];box=f.appendChild(document.createElement('div'));box.className='drag'});
const end=e=>{if(!box)return;box.remove();box=null;const[x,y]=at(e),w=Math.abs(x-from[2]),h=Math.abs(y-from[3]);
if(e.type!='pointerup'||w<view[2]/50||h<view[3]/50)return;const k=Math.max(w/all[2],h/all[3]);
show([(x+from[2]-k*all[2])/2,(y+from[3]-k*all[3])/2,k*all[2],k*all[3]])};
img.addEventListener('pointerup',end);img.addEventListener('pointercancel',end);
img.addEventListener('dblclick',()=>show(all))}
)js";

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

std::string AxisText(const svg::Range& range, svg::Scale scale) {
  return fmt::format("[{:.9g},{:.9g},{}]", range.low, range.high,
                     scale == svg::Scale::kLogarithmic);
}

/// A name as JSON has it: labels are ours or a session's channels.
std::string Quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (static_cast<unsigned char>(c) < 0x20) continue;
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

std::string ForTheCursor(const svg::Figure& figure) {
  const auto places = svg::Places(figure);
  const svg::Size size = svg::SizeOf(figure);
  std::string panels = "[";
  for (std::size_t i = 0; i < places.size(); ++i) {
    const svg::PanelPlace& at = places[i];
    const svg::Panel& panel = figure.panels[i];
    panels += fmt::format(
        "{}{{\"f\":[{:.1f},{:.1f},{:.1f},{:.1f}],\"x\":{},\"y\":{},\"n\":[{},{}]}}",
        i == 0 ? "" : ",", at.left, at.right, at.top, at.bottom, AxisText(at.x, panel.x_scale),
        AxisText(at.y, panel.y_scale), Quoted(panel.x_label + ':'), Quoted(panel.y_label + ':'));
  }
  return fmt::format("data-view=\"0 0 {:.0f} {:.0f}\" data-panels=\"{}\"", size.width, size.height,
                     html::Escaped(panels + "]"));
}

}  // namespace

std::string PageStart(const std::string& title) {
  return fmt::format(
      "<!doctype html>\n<html lang=en><head><meta charset=utf-8>\n<meta name=viewport "
      "content='width=device-width,initial-scale=1'>\n<title>{0}</title>\n<style>{1}</style></head>"
      "\n<body>\n<h1>{0}</h1>\n",
      html::Escaped(title), kStyle);
}

std::string PageEnd() { return "</body></html>\n"; }

std::string Cursor() { return fmt::format("<script>{}</script>\n", kScript); }

std::string Gallery(const std::vector<NamedPicture>& pictures) {
  std::string html = "<h2 id=pictures>Pictures</h2>\n<div class=pictures>\n";
  for (const NamedPicture& picture : pictures) {
    html += fmt::format(
        "<figure id=\"{}\" {}><img alt=\"{}\" src=\"{}\"><figcaption>{}</figcaption></figure>\n",
        html::Escaped(picture.name), ForTheCursor(picture.figure), html::Escaped(picture.caption),
        DataAddress(svg::Draw(picture.figure)), html::Escaped(picture.caption));
  }
  return html + "</div>\n";
}

}  // namespace levitas::report
