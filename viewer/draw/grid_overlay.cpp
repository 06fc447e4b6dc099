#include "viewer/draw/grid_overlay.h"

#include <imgui.h>

#include <string>

#include "viewer/desk/grids.h"
#include "viewer/desk/luminaires.h"
#include "viewer/draw/projection.h"

namespace viewer {
namespace {

constexpr ImU32 kPointInk = IM_COL32(130, 230, 255, 255);
constexpr ImU32 kObserverInk = IM_COL32(255, 150, 230, 255);
constexpr ImU32 kPointPaper = IM_COL32(20, 20, 24, 190);

void draw_point(ImDrawList& list, ImVec2 place, ImU32 ink, const std::string& text, float scale) {
  list.AddCircle(place, 4 * scale, kPointPaper, 0, 4 * scale);
  list.AddCircle(place, 4 * scale, ink, 0, 2 * scale);
  if (text.empty()) return;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 corner(place.x + 8 * scale, place.y - size.y / 2);
  list.AddRectFilled(ImVec2(corner.x - 3, corner.y),
                     ImVec2(corner.x + size.x + 3, corner.y + size.y), kPointPaper, 2);
  list.AddText(corner, ink, text.c_str());
}

void draw_list(const Desk& desk, ImDrawList& list, float scale) {
  const auto shown = shown_grid(desk);
  if (!shown || shown->measured.grid.size() > 0) return;
  for (std::size_t k = 0; k < shown->points.size(); ++k) {
    const auto place = project(desk, shown->points[k]);
    if (!place || !is_seen_from_camera(desk, shown->points[k])) continue;
    const bool is_open = shown->measured.places[k] == radiosity::PointPlace::open;
    const auto value = shown->values[static_cast<radiosity::Index>(k)];
    const std::string text = is_open ? number_text(value) + " " + shown->unit : "not measured";
    draw_point(list, *place, kPointInk, text, scale);
  }
}

void draw_observers(const Desk& desk, ImDrawList& list, float scale) {
  const std::vector<GridLine> lines = observer_lines(desk);
  const auto& observers = desk.session.model().scene->light_plan.observers;
  const double length = luminaire_size(desk.session);
  for (std::size_t k = 0; k < observers.size(); ++k) {
    const radiosity::Observer& observer = observers[k];
    if (!is_seen_from_camera(desk, observer.position)) continue;
    const auto look =
        project_piece(desk, observer.position, observer.position + length * observer.direction);
    if (look) {
      list.AddLine(look->first, look->second, kPointPaper, 4 * scale);
      list.AddLine(look->first, look->second, kObserverInk, 2 * scale);
    }
    const auto place = project(desk, observer.position);
    if (!place) continue;
    const std::string ugr = k < lines.size() ? ", UGR " + lines[k].value : "";
    draw_point(list, *place, kObserverInk, observer.name + ugr, scale);
  }
}

}  // namespace

void draw_grid_points(const Desk& desk, double scale) {
  if (desk.look.show != Show::grid || !has_light_plan(desk.session)) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 low(static_cast<float>(desk.region.left), static_cast<float>(desk.region.top));
  list.PushClipRect(low, ImVec2(low.x + static_cast<float>(desk.region.width),
                                low.y + static_cast<float>(desk.region.height)));
  draw_list(desk, list, static_cast<float>(scale));
  draw_observers(desk, list, static_cast<float>(scale));
  list.PopClipRect();
}

}  // namespace viewer
