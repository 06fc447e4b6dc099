#include "io/mesh/vs3_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/base/flat_difference.h"
#include "io/base/line_reader.h"
#include "io/mesh/surface_index.h"
#include "io/mesh/vs3_records.h"
#include "radiosity/base/geometry.h"

namespace io {
namespace {

using radiosity::ConvexPolygon;
using radiosity::Scene;
using radiosity::Vec3;

/// How far a part may be off the plane and the outline of its base, of its own size.
constexpr double kOffBase = 1e-5;
/// How far a mask stands in front of its base, of its own size, so that it has something to face;
/// farther where its corners are rounded, as what lies closer than they are known touches.
constexpr double kMaskDistance = 1e-7;
constexpr double kRoundedMaskDistance = 1e-5;

/// Whether written digits hold the number without rounding: it has few binary ones.
bool is_exact(double x) { return x * 1024 == std::floor(x * 1024); }

class Vs3Scene {
 public:
  Vs3Scene(const std::filesystem::path& path, const Vs3File& file)
      : path_(path), file_(file), parts_(file.surfaces.size()), index_(scene_, "surface") {}

  FileScene run() {
    scene_.bands = {.kind = radiosity::Bands::Kind::grey, .wavelengths = {}};
    scene_.name = file_.title;
    if (file_.control.is_enclosure) scene_.closed = true;
    for (const std::string& warning : file_.warnings) {
      scene_.warnings.push_back(path_.string() + ": " + warning);
    }
    find_parts();
    for (std::size_t i = 0; i < file_.surfaces.size(); ++i) add(i);
    emissivities_.report("the first one counts for all that are combined", repairs_);
    return {std::move(scene_), std::move(repairs_)};
  }

 private:
  [[noreturn]] void fail_at(std::size_t i, const std::string& message) const {
    fail(fmt::format("{}:{}", path_.string(), file_.surfaces[i].line),
         fmt::format("surface {} {}", i + 1, message));
  }

  void find_parts() {
    const std::size_t n = file_.surfaces.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vs3Surface& surface = file_.surfaces[i];
      if (surface.base < 0) {
        if (covers_base(surface)) fail_at(i, "covers a part of its base, but has none");
        continue;
      }
      const auto base = static_cast<std::size_t>(surface.base);
      if (base >= n) fail_at(i, fmt::format("has the base {}, but there are {}", base + 1, n));
      const bool is_obstruction = file_.surfaces[base].kind == Vs3Surface::Kind::obstruction;
      if (base >= i && !is_obstruction) {
        fail_at(i, fmt::format("has the base {}, expected an earlier surface", base + 1));
      }
      if (covers_base(file_.surfaces[base])) {
        fail_at(i, fmt::format("has the base {}, which is a null or masking surface", base + 1));
      }
      check_part(i, base);
      parts_[base].push_back(i);
    }
  }

  void check_part(std::size_t i, std::size_t base) const {
    const auto& corners = file_.surfaces[i].corners;
    const auto& outline = file_.surfaces[base].corners;
    const Vec3 normal = normal_of(base);
    const double within = kOffBase * radiosity::bounding_disc(corners).radius;
    for (const Vec3& corner : corners) {
      if (!(std::abs(normal.dot(corner - outline[0])) <= within)) {
        fail_at(i, fmt::format("does not lie in the plane of its base {}", base + 1));
      }
    }
    const bool covers = covers_base(file_.surfaces[i]);
    if ((normal_of(i).dot(normal) > 0) == covers) {
      fail_at(i, covers ? fmt::format("must face its base {}, the other way", base + 1)
                        : fmt::format("must face the same way as its base {}", base + 1));
    }
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec3 edge = outline[(k + 1) % outline.size()] - outline[k];
      const Vec3 inwards = normal.cross(edge).normalized();
      for (const Vec3& corner : corners) {
        if (!(inwards.dot(corner - outline[k]) >= -within)) {
          fail_at(i, fmt::format("reaches beyond its base {}", base + 1));
        }
      }
    }
  }

