#include "io/light/polar_curve.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "io/base/atomic_file.h"
#include "io/base/xml_escaped.h"
#include "io/light/polar_drawing.h"

namespace io {
namespace {

std::string svg_color(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

std::string svg_line(const PolarDrawing::Line& line) {
  std::string path;
  for (const Eigen::Vector2d& point : line.points) {
    path += fmt::format("{}{:.2f},{:.2f}", path.empty() ? "M" : "L", point.x(), point.y());
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{}/>", path,
                     svg_color(line.color), line.width,
                     line.is_dashed ? " stroke-dasharray=\"6 4\"" : "");
}

std::string svg_label(const PolarDrawing::Label& label) {
  const char* anchor = label.anchor == 0 ? "start" : label.anchor == 1 ? "end" : "middle";
  return fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\">{}</text>",
      label.place.x(), label.place.y(), label.size, svg_color(label.color), anchor,
      xml_escaped(label.text));
}

}  // namespace

std::string polar_curve_svg(const radiosity::Photometry& photometry) {
  const PolarDrawing drawing = polar_drawing(photometry);
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {0}" width="{0}" height="{0}" )"
      R"(role="img" font-family="Helvetica,Arial,sans-serif">)"
      R"(<rect width="{0}" height="{0}" fill="#fff"/><title>{1}</title>)",
      drawing.size, xml_escaped(drawing.title));
  for (const PolarDrawing::Line& line : drawing.lines) svg += svg_line(line);
  for (const PolarDrawing::Label& label : drawing.labels) svg += svg_label(label);
  return svg + "</svg>\n";
}

void write_polar_curve(const std::filesystem::path& path, const radiosity::Photometry& photometry) {
  const std::string svg = polar_curve_svg(photometry);
  write_stream_atomically(path, [&](std::ofstream& stream) { stream << svg; });
}

}  // namespace io
