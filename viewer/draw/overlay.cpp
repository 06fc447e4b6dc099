#include "viewer/draw/overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "io/picture/color_bar.h"
#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/measuring.h"
#include "viewer/desk/pinning.h"
#include "viewer/draw/comparison_overlay.h"
#include "viewer/draw/legend_view.h"
#include "viewer/draw/projection.h"
#include "viewer/work/standing.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::Vec3;

constexpr ImU32 kInk = IM_COL32(235, 235, 235, 255);
constexpr ImU32 kPanel = IM_COL32(26, 27, 31, 235);
constexpr ImU32 kNoResult = IM_COL32(255, 190, 60, 255);
constexpr ImU32 kResult = IM_COL32(170, 175, 180, 255);
constexpr ImU32 kOutline = IM_COL32(255, 170, 40, 255);
constexpr ImU32 kOpen = IM_COL32(255, 80, 60, 255);
constexpr ImU32 kHiddenOpen = IM_COL32(255, 80, 60, 150);
constexpr std::size_t kMostOutlines = 1000;
constexpr ImU32 kShooter = IM_COL32(80, 220, 255, 255);
constexpr ImU32 kNumberPaper = IM_COL32(20, 20, 24, 190);
constexpr ImU32 kTape = IM_COL32(255, 225, 90, 255);
constexpr ImU32 kMeter = IM_COL32(130, 230, 255, 255);
constexpr ImU32 kPartner = IM_COL32(255, 255, 255, 230);
constexpr ImU32 kShadow = IM_COL32(0, 0, 0, 200);

void outline(const Desk& desk, ImDrawList& list, Index patch, ImU32 color, float width) {
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  std::array<ImVec2, 4> corners;
  const int n = mesh.n_corners(patch);
  for (int k = 0; k < n; ++k) {
    const auto place = project(desk, mesh.corner(patch, k));
    if (!place) return;
    corners[k] = *place;
  }
  list.AddPolyline(corners.data(), n, kShadow, ImDrawFlags_Closed, width + 2);
  list.AddPolyline(corners.data(), n, color, ImDrawFlags_Closed, width);
}

/// What the camera sees in the direction of a point, m.
std::optional<radiosity::Hit> first_seen_towards(const Desk& desk, const Vec3& point) {
  const Model& model = desk.session.model();
  const Vec3 origin = desk.camera.camera().position;
  return first_seen(*model.visibility, *model.mesh, desk.look.hidden, Backs::hidden, origin,
                    (point - origin).normalized());
}

/// Whether the work plane lies before a point, m.
bool is_behind_plane(const Desk& desk, const Vec3& point) {
  constexpr double kOnPlane = 1e-3;  // of the distance
  const Vec3 origin = desk.camera.camera().position;
  const double distance = (point - origin).norm();
  const auto plane = plane_hit(desk, origin, (point - origin) / distance);
  return plane && plane->distance < (1 - kOnPlane) * distance;
}

/// Whether the camera sees a point of a patch.
bool is_seen_at(const Desk& desk, Index patch, const Vec3& point) {
  if (is_behind_plane(desk, point)) return false;
  const auto hit = first_seen_towards(desk, point);
  return hit && hit->patch == patch;
}

/// Whether the camera sees the middle of a patch, or a place near one of its corners.
bool is_seen(const Desk& desk, Index patch) {
  constexpr double kNearCorner = 0.9;
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  const Vec3 center = mesh.centroid[patch];
  if (is_seen_at(desk, patch, center)) return true;
  for (int k = 0; k < mesh.n_corners(patch); ++k) {
    const Vec3 place = center + kNearCorner * (mesh.corner(patch, k) - center);
    if (is_seen_at(desk, patch, place)) return true;
  }
  return false;
}

void draw_text(ImDrawList& list, ImVec2 place, ImU32 color, const std::string& text) {
  list.AddText(ImVec2(place.x + 1, place.y + 1), kShadow, text.c_str());
  list.AddText(place, color, text.c_str());
}

