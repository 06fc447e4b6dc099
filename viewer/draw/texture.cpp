#include "viewer/draw/texture.h"

#include <vtk_glew.h>

#include <cstdint>

namespace viewer {

Texture::~Texture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

ImTextureID Texture::of(const std::shared_ptr<const io::RgbPicture>& picture) {
  if (picture != picture_) {
    picture_ = picture;
    if (name_ == 0) glGenTextures(1, &name_);
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    glBindTexture(GL_TEXTURE_2D, name_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const GLint filter = scaling_ == Scaling::smooth ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, picture->width, picture->height, 0, GL_RGB,
                 GL_UNSIGNED_BYTE, picture->bytes.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  }
  // ImGui hands the number of a texture on as a pointer.
  // NOLINTNEXTLINE(performance-no-int-to-ptr): see above
  return reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(name_));
}

}  // namespace viewer
