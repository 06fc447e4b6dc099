#include "io/mesh/gltf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/mesh/gltf_document.h"
#include "io/mesh/gltf_materials.h"
#include "io/mesh/gltf_nodes.h"
#include "io/mesh/gltf_triangles.h"
#include "io/mesh/surface_index.h"
#include "io/mesh/texture_coordinates.h"

namespace io {
namespace {

using radiosity::Progress;
using radiosity::Scene;
using radiosity::Vec3;

/// Extensions that a file may require: those that are read, and those that change nothing here.
constexpr std::array<std::string_view, 28> kKnownExtensions = {
    "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_variants",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "KHR_animation_pointer",
    "KHR_node_visibility",
    "KHR_xmp_json_ld",
    "KHR_xmp",
    "EXT_texture_webp",
    "EXT_texture_avif",
    "EXT_lights_image_based",
    "MSFT_texture_dds",
    "AGI_articulations",
    "KHR_lights_punctual"};

/// What files may hold by using one vertex or triangle many times, where they have fewer bytes.
constexpr double kMostMultiplied = 1'000'000;

/// The instances of a node by EXT_mesh_gpu_instancing: the accessors that give their places.
struct InstanceAccessors {
  std::optional<JsonItem> translation, rotation, scale;
  std::int64_t count = 1;
};

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& path, const Progress& progress)
      : path_(path),
        progress_(progress),
        document_(path, progress),
        surfaces_(scene_, path.stem().string()) {}

  FileScene read() {
    check_extensions();
    materials_ = read_gltf_materials(path_, document_);
    scene_.materials = std::move(materials_.materials);
    const GltfTree tree(document_);
    check_size(tree);
    tree.walk([&](const GltfNode& node) { add_node(node); });
    std::vector<std::string> repairs = document_.take_repairs();
    materials_.emissive.report("only the colour factors are read", scene_.warnings);
    materials_.unread.report("only the colour factors are read", scene_.warnings);
    pad_texture_coordinates(scene_);
    check_texture_coordinates(path_, scene_, repairs);
    skipped_.report("points and lines are left out", scene_.warnings);
    deformed_.report("its shape at rest is read", scene_.warnings);
    return {std::move(scene_), std::move(repairs)};
  }

