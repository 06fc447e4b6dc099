#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/extension.h"
#include "io/base/line_reader.h"
#include "io/mesh/file_scene.h"
#include "io/mesh/read_vtk_mesh.h"
#include "io/mesh/surface_index.h"
#include "io/result/vtk_cell_materials.h"
#include "io/result/vtk_legacy_file.h"
#include "io/result/vtp_file.h"
#include "io/result/vtp_values.h"

// Polygons of VTK files as other programs write them.
namespace io {
namespace {

using radiosity::Scene;

/// Arrays of cells that name surfaces by number, in the order in which they are looked for.
constexpr std::array<const char*, 4> kSurfaceArrays = {"surface", "gmsh:physical",
                                                       "gmsh:geometrical", "cell_tags"};

/// The corners that count of a cell of VTK's type with n of them, in their order round it; none if
/// it is no polygon.
std::vector<std::size_t> outline(int type, std::size_t n) {
  constexpr int kTriangle = 5;
  constexpr int kPolygon = 7;
  constexpr int kPixel = 8;
  constexpr int kQuad = 9;
  constexpr int kQuadraticTriangle = 22;
  constexpr int kQuadraticQuad = 23;
  constexpr int kBiquadraticQuad = 28;
  constexpr int kBiquadraticTriangle = 34;
  constexpr int kLagrangeTriangle = 69;
  constexpr int kLagrangeQuad = 70;
  constexpr int kBezierTriangle = 76;
  constexpr int kBezierQuad = 77;
  std::size_t n_corners = 0;
  switch (type) {
    case kTriangle:
    case kQuadraticTriangle:
    case kBiquadraticTriangle:
    case kLagrangeTriangle:
    case kBezierTriangle:
      n_corners = 3;
      break;
    case kQuad:
    case kQuadraticQuad:
    case kBiquadraticQuad:
    case kLagrangeQuad:
    case kBezierQuad:
      n_corners = 4;
      break;
    case kPixel:
      return n >= 4 ? std::vector<std::size_t>{0, 1, 3, 2} : std::vector<std::size_t>{};
    case kPolygon:
      n_corners = n;
      break;
    default:
      return {};
  }
  if (n < n_corners) return {};
  std::vector<std::size_t> result(n_corners);
  for (std::size_t k = 0; k < n_corners; ++k) result[k] = k;
  return result;
}

class VtkMeshReader {
 public:
  explicit VtkMeshReader(const std::filesystem::path& path)
      : path_(path),
        file_(lower_case_extension(path) == ".vtk" ? read_vtk_legacy(path) : read_vtk_xml(path)),
        materials_(file_, path_),
        surfaces_(scene_, path.stem().string()) {}

  FileScene read() {
    read_points();
    find_surfaces();
    read_polygons();
    if (!materials_.empty()) scene_.bands = materials_.bands();
    FileScene result{std::move(scene_), {}};
    if (!materials_.left_out().empty()) {
      result.scene.warnings.push_back(path_.string() + ": " + materials_.left_out());
    }
    left_out_.report("only polygons are read", result.repairs);
    return result;
  }

 private:
  [[noreturn]] void damaged(const std::string& what) const { fail(path_, "is damaged: " + what); }

  void read_points() {
    const VtpArray& points = file_.points;
    if (file_.n_points == 0) return;
    if (points.n_components != 3 || points.type == "String") {
      damaged("its points are not three coordinates each");
    }
    for (std::size_t i = 0; i < file_.n_points; ++i) {
      const radiosity::Vec3 point(number<double>(points, 3 * i), number<double>(points, 3 * i + 1),
                                  number<double>(points, 3 * i + 2));
      if (!point.allFinite()) damaged(fmt::format("point {} is not finite", i));
      scene_.vertices.push_back(point);
    }
  }

  [[nodiscard]] const VtpArray* of_cells(const char* name) const {
    const auto found = file_.cells.find(name);
    return found == file_.cells.end() || !is_whole(found->second) ? nullptr : &found->second;
  }

