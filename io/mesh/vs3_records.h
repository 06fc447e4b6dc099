#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"

namespace io {

/// What the control lines of a .vs3 file say of the result.
struct View3dControl {
  bool is_enclosure = false;  ///< encl=1
  bool is_script_f = false;   ///< emit=1: rows are ε_i B_ij with Gebhart's factors B
  bool is_binary = false;     ///< out=1
};

/// A surface as a .vs3 file gives it.
struct Vs3Surface {
  /// A mask faces what it covers of its base and nothing else; a null surface takes it away.
  enum class Kind { radiating, mask, null, obstruction };
  Kind kind = Kind::radiating;
  std::vector<radiosity::Vec3> corners;  ///< three or four, in the file's unit
  int base = -1;                         ///< index of the surface that it is a part of, or -1
  int combined_with = -1;                ///< index of the surface whose row it shares, or -1
  double emissivity = 1;
  std::string name;  ///< "" if there is none
  long line = 0;     ///< for messages
};

/// Whether it lies on its base, face to face.
inline bool covers_base(const Vs3Surface& surface) {
  return surface.kind == Vs3Surface::Kind::mask || surface.kind == Vs3Surface::Kind::null;
}

/// A scene of View3D. Indices of surfaces are in range, those of combined ones lead to an earlier
/// radiating one that is combined with none.
struct Vs3File {
  std::string title;
  View3dControl control;
  std::vector<Vs3Surface> surfaces;
  std::vector<std::string> warnings;
};

/// Reads a .vs3 file of geometry F 3 or F 3a. Throws SceneError with file and line.
Vs3File read_vs3_records(const std::filesystem::path& path, const radiosity::Progress& progress);

}  // namespace io