void draw_partners(const Desk& desk, ImDrawList& list, float scale) {
  if (!desk.facts) return;
  const std::vector<Partner>& partners = desk.facts->partners;
  std::vector<ImVec2> ranks;  // where they stand
  for (std::size_t k = 0; k < partners.size(); ++k) {
    if (!is_seen(desk, partners[k].patch)) continue;
    outline(desk, list, partners[k].patch, kPartner, 1.2F * scale);
    const auto center = project(desk, desk.session.model().mesh->centroid[partners[k].patch]);
    if (!center) continue;
    const std::string rank = std::to_string(k + 1);
    const ImVec2 size = ImGui::CalcTextSize(rank.c_str());
    // Of small patches side by side, numbers would lie over each other.
    const bool is_free = std::none_of(ranks.begin(), ranks.end(), [&](const ImVec2& other) {
      return std::abs(other.x - center->x) < 2 * size.x && std::abs(other.y - center->y) < size.y;
    });
    if (!is_free) continue;
    ranks.push_back(*center);
    draw_text(list, ImVec2(center->x - size.x / 2, center->y - size.y / 2), kPartner, rank);
  }
}

/// Those that see an opening: bold where the camera sees them, thin where something hides them.
void draw_open_patches(const Desk& desk, ImDrawList& list, float scale) {
  const Known known = desk.session.known();
  const std::vector<std::int32_t>* patches = open_patches(known);
  if (patches == nullptr) return;
  const std::size_t n = std::min(kMostOutlines, patches->size());
  for (std::size_t k = 0; k < n; ++k) {
    const Index patch = (*patches)[k];
    const bool is_bold = is_seen(desk, patch);
    outline(desk, list, patch, is_bold ? kOpen : kHiddenOpen, (is_bold ? 2.5F : 1) * scale);
  }
}

/// Whether nothing lies before a point, m, of a surface or of its border, or of the work plane.
bool is_place_seen(const Desk& desk, const Vec3& point) {
  constexpr double kRounding = 1e-3;  // of the distance
  if (is_behind_plane(desk, point)) return false;
  const double distance = (point - desk.camera.camera().position).norm();
  const auto hit = first_seen_towards(desk, point);
  return !hit || hit->distance > (1 - kRounding) * distance;
}

/// Numbers on isolines, as far as they are seen and do not lie over each other.
void draw_iso_numbers(const Desk& desk, ImDrawList& list) {
  std::vector<ImVec2> places;
  for (const IsoNumber& number : desk.iso_numbers) {
    const auto place = project(desk, number.place);
    if (!place) continue;
    const std::string text = io::tick_label(number.value);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const bool is_free = std::none_of(places.begin(), places.end(), [&](const ImVec2& other) {
      return std::abs(other.x - place->x) < 1.5F * size.x &&
             std::abs(other.y - place->y) < 1.2F * size.y;
    });
    const ImVec2 corner(place->x - size.x / 2, place->y - size.y / 2);
    const auto left = static_cast<float>(desk.region.left);
    const bool is_whole =
        corner.x > left && corner.x + size.x < left + static_cast<float>(desk.region.width);
    if (!is_free || !is_whole || !is_place_seen(desk, number.place)) continue;
    places.push_back(*place);
    list.AddRectFilled(ImVec2(corner.x - 2, corner.y),
                       ImVec2(corner.x + size.x + 2, corner.y + size.y), kNumberPaper, 2);
    list.AddText(corner, kInk, text.c_str());
  }
}