  /// Of a surface that is to be convex, too.
  [[nodiscard]] Vec3 normal_of(std::size_t i) const {
    const auto& corners = file_.surfaces[i].corners;
    const Vec3 normal = radiosity::vector_area(corners).normalized();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 edge = corners[(k + 1) % corners.size()] - corners[k];
      const Vec3 next = corners[(k + 2) % corners.size()] - corners[(k + 1) % corners.size()];
      if (!(normal.dot(edge.cross(next)) > 0)) fail_at(i, "is not convex, or has no area");
    }
    return normal;
  }

  void add(std::size_t i) {
    const Vs3Surface& surface = file_.surfaces[i];
    if (surface.kind == Vs3Surface::Kind::null) {
      surface_of_.push_back(-1);
      return;
    }
    if (surface.combined_with < 0) {
      surface_of_.push_back(add_surface(i));
    } else {
      const auto first = static_cast<std::size_t>(surface.combined_with);
      surface_of_.push_back(surface_of_[first]);
      if (surface.emissivity != file_.surfaces[first].emissivity) {
        emissivities_.add(fmt::format("{}:{}", path_.string(), surface.line),
                          fmt::format("surface {} is combined with surface {} of another "
                                      "emissivity",
                                      i + 1, first + 1));
      }
    }
    add_polygons(i);
  }

  std::int32_t add_surface(std::size_t i) {
    const Vs3Surface& surface = file_.surfaces[i];
    const bool is_obstruction = surface.kind == Vs3Surface::Kind::obstruction;
    const std::string name =
        fmt::format("{} {}", is_obstruction ? "obstruction" : "surface", i + 1);
    const int material =
        is_obstruction
            ? find_material("obstruction", 1)
            : find_material(fmt::format("emissivity {}", surface.emissivity), surface.emissivity);
    const std::string unique = index_.unused_name(surface.name.empty() ? name : surface.name);
    return index_.find_or_add(unique, material);
  }

  int find_material(const std::string& name, double emissivity) {
    for (std::size_t k = 0; k < scene_.materials.size(); ++k) {
      if (scene_.materials[k].name == name) return static_cast<int>(k);
    }
    scene_.materials.push_back({.name = name,
                                .reflectance = Eigen::VectorXd::Constant(1, 1 - emissivity),
                                .emission = {}});
    return static_cast<int>(scene_.materials.size()) - 1;
  }

  /// Of a part, as its base faces.
  [[nodiscard]] std::vector<Vec3> outline_on_base(std::size_t part) const {
    std::vector<Vec3> outline = file_.surfaces[part].corners;
    if (covers_base(file_.surfaces[part])) std::reverse(outline.begin(), outline.end());
    return outline;
  }

  void add_polygons(std::size_t i) {
    const auto& corners = file_.surfaces[i].corners;
    if (file_.surfaces[i].kind == Vs3Surface::Kind::mask) return add_mask(i);
    if (parts_[i].empty()) return add_polygon(corners, i);
    std::vector<ConvexPolygon> holes;
    for (const std::size_t part : parts_[i]) holes.emplace_back(outline_on_base(part));
    const double thickness = kOffBase * radiosity::bounding_disc(corners).radius;
    const auto pieces = flat_difference(ConvexPolygon(corners), holes, normal_of(i), thickness);
    for (const ConvexPolygon& piece : pieces) add_polygon(piece.points(), i);
    bool is_masked = false;
    for (const std::size_t part : parts_[i]) {
      if (file_.surfaces[part].kind != Vs3Surface::Kind::mask) continue;
      add_polygon(outline_on_base(part), i);  // what the mask faces
      is_masked = true;
    }
    if (pieces.empty() && !is_masked) fail_at(i, "is wholly covered by the parts that lie in it");
  }

  void add_mask(std::size_t i) {
    std::vector<Vec3> corners = file_.surfaces[i].corners;
    const bool are_exact = std::all_of(corners.begin(), corners.end(), [](const Vec3& corner) {
      return is_exact(corner.x()) && is_exact(corner.y()) && is_exact(corner.z());
    });
    const double distance = (are_exact ? kMaskDistance : kRoundedMaskDistance) *
                            radiosity::bounding_disc(corners).radius;
    const Vec3 off_base = -distance * normal_of(i);
    for (Vec3& corner : corners) corner += off_base;
    add_polygon(corners, i);
  }

  void add_polygon(std::span<const Vec3> corners, std::size_t i) {
    std::vector<std::int32_t> indices;
    for (const Vec3& corner : corners) {
      indices.push_back(static_cast<std::int32_t>(scene_.vertices.size()));
      scene_.vertices.push_back(corner);
    }
    scene_.add_polygon(indices, surface_of_[i]);
  }

  const std::filesystem::path& path_;
  const Vs3File& file_;
  std::vector<std::vector<std::size_t>> parts_;  // of each surface
  std::vector<std::int32_t> surface_of_;         // of the scene
  Scene scene_;
  SurfaceIndex index_;
  RepairCount emissivities_;
  std::vector<std::string> repairs_;
};

}  // namespace

FileScene read_vs3(const std::filesystem::path& path, const radiosity::Progress& progress) {
  const Vs3File file = read_vs3_records(path, progress);
  return Vs3Scene(path, file).run();
}

}  // namespace io
