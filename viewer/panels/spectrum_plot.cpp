#include "viewer/panels/spectrum_plot.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "io/picture/color_bar.h"
#include "io/picture/color_map.h"
#include "radiosity/solve/quantity.h"
#include "viewer/desk/spectrum.h"

namespace viewer {
namespace {

using radiosity::Index;

constexpr ImU32 kAxisInk = IM_COL32(210, 210, 210, 255);
constexpr ImU32 kAxisLine = IM_COL32(70, 72, 78, 255);
constexpr ImU32 kHereLine = IM_COL32(255, 170, 40, 255);
constexpr float kPlainFont = 13;    // pixels of text at scale 1
constexpr float kPlotHeight = 130;  // at scale 1
constexpr int kMostLevels = 5;
constexpr int kMostWavelengths = 5;

/// Where the curves stand in the window.
struct SpectrumFrame {
  ImVec2 top_left;
  ImVec2 bottom_right;
  SpectrumAxes axes;

  [[nodiscard]] float x(double wavelength) const {
    return top_left.x + static_cast<float>(io::position_on(axes.wavelengths, wavelength)) *
                            (bottom_right.x - top_left.x);
  }
  [[nodiscard]] float y(double value) const {
    return bottom_right.y -
           static_cast<float>(io::position_on(axes.values, value)) * (bottom_right.y - top_left.y);
  }
};

void draw_axes(ImDrawList& list, const SpectrumFrame& frame, float left) {
  const float line = ImGui::GetTextLineHeight();
  for (const double level : io::tick_values(frame.axes.values, kMostLevels)) {
    const float y = frame.y(level);
    list.AddLine(ImVec2(frame.top_left.x, y), ImVec2(frame.bottom_right.x, y), kAxisLine);
    list.AddText(ImVec2(left, y - line / 2), kAxisInk, io::tick_label(level).c_str());
  }
  for (const double wavelength : io::tick_values(frame.axes.wavelengths, kMostWavelengths)) {
    const std::string label = io::tick_label(wavelength);
    const float width = ImGui::CalcTextSize(label.c_str()).x;
    const float x = frame.x(wavelength);
    list.AddLine(ImVec2(x, frame.top_left.y), ImVec2(x, frame.bottom_right.y), kAxisLine);
    const float place = std::min(x - width / 2, frame.bottom_right.x - width);
    list.AddText(ImVec2(place, frame.bottom_right.y + 0.2F * line), kAxisInk, label.c_str());
  }
}

}  // namespace

void draw_spectrum_plot(const PatchFacts& facts, const radiosity::Bands& bands) {
  struct Curve {
    const char* name;
    const Eigen::VectorXd& values;
    ImU32 color;
  };
  const std::array curves = {Curve{"radiosity B", facts.radiosity, IM_COL32(255, 190, 90, 255)},
                             Curve{"irradiance H", facts.irradiance, IM_COL32(110, 190, 255, 255)}};
  const float size = ImGui::GetFontSize() / kPlainFont;
  const float line = ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  SpectrumFrame frame;
  frame.axes = spectrum_axes(bands, facts.radiosity, facts.irradiance);
  float label_width = 0;
  for (const double level : io::tick_values(frame.axes.values, kMostLevels)) {
    label_width = std::max(label_width, ImGui::CalcTextSize(io::tick_label(level).c_str()).x);
  }
  frame.top_left = ImVec2(corner.x + label_width + 6 * size, corner.y + 1.7F * line);
  frame.bottom_right = ImVec2(corner.x + width - 6 * size, frame.top_left.y + kPlotHeight * size);
  ImGui::Dummy(ImVec2(width, frame.bottom_right.y + 1.4F * line - corner.y));
  const bool is_hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_axes(list, frame, corner.x);
  float name_left = corner.x;
  for (const Curve& curve : curves) {
    list.AddText(ImVec2(name_left, corner.y), curve.color, curve.name);
    name_left += ImGui::CalcTextSize(curve.name).x + line;
    std::vector<ImVec2> points;
    for (Index b = 0; b < curve.values.size(); ++b) {
      points.emplace_back(frame.x(bands.wavelengths[static_cast<std::size_t>(b)]),
                          frame.y(curve.values[b]));
    }
    list.AddPolyline(points.data(), static_cast<int>(points.size()), curve.color, 0, 1.7F * size);
  }
  list.AddText(ImVec2(name_left, corner.y), kAxisInk, "over nm");
  if (!is_hovered) return;
  const double share =
      (ImGui::GetIO().MousePos.x - frame.top_left.x) / (frame.bottom_right.x - frame.top_left.x);
  const Index band = nearest_band(bands, io::value_at(frame.axes.wavelengths, share));
  const float x = frame.x(bands.wavelengths[static_cast<std::size_t>(band)]);
  list.AddLine(ImVec2(x, frame.top_left.y), ImVec2(x, frame.bottom_right.y), kHereLine, size);
  // Above the plot, not over what it is about.
  ImGui::SetNextWindowPos(ImVec2(corner.x + width, corner.y), ImGuiCond_Always, ImVec2(1, 1));
  ImGui::SetTooltip("%s", band_text(facts, bands, band).c_str());
}

}  // namespace viewer