/// The outlines of the surface that is marked, as far as they are seen.
void draw_marked(const Desk& desk, ImDrawList& list, float scale) {
  // Each takes a ray.
  constexpr std::size_t kMostLines = 3000;
  const std::size_t stride = desk.marked_lines.size() / kMostLines + 1;
  const Vec3 position = desk.camera.camera().position;
  for (std::size_t k = 0; k < desk.marked_lines.size(); k += stride) {
    const SurfaceLine& line = desk.marked_lines[k];
    if (!is_drawn(line, position, Backs::hidden)) continue;
    const auto from = project(desk, line.ends[0]);
    const auto to = project(desk, line.ends[1]);
    if (!from || !to || !is_place_seen(desk, 0.5 * (line.ends[0] + line.ends[1]))) continue;
    list.AddLine(*from, *to, kShadow, 4 * scale);
    list.AddLine(*from, *to, kOutline, 2 * scale);
  }
}

/// The tape measure with its length.
void draw_tape(const Desk& desk, ImDrawList& list, float scale) {
  if (!desk.tape.from) return;
  const auto draw_end = [&](const std::optional<ImVec2>& end) {
    if (!end) return;
    list.AddCircle(*end, 4 * scale, kShadow, 0, 4 * scale);
    list.AddCircle(*end, 4 * scale, kTape, 0, 2 * scale);
  };
  const auto from = project(desk, *desk.tape.from);
  draw_end(from);
  const auto difference = desk.tape.difference();
  if (!difference) return;
  const auto to = project(desk, *desk.tape.to);
  draw_end(to);
  if (!from || !to) return;
  list.AddLine(*from, *to, kShadow, 4 * scale);
  list.AddLine(*from, *to, kTape, 2 * scale);
  const std::string text = number_text(difference->norm()) + " m";
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 place((from->x + to->x - size.x) / 2, (from->y + to->y) / 2 - 1.4F * size.y);
  list.AddRectFilled(ImVec2(place.x - 3, place.y), ImVec2(place.x + size.x + 3, place.y + size.y),
                     kNumberPaper, 2);
  list.AddText(place, kTape, text.c_str());
}

/// The light meter's points with what they read.
void draw_meters(const Desk& desk, ImDrawList& list, float scale) {
  for (std::size_t k = 0; k < desk.meter.points().size(); ++k) {
    const MeterPoint& point = desk.meter.points()[k];
    const auto place = project(desk, point.position);
    if (!place || !is_place_seen(desk, point.position)) continue;
    list.AddCircle(*place, 5 * scale, kShadow, 0, 4 * scale);
    list.AddCircle(*place, 5 * scale, kMeter, 0, 2 * scale);
    const auto value = meter_value(desk, k);
    const std::string text = fmt::format("{}: {} {}", k + 1, value ? number_text(*value) : "...",
                                         measured_unit(desk.session));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner(place->x + 9 * scale, place->y - size.y / 2);
    list.AddRectFilled(ImVec2(corner.x - 3, corner.y),
                       ImVec2(corner.x + size.x + 3, corner.y + size.y), kNumberPaper, 2);
    list.AddText(corner, kMeter, text.c_str());
  }
}

/// How far what is shown can be trusted.
Standing shown_standing(const Desk& desk) {
  const Show show = desk.look.show;
  if (show == Show::area || show == Show::unseen || show == Show::form_factors) return {};
  if (show != Show::watched && show != Show::unshot) return standing(desk.session);
  return {.text = watched_text(desk.session, desk.look)};
}

/// The same in the picture's corner.
void draw_badge(const Desk& desk, ImDrawList& list, float scale) {
  Standing now = shown_standing(desk);
  if (now.text.empty()) return;
  const Comparison comparison = shown_comparison(desk);
  if (comparison != Comparison::none) now.text = "now: " + now.text;
  // A preview that is being shot always gets better.
  const bool is_shot = now.is_rough && !desk.session.light()->factor_error;
  if (desk.is_painting_due && !is_shot) {
    now.text += " (being painted)";
    now.is_result = false;
  }
  // Pinned light stands to the left of its line.
  const double split = comparison == Comparison::wipe ? drawn_split(desk) : 0;
  const auto left = static_cast<float>(split * desk.region.width);
  const ImVec2 place(static_cast<float>(desk.region.left) + left + 12 * scale,
                     static_cast<float>(desk.region.top) + 10 * scale);
  const float width = static_cast<float>(desk.region.width) - left - 24 * scale;
  if (width < 2 * ImGui::GetFontSize()) return;
  const char* text = now.text.c_str();
  const ImVec2 extent = ImGui::CalcTextSize(text, nullptr, false, width);
  list.AddRectFilled(ImVec2(place.x - 6 * scale, place.y - 4 * scale),
                     ImVec2(place.x + extent.x + 6 * scale, place.y + extent.y + 4 * scale), kPanel,
                     4 * scale);
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), place, now.is_result ? kResult : kNoResult,
               text, nullptr, width);
}

