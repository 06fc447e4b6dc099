#include "viewer/desk/picture_plan.h"

#include <algorithm>
#include <utility>

namespace viewer {
namespace {

// Pixels at scale 1.
constexpr float kEdge = 6;  // from the picture's edge, and between two plates
constexpr float kLegendWidth = 160;
constexpr float kLegendMargin = 10;
constexpr float kBarWidth = 18;
constexpr float kBarHeight = 380;
constexpr float kAxesSide = 80;
constexpr float kAxesMargin = 12;
// Lines of text.
constexpr float kLeastWrap = 2;
constexpr float kComfort = 8;  // that a badge is wide at least, if that can be had
constexpr float kMessageTop = 4;
constexpr float kAroundBar = 1.5F;

Box whole(const Region& region) {
  return {static_cast<float>(region.left), static_cast<float>(region.top),
          static_cast<float>(region.width), static_cast<float>(region.height)};
}

bool contains(const Box& outer, const Box& inner) {
  constexpr float kRounding = 0.01F;
  return inner.left >= outer.left - kRounding && inner.top >= outer.top - kRounding &&
         inner.right() <= outer.right() + kRounding && inner.bottom() <= outer.bottom() + kRounding;
}

/// Lays out what is over one picture.
class Planner {
 public:
  Planner(const Region& region, const PictureWords& words, const TextSizes& sizes)
      : picture_(whole(region)), words_(words), sizes_(sizes) {}

  PicturePlan plan() {
    PicturePlan plan;
    const float line_x = picture_.left + static_cast<float>(words_.split) * picture_.width;
    const float width =
        words_.legend != nullptr ? std::min(kLegendWidth * sizes_.scale, picture_.width) : 0;
    const float legend_left = picture_.right() - width;
    const bool is_tight = legend_left - line_x < kComfort * sizes_.line;
    const float right = is_tight ? picture_.right() : legend_left;
    plan.badge = plate(words_.badge, line_x, right);
    plan.pinned = plate(words_.pinned, picture_.left, std::min(line_x, right));
    float top = picture_.top;
    for (const std::optional<Box>& box : {plan.badge, plan.pinned}) {
      if (!box) continue;
      const float below = box->bottom() + kEdge * sizes_.scale;
      message_top_ = std::max(message_top_, below);
      if (is_tight) top = std::max(top, below);
    }
    if (words_.legend != nullptr) plan.legend = legend({legend_left, top, width});
    plan.message = message(plan.legend ? legend_left : picture_.right());
    plan.axes = axes(plan);
    return plan;
  }

 private:
  /// A text on its plate in the upper left of what is between two sides.
  [[nodiscard]] std::optional<Box> plate(const std::string& text, float left, float right) const {
    const float across = kPlateAcross * sizes_.scale;
    const float edge = kEdge * sizes_.scale;
    const float room = right - left - 2 * edge - 2 * across;
    if (text.empty() || room < kLeastWrap * sizes_.line) return std::nullopt;
    const TextExtent extent = sizes_.measure(text, room);
    const Box box{left + edge, picture_.top + edge, extent.width + 2 * across,
                  extent.height + 2 * kPlateAlong * sizes_.scale};
    return contains(picture_, box) ? std::optional(box) : std::nullopt;
  }

  /// With as much as there is room for, below `space.top`.
  [[nodiscard]] std::optional<LegendPlan> legend(Box space) const {
    const Legend& legend = *words_.legend;
    const float line = sizes_.line;
    const float margin = kLegendMargin * sizes_.scale;
    LegendPlan plan{.box = space, .bar = {}, .text_width = space.width - 2 * margin};
    if (plan.text_width < kLeastWrap * line) return std::nullopt;
    const float details =
        sizes_.measure("bar: " + legend.fit, plan.text_width).height + 2.5F * line;
    // With less and less around the bar, until that is high enough.
    const std::pair<bool, float> choices[] = {
        {true, 5 * line}, {false, 4 * line}, {false, 2 * line}};
    for (const auto& [has_details, least] : choices) {
      const bool is_last = !has_details && least <= 2 * line;
      plan.has_details = has_details;
      plan.n_titles = is_last ? std::min<std::size_t>(1, legend.title.size()) : legend.title.size();
      float titles = 0;
      for (std::size_t k = 0; k < plan.n_titles; ++k) {
        titles += sizes_.measure(legend.title[k], plan.text_width).height;
      }
      const float above = margin + titles + kAroundBar * line;
      const float below = kAroundBar * line + margin + (has_details ? details : 0);
      const float height =
          std::min(picture_.bottom() - space.top - above - below, kBarHeight * sizes_.scale);
      if (height < least) continue;
      plan.bar = {space.left + margin, space.top + above, kBarWidth * sizes_.scale, height};
      plan.box.height = above + height + below;
      return plan;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Box> message(float right) const {
    const float across = kPlateAcross * sizes_.scale;
    const float edge = kEdge * sizes_.scale;
    const float room = right - picture_.left - 2 * edge - 2 * across;
    if (words_.message.empty() || room < kLeastWrap * sizes_.line) return std::nullopt;
    const TextExtent extent = sizes_.measure(words_.message, room);
    Box box{0, std::max(message_top_, picture_.top + kMessageTop * sizes_.line),
            extent.width + 2 * across, extent.height + 2 * kPlateAlong * sizes_.scale};
    if (box.bottom() > picture_.bottom()) box.top = std::max(message_top_, picture_.top + edge);
    if (words_.is_message_central) box.top = picture_.top + (picture_.height - box.height) / 2;
    box.left = (picture_.left + right - box.width) / 2;
    return contains(picture_, box) ? std::optional(box) : std::nullopt;
  }

  [[nodiscard]] std::optional<Box> axes(const PicturePlan& plan) const {
    const float side = kAxesSide * sizes_.scale;
    const float margin = kAxesMargin * sizes_.scale;
    const Box box{picture_.left + margin, picture_.bottom() - margin - side, side, side};
    const auto is_hit = [&](const std::optional<Box>& other) {
      return other && box.overlaps(*other);
    };
    const bool is_free = !is_hit(plan.badge) && !is_hit(plan.pinned) && !is_hit(plan.message) &&
                         !(plan.legend && box.overlaps(plan.legend->box));
    return is_free && contains(picture_, box) ? std::optional(box) : std::nullopt;
  }

  Box picture_;
  const PictureWords& words_;
  const TextSizes& sizes_;
  float message_top_ = picture_.top;
};

}  // namespace

bool Box::overlaps(const Box& other) const {
  return left < other.right() && other.left < right() && top < other.bottom() &&
         other.top < bottom();
}

bool is_clear(const PicturePlan& plan, const Region& region, const Box& box) {
  if (!contains(whole(region), box)) return false;
  for (const auto& taken : {plan.badge, plan.pinned, plan.message, plan.axes}) {
    if (taken && taken->overlaps(box)) return false;
  }
  return !plan.legend || !plan.legend->box.overlaps(box);
}

PicturePlan make_picture_plan(const Region& region, const PictureWords& words,
                              const TextSizes& sizes) {
  return Planner(region, words, sizes).plan();
}

}  // namespace viewer