 private:
  void check_extensions() const {
    const auto required = document_.root().find("extensionsRequired");
    if (!required) return;
    for (std::size_t i = 0; i < required->size(); ++i) {
      const std::string name = (*required)[i].text();
      if (std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name) ==
          kKnownExtensions.end()) {
        fail(path_,
             fmt::format("requires the extension {}, which is not supported", in_quotes(name)));
      }
    }
  }

  [[nodiscard]] InstanceAccessors instances(const JsonItem& node) const {
    InstanceAccessors result;
    const auto attributes =
        find_inside(node, {"extensions", "EXT_mesh_gpu_instancing", "attributes"});
    if (!attributes) return result;
    std::optional<std::int64_t> count;
    const auto accessor = [&](std::string_view key) -> std::optional<JsonItem> {
      const auto index = attributes->find(key);
      if (!index) return std::nullopt;
      JsonItem found = document_.element("accessors", *index);
      const std::int64_t n = GltfDocument::count(found);
      if (count.value_or(n) != n) {
        attributes->fail(fmt::format("give {} and {} instances", *count, n));
      }
      count = n;
      return found;
    };
    if (const auto found = accessor("TRANSLATION")) result.translation.emplace(*found);
    if (const auto found = accessor("ROTATION")) result.rotation.emplace(*found);
    if (const auto found = accessor("SCALE")) result.scale.emplace(*found);
    result.count = count.value_or(1);
    return result;
  }

  struct MeshSize {
    double n_vertices = 0;
    double n_triangles = 0;
    double n_primitives = 0;
  };

  [[nodiscard]] MeshSize mesh_size(const JsonItem& mesh) const {
    MeshSize size;
    const JsonItem primitives = mesh.at("primitives");
    size.n_primitives = static_cast<double>(primitives.size());
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      const JsonItem primitive = primitives[k];
      const auto position = primitive.at("attributes").find("POSITION");
      if (!position) continue;
      const auto vertices = GltfDocument::count(document_.element("accessors", *position));
      const auto indices = primitive.find("indices");
      const auto corners =
          indices ? GltfDocument::count(document_.element("accessors", *indices)) : vertices;
      size.n_vertices += static_cast<double>(vertices);
      size.n_triangles += static_cast<double>(n_gltf_triangles(primitive, corners));
    }
    return size;
  }

  /// Refuses, before anything is made, what a small file multiplies beyond measure.
  void check_size(const GltfTree& tree) const {
    std::map<std::size_t, MeshSize>
        sizes;  // each mesh is looked at once, however many nodes use it
    double n_vertices = 0;
    double n_triangles = 0;
    double n_instances = 0;  // of meshes or, where these have several, primitives
    for (std::size_t i = 0; i < tree.counts().size(); ++i) {
      if (tree.counts()[i] == 0) continue;
      const JsonItem node = document_.element("nodes", i);
      const auto index = node.find("mesh");
      if (!index) continue;
      const JsonItem mesh = document_.element("meshes", *index);
      const auto number = static_cast<std::size_t>(index->number());
      auto size = sizes.find(number);
      if (size == sizes.end()) size = sizes.emplace(number, mesh_size(mesh)).first;
      const double n = tree.counts()[i] * static_cast<double>(instances(node).count);
      n_instances += n * std::max(1.0, size->second.n_primitives);
      n_vertices += n * size->second.n_vertices;
      n_triangles += n * size->second.n_triangles;
    }
    const double most = std::max(kMostMultiplied, static_cast<double>(document_.n_bytes()));
    if (std::max({n_instances, n_vertices, n_triangles}) > most) {
      fail(path_, fmt::format("has {:.0f} instances of primitives with {:.0f} vertices and {:.0f} "
                              "triangles in all, expected at most {:.0f} from {} bytes",
                              n_instances, n_vertices, n_triangles, most, document_.n_bytes()));
    }
  }

  void add_node(const GltfNode& node) {
    progress_.check();
    const JsonItem item = document_.element("nodes", node.index);
    const auto index = item.find("mesh");
    if (!index) return;
    const JsonItem mesh = document_.element("meshes", *index);
    std::string name = gltf_name(item);
    if (name.empty()) name = gltf_name(mesh);
    if (name.empty()) name = fmt::format("node-{}", node.index);
    name = surfaces_.unused_name(name);
    if (item.has("skin") || mesh.has("weights")) {
      deformed_.add(path_.string(), fmt::format("mesh {} is deformed", in_quotes(name)));
    }
    const std::vector<Eigen::Affine3d> transforms = placed(item, node.transform);
    const JsonItem primitives = mesh.at("primitives");
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      add_primitive(primitives[k], name, transforms);
    }
  }

  /// The transform of each instance of a node.
  std::vector<Eigen::Affine3d> placed(const JsonItem& node, const Eigen::Affine3d& transform) {
    const InstanceAccessors accessors = instances(node);
    std::vector<Eigen::Affine3d> result(static_cast<std::size_t>(accessors.count), transform);
    if (accessors.translation) {
      const GltfValues values = document_.values(*accessors.translation, "VEC3");
      for (std::size_t i = 0; i < result.size(); ++i) result[i].translate(point(values, i));
    }
    if (accessors.rotation) {
      const GltfValues q = document_.values(*accessors.rotation, "VEC4");
      for (std::int64_t i = 0; i < q.count; ++i) {
        const Eigen::Quaterniond rotation(q(i, 3), q(i, 0), q(i, 1), q(i, 2));
        if (!(rotation.norm() > 0)) accessors.rotation->fail("gives a rotation of zero");
        result[static_cast<std::size_t>(i)].rotate(rotation.normalized());
      }
    }
    if (accessors.scale) {
      const GltfValues values = document_.values(*accessors.scale, "VEC3");
      for (std::size_t i = 0; i < result.size(); ++i) result[i].scale(point(values, i));
    }
    return result;
  }

  static Vec3 point(const GltfValues& values, std::size_t i) {
    const auto k = static_cast<std::int64_t>(i);
    return {values(k, 0), values(k, 1), values(k, 2)};
  }

  void add_primitive(const JsonItem& primitive, const std::string& object,
                     const std::vector<Eigen::Affine3d>& transforms) {
    if (!has_gltf_triangles(primitive)) {
      skipped_.add(path_.string(),
                   fmt::format("surface {} has points or lines", in_quotes(object)));
      return;
    }
    const auto position = primitive.at("attributes").find("POSITION");
    if (!position) return;  // glTF 2.0, 3.7.2.1: there is nothing to draw
    const GltfValues points = document_.values(document_.element("accessors", *position), "VEC3");
    const std::vector<std::int32_t> corners = gltf_triangles(document_, primitive, points.count);
    const std::int32_t surface = find_surface(primitive, object);
    const std::vector<Eigen::Vector2d> coordinates =
        texture_coordinates(primitive, scene_.surfaces[surface].material, points.count);
    for (const Eigen::Affine3d& transform : transforms) {
      progress_.check();
      add_triangles(primitive, points, corners, transform, surface);
      add_coordinates(coordinates, corners, transform.linear().determinant() < 0);
    }
  }

  /// Of each vertex, as its material's texture has them; none if there is none or it has none.
  std::vector<Eigen::Vector2d> texture_coordinates(const JsonItem& primitive, int material,
                                                   std::int64_t n_vertices) {
    std::vector<Eigen::Vector2d> result;
    if (material < 0 || !materials_.textures[static_cast<std::size_t>(material)]) return result;
    const GltfPlacement& placement = *materials_.textures[static_cast<std::size_t>(material)];
    const auto accessor =
        primitive.at("attributes").find(fmt::format("TEXCOORD_{}", placement.set));
    if (!accessor) return result;
    const GltfValues values = document_.values(document_.element("accessors", *accessor), "VEC2");
    if (values.count != n_vertices) {
      accessor->fail(
          fmt::format("has {} texture coordinates of {} vertices", values.count, n_vertices));
    }
    for (std::int64_t i = 0; i < values.count; ++i) {
      result.emplace_back(placement.transform * Eigen::Vector2d(values(i, 0), values(i, 1)));
    }
    return result;
  }

  /// Of the triangles that were added last.
  void add_coordinates(const std::vector<Eigen::Vector2d>& coordinates,
                       const std::vector<std::int32_t>& corners, bool is_mirrored) {
    if (coordinates.empty()) return;
    std::vector<Eigen::Vector2d>& all = scene_.texture_coordinates;
    all.resize(scene_.corners.size() - corners.size(),
               Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
    for (std::size_t c = 0; c < corners.size(); c += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t corner = corners[c + (is_mirrored ? 2 - k : k)];
        all.push_back(coordinates[static_cast<std::size_t>(corner)]);
      }
    }
  }

  std::int32_t find_surface(const JsonItem& primitive, const std::string& object) {
    int material = -1;
    if (const auto index = primitive.find("material")) {
      (void)document_.element("materials", *index);
      material = static_cast<int>(index->number());
    }
    const std::int32_t surface = surfaces_.find_or_add(object, material);
    scene_.surfaces[static_cast<std::size_t>(surface)].two_sided =
        material >= 0 && materials_.two_sided[static_cast<std::size_t>(material)];
    return surface;
  }

  void add_triangles(const JsonItem& primitive, const GltfValues& points,
                     const std::vector<std::int32_t>& corners, const Eigen::Affine3d& transform,
                     std::int32_t surface) {
    const auto first_vertex = static_cast<std::int32_t>(scene_.vertices.size());
    for (std::int64_t i = 0; i < points.count; ++i) {
      const Vec3 vertex = transform * point(points, static_cast<std::size_t>(i));
      if (!vertex.allFinite()) {
        primitive.fail(fmt::format("vertex {}: coordinate is not finite", i));
      }
      scene_.vertices.push_back(vertex);
    }
    const double gain = transform.linear().cwiseAbs().rowwise().sum().maxCoeff();
    scene_.precision = std::max(scene_.precision, gain * points.quantum / 2);
    // A mirroring transform reverses the sense of a triangle's corners (glTF 2.0, 3.7.4).
    const bool is_mirrored = transform.linear().determinant() < 0;
    for (std::size_t c = 0; c < corners.size(); c += 3) {
      std::array<std::int32_t, 3> triangle = {
          first_vertex + corners[c], first_vertex + corners[c + 1], first_vertex + corners[c + 2]};
      if (is_mirrored) std::swap(triangle[0], triangle[2]);
      scene_.add_polygon(triangle, surface);
    }
  }

  std::filesystem::path path_;
  const Progress& progress_;
  GltfDocument document_;
  Scene scene_;
  SurfaceIndex surfaces_;
  GltfMaterials materials_;
  RepairCount skipped_, deformed_;
};

}  // namespace

FileScene read_gltf(const std::filesystem::path& path, const Progress& progress) {
  return GltfReader(path, progress).read();
}

}  // namespace io