/// What to say if what is to be shown is not there.
std::string missing_text(const Desk& desk) {
  const Session& session = desk.session;
  if (!session.is_open()) {
    if (session.status().is_busy) return "Opening ...";
    // Examples say so themselves.
    return desk.examples.list().empty() ? "Drop a scene or result file here, or press Ctrl+O" : "";
  }
  const Show show = desk.look.show;
  const bool is_painted = show == Show::true_color || show == Show::watched;
  if ((show == Show::watched || show == Show::unshot) && session.iteration() == nullptr) {
    return "Record an iteration in the panel 'Watch'";
  }
  if (desk.legend || (is_painted && session.light() != nullptr)) return "";
  if (show == Show::work_plane) return "Work plane: " + readings_note(desk);
  if (is_wide(show)) {
    if (!session.model().factors) {
      return session.is_settled() ? "Form factors are not known" : "Waits for the form factors ...";
    }
    if (!session.selected()) return "Click a patch";
    if (show != Show::light_path && session.row() == nullptr) {
      return "Evaluating the form factors of this patch ...";
    }
    if (show == Show::light_path) return "Working out where the light comes from ...";
  }
  if (show == Show::unseen) {
    return session.is_settled() ? "Form factors are not known" : "Waits for the form factors ...";
  }
  return session.is_settled() ? "No light is known" : "Waits for the light ...";
}

}  // namespace

void draw_overlay(const Desk& desk, double scale) {
  if (desk.region.width <= 0 || desk.region.height <= 0) return;
  const auto size = static_cast<float>(scale);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 top_left(static_cast<float>(desk.region.left), static_cast<float>(desk.region.top));
  const ImVec2 bottom_right(top_left.x + static_cast<float>(desk.region.width),
                            top_left.y + static_cast<float>(desk.region.height));
  list.PushClipRect(top_left, bottom_right);
  if (desk.look.show == Show::unseen) draw_open_patches(desk, list, size);
  draw_marked(desk, list, size);
  draw_iso_numbers(desk, list);
  draw_meters(desk, list, size);
  draw_tape(desk, list, size);
  if (const auto shooter = shown_shooter(desk.session, desk.look)) {
    if (is_seen(desk, *shooter)) outline(desk, list, *shooter, kShooter, 3 * size);
  }
  if (desk.session.selected()) {
    if (desk.look.show == Show::form_factors && desk.session.model().factors) {
      draw_partners(desk, list, size);
    }
    const Index patch = *desk.session.selected();
    if (is_seen(desk, patch)) outline(desk, list, patch, kOutline, 2.5F * size);
  }
  draw_badge(desk, list, size);
  if (const std::string text = missing_text(desk); !text.empty()) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    const ImVec2 place(
        (top_left.x + bottom_right.x - extent.x) / 2,
        desk.session.is_open() ? top_left.y + 4 * extent.y : (top_left.y + bottom_right.y) / 2);
    list.AddRectFilled(ImVec2(place.x - 8 * size, place.y - 4 * size),
                       ImVec2(place.x + extent.x + 8 * size, place.y + extent.y + 4 * size), kPanel,
                       4 * size);
    list.AddText(place, kInk, text.c_str());
  }
  if (desk.legend) draw_legend(desk, list, scale);
  list.PopClipRect();
}

}  // namespace viewer
