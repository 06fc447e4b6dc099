#include "io/result/hdf5_patches.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/result/hdf5_input.h"
#include "io/result/hdf5_output.h"

namespace io::hdf5 {
namespace {

using radiosity::PatchMesh;
using radiosity::Vec3;

/// How far the area of a patch's corners may be from the one stored, as a share of it. Both were
/// worked out by the same sums.
constexpr double kAreaTolerance = 1e-6;
constexpr const char* kPrecision = "precision";
constexpr const char* kImages = "images";

std::vector<double> flat(const std::vector<radiosity::Vec3>& points) {
  std::vector<double> values;
  for (const radiosity::Vec3& point : points) {
    values.insert(values.end(), point.data(), point.data() + 3);
  }
  return values;
}

std::vector<std::int32_t> flat(const std::vector<std::array<std::int32_t, 4>>& corners) {
  std::vector<std::int32_t> values;
  for (const auto& patch : corners) values.insert(values.end(), patch.begin(), patch.end());
  return values;
}

Vec3 vector_at(const std::vector<double>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

void add_corner_patches(hid_t file, const std::vector<std::int32_t>& surface,
                        const std::vector<std::int32_t>& polygon, PatchMesh& mesh) {
  const hsize_t n = surface.size();
  const hsize_t n_vertices = Dataset(file, "vertices").shape[0];
  const auto vertices = read_all<double>(file, "vertices", {n_vertices, 3});
  const auto corners = read_all<std::int32_t>(file, "patches/corners", {n, 4});
  for (std::size_t i = 0; i < n_vertices; ++i) mesh.vertices.push_back(vector_at(vertices, i));
  for (std::size_t i = 0; i < n; ++i) {
    std::array<std::int32_t, 4> patch{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t corner = corners[4 * i + k];
      const std::int32_t least = k == 3 ? -1 : 0;
      if (corner < least || (corner >= 0 && static_cast<hsize_t>(corner) >= n_vertices)) {
        throw HdfError(
            fmt::format("patch {} uses vertex {}, but there are {}", i, corner, n_vertices));
      }
      patch[k] = corner;
    }
    mesh.add_patch(patch, surface[i], polygon[i]);
  }
}

void add_square_patches(hid_t file, const std::vector<double>& area,
                        const std::vector<std::int32_t>& surface,
                        const std::vector<std::int32_t>& polygon, PatchMesh& mesh) {
  const hsize_t n = surface.size();
  const auto centroids = read_all<double>(file, "patches/centroid", {n, 3});
  const auto normals = read_all<double>(file, "patches/normal", {n, 3});
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 center = vector_at(centroids, i);
    const Vec3 normal = vector_at(normals, i);
    if (!(std::abs(normal.norm() - 1) < kAreaTolerance)) {
      throw HdfError(fmt::format("patch {} has no unit normal", i));
    }
    const Vec3 u = std::sqrt(area[i]) / 2 * normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vec3& offset : {Vec3(-u - v), Vec3(u - v), Vec3(u + v), Vec3(v - u)}) {
      mesh.vertices.push_back(center + offset);
    }
    mesh.add_patch({first, first + 1, first + 2, first + 3}, surface[i], polygon[i]);
    mesh.area.back() = area[i];
    mesh.normal.back() = normal;
    mesh.centroid.back() = center;
  }
}

void read_sides(hid_t file, PatchMesh& mesh) {
  mesh.surface_two_sided.assign(mesh.surface_names.size(), false);
  if (has_dataset(file, "patches/twin")) {
    mesh.twin = read_all<std::int32_t>(file, "patches/twin", {mesh.twin.size()});
  }
  const auto n = static_cast<std::int32_t>(mesh.size());
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t twin = mesh.twin[i];
    if (twin < 0) continue;
    if (twin >= n || twin == i || mesh.twin[twin] != i) {
      throw HdfError(fmt::format("patch {} has the back {}, which has another one", i, twin));
    }
    mesh.surface_two_sided[mesh.surface[i]] = true;
  }
  if (!has_dataset(file, "surfaces/two_sided")) return;
  const auto two_sided =
      read_all<std::int32_t>(file, "surfaces/two_sided", {mesh.surface_names.size()});
  mesh.surface_two_sided.assign(two_sided.begin(), two_sided.end());
}

