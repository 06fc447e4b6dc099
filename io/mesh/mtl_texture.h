#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "radiosity/scene/texture.h"

namespace io {

/// What `map_Kd` says.
struct MtlTexture {
  std::string file;                                  ///< as it stands there; "" = none
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();   ///< `-s`, of the file's coordinates
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();  ///< `-o`, added to them then
  radiosity::TextureWrap wrap = radiosity::TextureWrap::repeat;
  bool has_other_options = false;  ///< that change the picture and are not followed

  /// u and v of the file, v upwards, as those of a Texture.
  [[nodiscard]] Eigen::Vector2d place(const Eigen::Vector2d& given) const {
    const Eigen::Vector2d placed = scale.cwiseProduct(given) + offset;
    return {placed.x(), 1 - placed.y()};
  }
};

/// Reads what follows `map_Kd`: options, then the file, whose name may have blanks in it.
MtlTexture read_mtl_texture(std::string_view words);

/// The file that a .mtl or .obj names, beside it; empty if it is not there. Programs for Windows
/// write paths with backslashes.
std::optional<std::filesystem::path> find_beside(const std::filesystem::path& file,
                                                 std::string name);

}  // namespace io
