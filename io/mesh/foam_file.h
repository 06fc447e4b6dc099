#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/base/geometry.h"

namespace io {

/// The words, numbers and brackets of a file of OpenFOAM, behind its head.
class FoamTokens {
 public:
  /// Throws SceneError if the file cannot be read, has no head, or is not ascii.
  explicit FoamTokens(const std::filesystem::path& path);

  [[nodiscard]] bool at_end() const { return next_ == tokens_.size(); }
  /// The next one, which stays; empty at the end.
  [[nodiscard]] std::string_view peek() const;
  std::string_view take();  ///< must be there
  void expect(std::string_view token);
  radiosity::Index count();  ///< a number of items, at most as many as there are tokens left
  radiosity::Index whole();  ///< a whole number from 0 to 2³¹ - 1
  double number();
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::filesystem::path path_;
  std::string text_;
  std::vector<std::string_view> tokens_;
  std::vector<long> lines_;  // of the tokens
  std::size_t next_ = 0;
};

/// A patch of a boundary: faces first to first + n - 1.
struct FoamPatch {
  std::string name;
  std::vector<std::string> groups;
  radiosity::Index first = 0;
  radiosity::Index n = 0;
};

/// All patches in their order, of a case's constant/polyMesh/boundary. Throws SceneError.
std::vector<FoamPatch> read_foam_patches(const std::filesystem::path& boundary);

/// Those that radiate, of the group viewFactorWall. Throws SceneError; if there is none, too.
std::vector<FoamPatch> read_radiating_patches(const std::filesystem::path& boundary);

}  // namespace io
