#include "viewer/draw/planned_picture.h"

#include "viewer/desk/picture_words.h"

namespace viewer {
namespace {

constexpr ImU32 kPlate = IM_COL32(26, 27, 31, 235);
constexpr float kRounding = 4;

}  // namespace

PicturePlan planned_picture(const Desk& desk, double scale) {
  const TextMeasure measure = [](const std::string& text, float width) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
    return TextExtent{extent.x, extent.y};
  };
  return make_picture_plan(
      desk.region, picture_words(desk),
      {.scale = static_cast<float>(scale), .line = ImGui::GetTextLineHeight(), .measure = measure});
}

void draw_plate(ImDrawList& list, const Box& box, ImU32 ink, const std::string& text, float scale) {
  list.AddRectFilled(ImVec2(box.left, box.top), ImVec2(box.right(), box.bottom()), kPlate,
                     kRounding * scale);
  const float across = kPlateAcross * scale;
  // A pixel more, so that rounding breaks no line that had just room.
  const float width = box.width - 2 * across + 1;
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(),
               ImVec2(box.left + across, box.top + kPlateAlong * scale), ink, text.c_str(), nullptr,
               width);
}

}  // namespace viewer