void check_patches(const PatchMesh& mesh, const std::vector<double>& area) {
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (!(std::abs(mesh.area[i] - area[i]) <= kAreaTolerance * area[i])) {
      throw HdfError(
          fmt::format("patch {} has an area of {} m² by its corners, {} by /patches/area", i,
                      mesh.area[i], area[i]));
    }
  }
}

/// Takes over what was stored to the last bit, in which backs may differ from their corners' sums,
/// where it agrees with these.
void restore_places(hid_t file, const std::vector<double>& area, PatchMesh& mesh) {
  const hsize_t n = area.size();
  const auto centroids = read_all<double>(file, "patches/centroid", {n, 3});
  const auto normals = read_all<double>(file, "patches/normal", {n, 3});
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 centroid = vector_at(centroids, i);
    const Vec3 normal = vector_at(normals, i);
    const double scale = std::sqrt(area[i]) + centroid.norm();
    if (!((centroid - mesh.centroid[i]).norm() <= kAreaTolerance * scale) ||
        !((normal - mesh.normal[i]).norm() <= kAreaTolerance)) {
      continue;
    }
    mesh.area[i] = area[i];
    mesh.centroid[i] = centroid;
    mesh.normal[i] = normal;
  }
}

/// What the patches are parts of, which files of before have not.
void read_polygons(hid_t file, PatchMesh& mesh) {
  if (!has_dataset(file, "polygons/corners")) return;
  const hsize_t n_corners = Dataset(file, "polygons/corners").shape[0];
  const auto corners = read_all<double>(file, "polygons/corners", {n_corners, 3});
  for (std::size_t k = 0; k < n_corners; ++k) mesh.polygon_corners.push_back(vector_at(corners, k));
  const hsize_t n_offsets = Dataset(file, "polygons/first_corner").shape[0];
  mesh.first_polygon_corner = read_all<std::int64_t>(file, "polygons/first_corner", {n_offsets});
  const auto& first = mesh.first_polygon_corner;
  const bool is_whole = first.empty() ? n_corners == 0
                                      : first.front() == 0 &&
                                            first.back() == static_cast<std::int64_t>(n_corners) &&
                                            std::is_sorted(first.begin(), first.end());
  if (!is_whole) throw HdfError("the polygons do not make up the list of their corners");
  for (const std::int32_t polygon : mesh.polygon) {
    if (mesh.n_polygons() > 0 && polygon >= mesh.n_polygons()) {
      throw HdfError(
          fmt::format("has a patch of polygon {}, but there are {}", polygon, mesh.n_polygons()));
    }
  }
  mesh.family = read_all<std::int32_t>(file, "patches/family", {mesh.family.size()});
  mesh.precision = read_attribute<double>(file, kPrecision);
}

/// Of a part of a symmetric whole: rows of [linear | shift].
void write_images(hid_t file, const PatchMesh& mesh) {
  if (mesh.images.empty()) return;
  std::vector<double> values;
  for (const radiosity::Motion& image : mesh.images) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) values.push_back(image.linear(row, column));
      values.push_back(image.shift[row]);
    }
  }
  write_dataset(file, kImages, values, {mesh.images.size(), 12});
}

