#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/base/line_reader.h"
#include "io/mesh/mtl_texture.h"

namespace io {

/// Texture coordinates of an .obj: `vt` lines, and which of them corners of faces use. Faces may
/// stand before their coordinates.
class ObjCoordinates {
 public:
  /// Reads `u v w`, of which v and w may be missing. What is no number is no coordinate.
  void add(Words words);

  /// Corner number `corner` of the scene is that of a face's word "7/1/2", whose texture lies so.
  void use(std::size_t corner, std::string_view word, const MtlTexture& place);

  /// One for each of so many corners, not finite where there is none; empty if none is used.
  [[nodiscard]] std::vector<Eigen::Vector2d> resolved(std::size_t n_corners) const;

 private:
  struct Use {
    std::size_t corner;
    std::int64_t index;  // from 0; -1: there is none
    Eigen::Vector2d scale;
    Eigen::Vector2d offset;
  };

  std::vector<Eigen::Vector2d> given_;
  std::vector<Use> uses_;
};

}  // namespace io
