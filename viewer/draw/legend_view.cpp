#include "viewer/draw/legend_view.h"

#include <algorithm>
#include <string>
#include <vector>

#include "io/picture/color_bar.h"
#include "viewer/desk/patch_facts.h"

namespace viewer {
namespace {

constexpr ImU32 kLegendInk = IM_COL32(235, 235, 235, 255);
constexpr ImU32 kLegendPaper = IM_COL32(26, 27, 31, 235);
ImU32 ink_of(double position, io::ColorMap map) {
  const io::Rgb rgb = io::map_color(position, map);
  return IM_COL32(rgb[0], rgb[1], rgb[2], 255);
}

void draw_bar(ImDrawList& list, const Legend& legend, const Box& bar) {
  constexpr int kSteps = 64;
  const float right = bar.left + bar.width;
  for (int k = 0; k < kSteps; ++k) {
    const auto color = [&](int step) {
      return ink_of(1 - static_cast<double>(step) / kSteps, legend.map);
    };
    const float y0 = bar.top + bar.height * static_cast<float>(k) / kSteps;
    const float y1 = bar.top + bar.height * static_cast<float>(k + 1) / kSteps;
    list.AddRectFilledMultiColor(ImVec2(bar.left, y0), ImVec2(right, y1), color(k), color(k),
                                 color(k + 1), color(k + 1));
  }
  const float tip = 0.6F * bar.width;
  const float middle = bar.left + bar.width / 2;
  const float bottom = bar.top + bar.height;
  if (legend.has_above) {
    list.AddTriangleFilled(ImVec2(bar.left, bar.top - 1), ImVec2(middle, bar.top - 1 - tip),
                           ImVec2(right, bar.top - 1), ink_of(1, legend.map));
  }
  if (legend.has_below) {
    list.AddTriangleFilled(ImVec2(bar.left, bottom + 1), ImVec2(right, bottom + 1),
                           ImVec2(middle, bottom + 1 + tip), ink_of(0, legend.map));
  }
}

/// Labels as many of the ticks as there is room for.
void draw_ticks(ImDrawList& list, const Legend& legend, const Box& bar, float scale) {
  const float line = ImGui::GetTextLineHeight();
  const float right = bar.left + bar.width;
  float last = bar.top + bar.height + 2 * line;
  for (const double tick : legend.ticks) {
    const auto position = static_cast<float>(io::position_on(legend.scale, tick));
    const float y = bar.top + (1 - position) * bar.height;
    list.AddLine(ImVec2(right, y), ImVec2(right + 4 * scale, y), kLegendInk, scale);
    if (last - y < 1.1F * line) continue;
    last = y;
    list.AddText(ImVec2(right + 8 * scale, y - line / 2), kLegendInk, io::tick_label(tick).c_str());
  }
}

/// Returns where the next line goes.
float draw_line(ImDrawList& list, ImVec2 place, float width, const std::string& text) {
  const char* end = text.c_str() + text.size();
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), place, kLegendInk, text.c_str(), end, width);
  return place.y + ImGui::CalcTextSize(text.c_str(), end, false, width).y;
}

}  // namespace

void draw_legend(const Legend& legend, const LegendPlan& plan, ImDrawList& list, float scale) {
  const float line = ImGui::GetTextLineHeight();
  list.AddRectFilled(ImVec2(plan.box.left, plan.box.top),
                     ImVec2(plan.box.right(), plan.box.bottom()), kLegendPaper);
  // Its words have the bar's margin above them, too.
  ImVec2 place(plan.bar.left, plan.box.top + plan.bar.left - plan.box.left);
  for (std::size_t k = 0; k < plan.n_titles; ++k) {
    place.y = draw_line(list, place, plan.text_width, legend.title[k]);
  }
  draw_bar(list, legend, plan.bar);
  draw_ticks(list, legend, plan.bar, scale);
  if (!plan.has_details) return;
  place.y = plan.bar.bottom() + 1.5F * line;
  place.y = draw_line(list, place, plan.text_width, "bar: " + legend.fit);
  place.y += 0.5F * line;
  place.y = draw_line(list, place, plan.text_width, "least " + number_text(legend.least));
  draw_line(list, place, plan.text_width, "greatest " + number_text(legend.greatest));
}

}  // namespace viewer
