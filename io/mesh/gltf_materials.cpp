#include "io/mesh/gltf_materials.h"

#include <fmt/format.h>

#include <set>
#include <string>

#include "io/base/input_checks.h"
#include "io/base/printable.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using radiosity::Emission;
using radiosity::Material;

Eigen::Vector3d color(const JsonItem& item) {
  if (item.size() < 3) item.fail(fmt::format("has {} numbers, expected 3 or 4", item.size()));
  return {item[0].number(), item[1].number(), item[2].number()};
}

Eigen::Vector3d base_color(const JsonItem& material) {
  if (const auto factor = find_inside(material, {"pbrMetallicRoughness", "baseColorFactor"})) {
    return color(*factor);
  }
  if (const auto factor = find_inside(
          material, {"extensions", "KHR_materials_pbrSpecularGlossiness", "diffuseFactor"})) {
    return color(*factor);
  }
  return Eigen::Vector3d::Ones();
}

Eigen::Vector3d radiance(const JsonItem& material) {
  const auto factor = material.find("emissiveFactor");
  if (!factor) return Eigen::Vector3d::Zero();
  const auto strength =
      find_inside(material, {"extensions", "KHR_materials_emissive_strength", "emissiveStrength"});
  return (strength ? strength->number() : 1.0) * color(*factor);
}

/// The texture of what the reflectance is taken from.
std::optional<JsonItem> base_texture(const JsonItem& material) {
  if (auto texture = find_inside(material, {"pbrMetallicRoughness", "baseColorTexture"})) {
    return texture;
  }
  return find_inside(material,
                     {"extensions", "KHR_materials_pbrSpecularGlossiness", "diffuseTexture"});
}

Material make_material(const JsonItem& item, const std::string& name) {
  Material material{.name = name, .reflectance = base_color(item), .emission = {}};
  const Eigen::VectorXd emitted = radiance(item);
  if (const auto problem = reflectance_problem(material.reflectance)) item.fail(*problem);
  if (const auto problem = emission_problem("radiance", emitted)) item.fail(*problem);
  if (!emitted.isZero(0)) material.emission = {Emission::Kind::radiance, emitted};
  return material;
}

}  // namespace

GltfMaterials read_gltf_materials(const std::filesystem::path& path, GltfDocument& document) {
  GltfMaterials result;
  GltfTextures textures(document);
  std::set<std::string> names;
  for (std::size_t i = 0; i < document.size("materials"); ++i) {
    const JsonItem item = document.element("materials", i);
    std::string name = gltf_name(item);
    if (name.empty()) name = fmt::format("material-{}", i);
    while (!names.insert(name).second) name += fmt::format("-{}", i);
    result.materials.push_back(make_material(item, name));
    const std::string who = fmt::format("material {}: ", in_quotes(name));
    if (item.has("emissiveTexture")) {
      result.emissive.add(path.string(), who + "emissive textures are not read");
    }
    result.textures.emplace_back();
    if (const auto texture = base_texture(item)) {
      try {
        result.textures.back() = textures.read(*texture, result.materials.back());
      } catch (const radiosity::SceneError& error) {
        result.unread.add(path.string(), who + error.what());
      }
    }
    const auto two_sided = item.find("doubleSided");
    result.two_sided.push_back(two_sided && two_sided->boolean());
  }
  return result;
}

}  // namespace io
