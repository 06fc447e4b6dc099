#include "viewer/draw/backdrop.h"

#include <imgui.h>

namespace viewer {

void Backdrop::draw(const std::shared_ptr<const io::RgbPicture>& picture, const Region& region) {
  if (!picture) {
    texture_.forget();
    return;
  }
  const ImVec2 top_left(static_cast<float>(region.left), static_cast<float>(region.top));
  const ImVec2 bottom_right(top_left.x + static_cast<float>(picture->width),
                            top_left.y + static_cast<float>(picture->height));
  ImGui::GetBackgroundDrawList()->AddImage(texture_.of(picture), top_left, bottom_right);
}

}  // namespace viewer
