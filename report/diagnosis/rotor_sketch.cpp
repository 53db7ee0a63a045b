#include "report/diagnosis/rotor_sketch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/html/escaped_text.hpp"

namespace levitas::report {
namespace {

using diagnosis::DiagnosisReport;
using diagnosis::ReportMark;
using diagnosis::ReportRotor;

constexpr double kSketchWidth = 760.0;
constexpr double kSketchMargin = 40.0;
constexpr double kSketchRow = 18.0;   ///< of a mark's text
constexpr double kMostRadius = 70.0;  ///< of the drawn rotor
constexpr double kMagnetWidth = 26.0;
constexpr double kMagnetHeight = 20.0;
constexpr double kSketchGap = 4.0;
constexpr double kLetter = 7.2;  ///< about the width of one of 13 px
constexpr const char* kSketchRed = "#d62728";

class Sketch {
 public:
  Sketch(const DiagnosisReport& report, const std::vector<std::string>& marks)
      : s_(report), marks_(marks) {
    double largest_m = 0.0;
    for (const ReportRotor::Piece& piece : s_.rotor.pieces) {
      from_m_ = std::min(from_m_, piece.from_m);
      to_m_ = std::max(to_m_, piece.to_m);
      largest_m = std::max(largest_m, piece.outer_m);
    }
    for (const ReportRotor::Bearing& bearing : s_.rotor.bearings) {
      from_m_ = std::min({from_m_, bearing.magnet_z_m, bearing.sensor_z_m});
      to_m_ = std::max({to_m_, bearing.magnet_z_m, bearing.sensor_z_m});
    }
    along_ = (kSketchWidth - 2.0 * kSketchMargin) / std::max(1e-6, to_m_ - from_m_);
    across_ = std::min(along_, 2.0 * kMostRadius / std::max(1e-6, largest_m));
    top_ = 8.0 + kSketchRow * static_cast<double>(std::max<std::size_t>(1, s_.marks.size()));
    axis_y_ = top_ + 0.5 * largest_m * across_ + kMagnetHeight + 14.0;
    height_ = axis_y_ + 0.5 * largest_m * across_ + kMagnetHeight + 64.0;
  }

  [[nodiscard]] std::string Draw() const {
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
               "width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" "
               "role=\"img\" aria-label=\"the rotor along its shaft\">\n",
               kSketchWidth, height_) +
           Pieces() + CentreLine() + Bearings() + Ruler() + Marks() + "</svg>\n";
  }

 private:
  [[nodiscard]] double X(double z_m) const { return kSketchMargin + (z_m - from_m_) * along_; }

  [[nodiscard]] double RadiusAt(double z_m) const {
    double radius = 3.0;
    for (const ReportRotor::Piece& piece : s_.rotor.pieces) {
      if (z_m < piece.from_m || z_m > piece.to_m) continue;
      radius = std::max(radius, 0.5 * piece.outer_m * across_);
    }
    return radius;
  }

  [[nodiscard]] std::string Pieces() const {
    std::string text;
    for (const ReportRotor::Piece& piece : s_.rotor.pieces) {
      const double radius = 0.5 * piece.outer_m * across_;
      text += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
          "stroke=\"#555\"/>\n",
          X(piece.from_m), axis_y_ - radius, std::max(2.0, (piece.to_m - piece.from_m) * along_),
          2.0 * radius, piece.disc ? "#b8c4d0" : "#dde4ea");
    }
    return text;
  }