  void find_surfaces() {
    for (const char* name : kSurfaceArrays) {
      if (numbers_ == nullptr) numbers_ = of_cells(name);
    }
    const auto names = file_.fields.find("surface_names");
    if (names == file_.fields.end() || names->second.type != "String") return;
    std::string_view rest = names->second.bytes;
    for (auto end = rest.find('\0'); end != std::string_view::npos; end = rest.find('\0')) {
      names_.emplace_back(rest.substr(0, end));
      rest.remove_prefix(end + 1);
    }
  }

  std::int32_t surface(std::size_t cell) {
    const std::int64_t tag = numbers_ == nullptr ? 0 : number<std::int64_t>(*numbers_, cell);
    const int material = materials_.find_or_add(cell, scene_);
    if (last_surface_ >= 0 && tag == last_tag_ && material == last_material_) return last_surface_;
    const bool is_named = tag >= 0 && tag < std::ssize(names_);
    std::string name = is_named              ? names_[tag]
                       : numbers_ == nullptr ? path_.stem().string()
                                             : fmt::format("surface {}", tag);
    last_tag_ = tag;
    last_material_ = material;
    return last_surface_ = surfaces_.find_or_add(name, material);
  }

  const VtpArray& cell_list(const char* name) const {
    const auto found = file_.polygons.find(name);
    if (found == file_.polygons.end() || !is_whole(found->second)) {
      damaged(fmt::format("the {} of its cells are no whole numbers", name));
    }
    return found->second;
  }

  void read_polygons() {
    if (file_.n_polygons == 0) return;
    const VtpArray& offsets = cell_list("offsets");
    const VtpArray& corners = cell_list("connectivity");
    const VtpArray* types = file_.kind == VtkKind::unstructured ? &cell_list("types") : nullptr;
    if (file_.n_other_cells > 0) left_out_.add(path_.string(), "has vertices, lines or strips");
    // Values of vertices and lines come before those of polygons.
    const std::size_t first_cell = types == nullptr ? file_.n_verts_and_lines : 0;
    std::uint64_t begin = 0;
    std::vector<std::int32_t> polygon;
    for (std::size_t cell = 0; cell < file_.n_polygons; ++cell) {
      const auto end = number<std::uint64_t>(offsets, cell);
      if (end < begin || end > n_values(corners)) {
        damaged(fmt::format("cell {} ends where it cannot", cell));
      }
      constexpr int kPolygon = 7;
      const int type = types == nullptr ? kPolygon : number<int>(*types, cell);
      polygon.clear();
      for (const std::size_t k : outline(type, end - begin)) {
        const auto corner = number<std::uint64_t>(corners, begin + k);
        if (corner >= file_.n_points) {
          damaged(
              fmt::format("cell {} uses point {}, but there are {}", cell, corner, file_.n_points));
        }
        polygon.push_back(static_cast<std::int32_t>(corner));
      }
      if (polygon.empty()) {
        left_out_.add(path_.string(), fmt::format("cell {} is of type {}", cell, type));
      } else {
        scene_.add_polygon(polygon, surface(first_cell + cell));
      }
      begin = end;
    }
  }

  const std::filesystem::path& path_;
  VtpFile file_;
  Scene scene_;
  const VtpArray* numbers_ = nullptr;  // of the surfaces
  std::vector<std::string> names_;     // by number, if they have any
  VtkCellMaterials materials_;
  SurfaceIndex surfaces_;
  std::int64_t last_tag_ = 0;
  int last_material_ = -1;
  std::int32_t last_surface_ = -1;  // none yet
  RepairCount left_out_;
};

}  // namespace
}  // namespace io

void radiosity_io_read_vtk_mesh(const std::filesystem::path& path, io::FileScene& result) {
  result = io::VtkMeshReader(path).read();
}
