// glTF stores coordinates in single precision and has no lines that a message could name, so
// Assimp loses nothing here. The other formats have readers of our own: Assimp would round their
// coordinates to float, reorder polygons by material, and report errors without a line.

#include "io/gltf_reader.h"

#include <assimp/GltfMaterial.h>
#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <map>

#include "io/byte_reader.h"
#include "io/input_checks.h"
#include "io/json_item.h"
#include "io/line_reader.h"
#include "io/mesh_file.h"
#include "io/surface_index.h"

namespace io {
namespace {

using radiosity::Emission;
using radiosity::Material;
using radiosity::Progress;
using radiosity::Scene;
using radiosity::Vec3;
using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Matrix to_double(const aiMatrix4x4& matrix) {
  return Eigen::Map<const Eigen::Matrix<float, 4, 4, Eigen::RowMajor>>(&matrix.a1).cast<double>();
}

/// Factors of the emissive colour by material name (the extension KHR_materials_emissive_strength,
/// which Assimp 5.2 does not read; its materials are not in the file's order, hence by name).
std::map<std::string, double> read_strengths(const std::filesystem::path& path,
                                             const Progress& progress) {
  ByteReader bytes(path, 0, progress);
  std::uint64_t size = bytes.size();
  if (lower_extension(path) == ".glb") {
    // A header of 12 bytes, then length and type of the chunk that holds the JSON.
    size = load<std::uint32_t>(bytes.take(20) + 12, std::endian::little);
  }
  const char* text = bytes.take(size);
  std::map<std::string, double> strengths;
  try {
    const Json json = Json::parse(text, text + size);
    if (!json.contains("materials")) return strengths;
    const Json::json_pointer key("/extensions/KHR_materials_emissive_strength/emissiveStrength");
    for (const Json& material : json.at("materials")) {
      const auto name = material.value("name", "");
      const double strength = material.value(key, 1.0);
      if (strengths.try_emplace(name, strength).first->second != strength) {
        fail(path, fmt::format("materials named \"{}\" differ in emissive strength", name));
      }
    }
  } catch (const Json::exception& error) {
    fail(path, error.what());
  }
  return strengths;
}

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& path, const Progress& progress)
      : path_(path), progress_(progress), surfaces_(scene_, path.stem().string()) {}

  Scene read() {
    input_size(path_);
    Assimp::Importer importer;
    file_ = importer.ReadFile(path_.string(), aiProcess_ValidateDataStructure);
    if (file_ == nullptr) fail(path_, importer.GetErrorString());
    check_version();
    strengths_ = read_strengths(path_, progress_);
    read_materials();
    add_node(*file_->mRootNode, Matrix::Identity());
    return std::move(scene_);
  }

 private:
  void check_version() {
    aiString version;
    if (file_->mMetaData != nullptr &&
        file_->mMetaData->Get(AI_METADATA_SOURCE_FORMAT_VERSION, version) &&
        !std::string_view(version.C_Str()).starts_with("2")) {
      fail(path_, fmt::format("is glTF {}, expected 2.0", version.C_Str()));
    }
  }

  void read_materials() {
    // Assimp's last material is its own, for primitives without one.
    for (unsigned i = 0; i + 1 < file_->mNumMaterials; ++i) {
      scene_.materials.push_back(make_material(*file_->mMaterials[i]));
    }
  }

  Material make_material(const aiMaterial& given) {
    Material material;
    material.name = given.GetName().C_Str();
    aiColor4D base(1, 1, 1, 1);
    given.Get(AI_MATKEY_BASE_COLOR, base);
    aiColor3D emissive(0, 0, 0);
    given.Get(AI_MATKEY_COLOR_EMISSIVE, emissive);
    const auto strength = strengths_.find(material.name);
    const Eigen::VectorXd radiance = (strength == strengths_.end() ? 1.0 : strength->second) *
                                     Eigen::Vector3d(emissive.r, emissive.g, emissive.b);
    material.reflectance = Eigen::Vector3d(base.r, base.g, base.b);
    check(material.name, reflectance_problem(material.reflectance));
    check(material.name, emission_problem("radiance", radiance));
    if (!radiance.isZero(0)) material.emission = {Emission::Kind::radiance, radiance};
    if (given.GetTextureCount(aiTextureType_BASE_COLOR) > 0 ||
        given.GetTextureCount(aiTextureType_EMISSIVE) > 0) {
      scene_.warnings.push_back(
          fmt::format("{}: material \"{}\": textures are not read, only the "
                      "colour factors",
                      path_.string(), material.name));
    }
    return material;
  }

  void check(const std::string& material, const std::optional<std::string>& problem) const {
    if (problem) fail(path_, fmt::format("material \"{}\": {}", material, *problem));
  }

  void add_node(const aiNode& node, const Matrix& parent) {
    progress_.check();
    const Matrix transform = parent * to_double(node.mTransformation);
    std::string name = node.mName.C_Str();
    if (name.empty() && node.mNumMeshes > 0) name = file_->mMeshes[node.mMeshes[0]]->mName.C_Str();
    if (!name.empty() && node.mNumMeshes > 0) name = surfaces_.unused_name(name);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      add_mesh(*file_->mMeshes[node.mMeshes[i]], name, transform);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], transform);
  }

  void add_mesh(const aiMesh& mesh, const std::string& object, const Matrix& transform) {
    if ((mesh.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON)) == 0) return;
    const bool has_material = mesh.mMaterialIndex + 1 < file_->mNumMaterials;
    const auto surface =
        surfaces_.find_or_add(object, has_material ? static_cast<int>(mesh.mMaterialIndex) : -1);
    int two_sided = 0;
    file_->mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_TWOSIDED, two_sided);
    scene_.surfaces[surface].two_sided = two_sided != 0;

    const auto first_vertex = static_cast<std::int32_t>(scene_.vertices.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& v = mesh.mVertices[i];
      const Eigen::Vector4d point = transform * Eigen::Vector4d(v.x, v.y, v.z, 1);
      if (!point.allFinite()) {
        fail(path_, fmt::format("mesh \"{}\", vertex {}: coordinate is not finite",
                                mesh.mName.C_Str(), i));
      }
      scene_.vertices.push_back(point.head<3>());
    }
    // A mirroring transform reverses the sense of a triangle's corners (glTF 2.0, 3.7.4).
    const bool is_mirrored = transform.topLeftCorner<3, 3>().determinant() < 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      add_face(mesh.mFaces[i], first_vertex, is_mirrored, surface, mesh);
    }
  }

  void add_face(const aiFace& face, std::int32_t first_vertex, bool is_mirrored,
                std::int32_t surface, const aiMesh& mesh) {
    if (face.mNumIndices < 3) return;  // points and lines
    corners_.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const unsigned index = face.mIndices[is_mirrored ? face.mNumIndices - 1 - k : k];
      if (index >= mesh.mNumVertices) {
        fail(path_, fmt::format("mesh \"{}\": face uses vertex {}, but there are {}",
                                mesh.mName.C_Str(), index, mesh.mNumVertices));
      }
      corners_.push_back(first_vertex + static_cast<std::int32_t>(index));
    }
    scene_.add_polygon(corners_, surface);
  }

  std::filesystem::path path_;
  const Progress& progress_;
  Scene scene_;
  SurfaceIndex surfaces_;
  const aiScene* file_ = nullptr;
  std::map<std::string, double> strengths_;
  std::vector<std::int32_t> corners_;
};

}  // namespace

Scene read_gltf(const std::filesystem::path& path, const Progress& progress) {
  return GltfReader(path, progress).read();
}

}  // namespace io