  [[nodiscard]] std::string CentreLine() const {
    return fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#888\" "
        "stroke-dasharray=\"14 4 3 4\"/>\n",
        X(from_m_) - 16.0, axis_y_, X(to_m_) + 16.0, axis_y_);
  }

  [[nodiscard]] std::string Bearings() const {
    std::string text;
    for (const ReportRotor::Bearing& bearing : s_.rotor.bearings) {
      const double x = X(bearing.magnet_z_m);
      const double radius = RadiusAt(bearing.magnet_z_m) + kSketchGap;
      for (const double y : {axis_y_ - radius - kMagnetHeight, axis_y_ + radius}) {
        text += fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#1f77b4\" "
            "fill-opacity=\"0.55\" stroke=\"#1f77b4\"/>\n",
            x - 0.5 * kMagnetWidth, y, kMagnetWidth, kMagnetHeight);
      }
      const double sensor = X(bearing.sensor_z_m);
      const double surface = axis_y_ + RadiusAt(bearing.sensor_z_m) + kSketchGap;
      text += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}l5 10h-10z\" fill=\"#2ca02c\"/>\n"
          "<text x=\"{2:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4}</text>\n",
          sensor, surface, x, axis_y_ + radius + kMagnetHeight + 14.0, html::Escaped(bearing.name));
    }
    return text;
  }

  [[nodiscard]] std::string Ruler() const {
    const double y = height_ - 26.0;
    std::string text = fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#555\"/>\n",
        X(from_m_), y, X(to_m_), y);
    const double rough = (to_m_ - from_m_) / 6.0;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = rough / power < 2.0   ? 2.0 * power
                        : rough / power < 5.0 ? 5.0 * power
                                              : 10.0 * power;
    for (double z = std::ceil(from_m_ / step - 1e-9) * step + 0.0; z <= to_m_ + 1e-9; z += step) {
      text += fmt::format(
          "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"#555\"/>"
          "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\" font-size=\"11\">{4:.0f}"
          "</text>\n",
          X(z), y, y + 4.0, y + 16.0, 1e3 * z);
    }
    return text + fmt::format(
                      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\" font-size=\"11\">z, mm"
                      "</text><text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"11\" fill=\"#555\">blue: "
                      "magnets, green: sensors</text>\n",
                      kSketchWidth - 2.0, y - 4.0, X(from_m_), y - 6.0);
  }

  [[nodiscard]] std::string Marks() const {
    std::string text;
    for (std::size_t i = 0; i < s_.marks.size(); ++i) {
      const ReportMark& mark = s_.marks[i];
      const double x = X(mark.z_m);
      const double y = 4.0 + kSketchRow * static_cast<double>(i + 1);
      const std::string& shown = marks_[i];
      const double half = 0.5 * kLetter * static_cast<double>(shown.size());
      const double at = std::clamp(x, half + 2.0, std::max(half + 2.0, kSketchWidth - half - 2.0));
      const double tip = axis_y_ - RadiusAt(mark.z_m);
      text += fmt::format(
          "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" "
          "stroke-width=\"2\"/><path d=\"M{0:.1f} {4:.1f}l-5 -10h10z\" fill=\"{3}\"/>"
          "<circle cx=\"{0:.1f}\" cy=\"{5:.1f}\" r=\"{6:.1f}\" fill=\"none\" stroke=\"{3}\" "
          "stroke-width=\"2\"/><text x=\"{7:.1f}\" y=\"{8:.1f}\" text-anchor=\"middle\" "
          "fill=\"{3}\" font-weight=\"bold\">{9}</text>\n",
          x, y + 4.0, tip - 8.0, kSketchRed, tip, axis_y_, RadiusAt(mark.z_m) + 7.0, at, y,
          html::Escaped(shown));
    }
    return text;
  }

  const DiagnosisReport& s_;
  const std::vector<std::string>& marks_;
  double from_m_{std::numeric_limits<double>::infinity()};
  double to_m_{-std::numeric_limits<double>::infinity()};
  double along_{}, across_{}, top_{}, axis_y_{}, height_{};
};

}  // namespace

std::string RotorSketch(const DiagnosisReport& report, const std::vector<std::string>& marks) {
  if (report.rotor.pieces.empty()) return {};
  return Sketch(report, marks).Draw();
}

}  // namespace levitas::report
