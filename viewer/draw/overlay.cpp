#include "viewer/draw/overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "io/picture/color_bar.h"
#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/labels.h"
#include "viewer/desk/measuring.h"
#include "viewer/desk/picture_words.h"
#include "viewer/draw/legend_view.h"
#include "viewer/draw/planned_picture.h"
#include "viewer/draw/projection.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::Vec3;

constexpr ImU32 kInk = IM_COL32(235, 235, 235, 255);
constexpr ImU32 kNoResult = IM_COL32(255, 190, 60, 255);
constexpr ImU32 kResult = IM_COL32(170, 175, 180, 255);
constexpr ImU32 kOutline = IM_COL32(255, 170, 40, 255);
constexpr ImU32 kOpen = IM_COL32(255, 80, 60, 255);
constexpr ImU32 kHiddenOpen = IM_COL32(255, 80, 60, 150);
constexpr std::size_t kMostOutlines = 1000;
constexpr float kRingRadius = 9;  // pixels at scale 1
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
  // Line by line, as a polyline has spikes at narrow corners.
  for (const auto& [ink, thickness] : {std::pair(kShadow, width + 2), std::pair(color, width)}) {
    for (int k = 0; k < n; ++k) list.AddLine(corners[k], corners[(k + 1) % n], ink, thickness);
  }
}

/// How far a patch extends in the window from its first corner, pixels; 0 if it is not before the
/// camera.
float extent_of(const Desk& desk, Index patch) {
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  const auto first = project(desk, mesh.corner(patch, 0));
  float extent = 0;
  for (int k = 1; first && k < mesh.n_corners(patch); ++k) {
    const auto corner = project(desk, mesh.corner(patch, k));
    if (corner) extent = std::max(extent, std::hypot(corner->x - first->x, corner->y - first->y));
  }
  return extent;
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
/// What is too small for an outline has a ring around it.
void draw_open_patches(const Desk& desk, ImDrawList& list, float scale) {
  const Known known = desk.session.known();
  const std::vector<std::int32_t>* patches = open_patches(known);
  if (patches == nullptr) return;
  const float radius = kRingRadius * scale;
  std::set<std::pair<long, long>> ringed;  // squares of the window, so that no rings pile up
  // Of very many some everywhere.
  const std::size_t stride = (patches->size() + kMostOutlines - 1) / kMostOutlines;
  for (std::size_t k = 0; k < patches->size(); k += stride) {
    const Index patch = (*patches)[k];
    const bool is_bold = is_seen(desk, patch);
    const ImU32 ink = is_bold ? kOpen : kHiddenOpen;
    const auto center = project(desk, desk.session.model().mesh->centroid[patch]);
    if (center && extent_of(desk, patch) < radius) {
      const bool is_free =
          ringed
              .emplace(std::lround(center->x / (2 * radius)), std::lround(center->y / (2 * radius)))
              .second;
      if (!is_free) continue;
      list.AddCircle(*center, radius, kShadow, 0, 4 * scale);
      list.AddCircle(*center, radius, ink, 0, 2 * scale);
    } else {
      outline(desk, list, patch, ink, (is_bold ? 2.5F : 1) * scale);
    }
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

void draw_label(ImDrawList& list, const Box& paper, float margin, ImU32 ink,
                const std::string& text) {
  list.AddRectFilled(ImVec2(paper.left, paper.top), ImVec2(paper.right(), paper.bottom()),
                     kNumberPaper, 2);
  list.AddText(ImVec2(paper.left + margin, paper.top), ink, text.c_str());
}

/// Numbers on isolines, as far as they are seen whole and do not lie over each other.
void draw_iso_numbers(const Desk& desk, Labels& labels, ImDrawList& list) {
  constexpr float kMargin = 2;
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
    if (!is_free || !is_place_seen(desk, number.place)) continue;
    const auto paper = labels.take(
        {{place->x - size.x / 2 - kMargin, place->y - size.y / 2, size.x + 2 * kMargin, size.y}});
    if (!paper) continue;
    places.push_back(*place);
    draw_label(list, *paper, kMargin, kInk, text);
  }
}

/// The outlines of the surface that is marked, as far as they are seen.
void draw_marked(const Desk& desk, ImDrawList& list, float scale) {
  // Each takes a ray.
  constexpr std::size_t kMostLines = 3000;
  const std::size_t stride = desk.marks.lines().size() / kMostLines + 1;
  const Vec3 position = desk.camera.camera().position;
  for (std::size_t k = 0; k < desk.marks.lines().size(); k += stride) {
    const SurfaceLine& line = desk.marks.lines()[k];
    if (!is_drawn(line, position, Backs::hidden)) continue;
    const auto from = project(desk, line.ends[0]);
    const auto to = project(desk, line.ends[1]);
    if (!from || !to || !is_place_seen(desk, 0.5 * (line.ends[0] + line.ends[1]))) continue;
    list.AddLine(*from, *to, kShadow, 4 * scale);
    list.AddLine(*from, *to, kOutline, 2 * scale);
  }
}

/// The tape measure with its length.
void draw_tape(const Desk& desk, Labels& labels, ImDrawList& list, float scale) {
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
  constexpr float kMargin = 3;
  const float left = (from->x + to->x - size.x) / 2 - kMargin;
  const float middle = (from->y + to->y) / 2;
  const float width = size.x + 2 * kMargin;
  const Box paper = labels.take_any({{left, middle - 1.4F * size.y, width, size.y},
                                     {left, middle + 0.4F * size.y, width, size.y}});
  draw_label(list, paper, kMargin, kTape, text);
}

/// The light meter's points with what they read.
void draw_meters(const Desk& desk, Labels& labels, ImDrawList& list, float scale) {
  constexpr float kMargin = 3;
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
    // To its right, or where something stands there to its left, above or below.
    const float width = size.x + 2 * kMargin;
    const float right = place->x + 9 * scale - kMargin;
    const float left = place->x - 9 * scale + kMargin - width;
    const float middle = place->y - size.y / 2;
    const Box paper = labels.take_any({{right, middle, width, size.y},
                                       {left, middle, width, size.y},
                                       {right, middle - size.y, width, size.y},
                                       {right, middle + size.y, width, size.y},
                                       {left, middle - size.y, width, size.y},
                                       {left, middle + size.y, width, size.y}});
    draw_label(list, paper, kMargin, kMeter, text);
  }
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
  const PicturePlan plan = planned_picture(desk, scale);
  if (desk.look.show == Show::unseen) draw_open_patches(desk, list, size);
  draw_marked(desk, list, size);
  Labels labels(plan, desk.region);
  draw_meters(desk, labels, list, size);
  draw_tape(desk, labels, list, size);
  draw_iso_numbers(desk, labels, list);
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
  const PictureWords words = picture_words(desk);
  if (plan.badge) {
    draw_plate(list, *plan.badge, words.is_result ? kResult : kNoResult, words.badge, size);
  }
  if (plan.message) draw_plate(list, *plan.message, kInk, words.message, size);
  if (plan.legend) draw_legend(*desk.legend, *plan.legend, list, size);
  list.PopClipRect();
}

}  // namespace viewer
