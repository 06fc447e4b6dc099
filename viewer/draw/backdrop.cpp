#include "viewer/draw/backdrop.h"

#include <imgui.h>
#include <vtk_glew.h>

#include <cstdint>

namespace viewer {

Backdrop::~Backdrop() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

void Backdrop::draw(const std::shared_ptr<const io::RgbPicture>& picture, const Region& region) {
  if (!picture) {
    picture_.reset();
    return;
  }
  if (picture != picture_) {
    picture_ = picture;
    if (texture_ == 0) glGenTextures(1, &texture_);
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, picture->width, picture->height, 0, GL_RGB,
                 GL_UNSIGNED_BYTE, picture->bytes.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  }
  const ImVec2 top_left(static_cast<float>(region.left), static_cast<float>(region.top));
  const ImVec2 bottom_right(top_left.x + static_cast<float>(picture->width),
                            top_left.y + static_cast<float>(picture->height));
  // ImGui hands the number of a texture on as a pointer.
  // NOLINTNEXTLINE(performance-no-int-to-ptr): see above
  ImGui::GetBackgroundDrawList()->AddImage(
      reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture_)), top_left, bottom_right);
}

}  // namespace viewer