void read_images(hid_t file, PatchMesh& mesh) {
  if (!has_dataset(file, kImages)) return;
  const hsize_t n = Dataset(file, kImages).shape[0];
  if (n > static_cast<hsize_t>(radiosity::kMostImages)) {
    throw HdfError(fmt::format("has {} images", n));
  }
  const auto values = read_all<double>(file, kImages, {n, 12});
  for (std::size_t g = 0; g < n; ++g) {
    radiosity::Motion image;
    for (int row = 0; row < 3; ++row) {
      const double* first = &values[12 * g + 4 * row];
      for (int column = 0; column < 3; ++column) image.linear(row, column) = first[column];
      image.shift[row] = first[3];
    }
    const Eigen::Matrix3d square = image.linear * image.linear.transpose();
    if (!(square.isIdentity(kAreaTolerance) && image.shift.allFinite())) {
      throw HdfError(fmt::format("image {} is no motion", g));
    }
    mesh.images.push_back(image);
  }
}

}  // namespace

void write_mesh(hid_t file, const PatchMesh& mesh) {
  const auto n = static_cast<hsize_t>(mesh.size());
  const Handle patches = make_group(file, "patches");
  write_list(patches, "area", mesh.area);
  write_dataset(patches, "centroid", flat(mesh.centroid), {n, 3});
  write_dataset(patches, "normal", flat(mesh.normal), {n, 3});
  write_list(patches, "surface", mesh.surface);
  write_list(patches, "polygon", mesh.polygon);
  write_dataset(patches, "corners", flat(mesh.corners), {n, 4});
  write_list(patches, "twin", mesh.twin);
  write_list(patches, "family", mesh.family);
  write_dataset(file, "vertices", flat(mesh.vertices), {mesh.vertices.size(), 3});
  const Handle polygons = make_group(file, "polygons");
  write_dataset(polygons, "corners", flat(mesh.polygon_corners), {mesh.polygon_corners.size(), 3});
  write_list(polygons, "first_corner", mesh.first_polygon_corner);
  const Handle surfaces = make_group(file, "surfaces");
  write_names(surfaces, "name", mesh.surface_names);
  write_list(
      surfaces, "two_sided",
      std::vector<std::int32_t>(mesh.surface_two_sided.begin(), mesh.surface_two_sided.end()));
  write_attribute(file, kPrecision, mesh.precision);
  write_images(file, mesh);
}

PatchMesh read_mesh(hid_t file, std::vector<std::string>& warnings) {
  PatchMesh mesh;
  mesh.surface_names = read_names(file, "surfaces/name");
  const hsize_t n = Dataset(file, "patches/area").shape[0];
  if (n == 0 || n > static_cast<hsize_t>(std::numeric_limits<std::int32_t>::max())) {
    throw HdfError(fmt::format("has {} patches", n));
  }
  const auto area = read_all<double>(file, "patches/area", {n});
  const auto surface = read_all<std::int32_t>(file, "patches/surface", {n});
  const auto polygon = read_all<std::int32_t>(file, "patches/polygon", {n});
  for (std::size_t i = 0; i < n; ++i) {
    if (!(area[i] > 0)) throw HdfError(fmt::format("patch {} has the area {} m²", i, area[i]));
    if (surface[i] < 0 || static_cast<std::size_t>(surface[i]) >= mesh.surface_names.size()) {
      throw HdfError(fmt::format("patch {} is of surface {}, but there are {}", i, surface[i],
                                 mesh.surface_names.size()));
    }
    if (polygon[i] < 0) throw HdfError(fmt::format("patch {} is of polygon {}", i, polygon[i]));
  }
  if (has_dataset(file, "patches/corners") && has_dataset(file, "vertices")) {
    add_corner_patches(file, surface, polygon, mesh);
    check_patches(mesh, area);
    restore_places(file, area, mesh);
  } else {
    add_square_patches(file, area, surface, polygon, mesh);
    warnings.emplace_back(
        "the file does not have the corners of the patches; each is shown as a square of its area");
  }
  read_sides(file, mesh);
  read_polygons(file, mesh);
  read_images(file, mesh);
  return mesh;
}

}  // namespace io::hdf5
