#include "io/mesh/gltf_textures.h"

#include <fmt/format.h>

#include <utility>

#include "radiosity/base/error.h"

namespace io {
namespace {

using radiosity::Texture;
using radiosity::TextureWrap;

/// OpenGL's numbers (glTF 2.0, 5.26).
constexpr std::int64_t kLargestNumber = 1 << 20;

TextureWrap read_wrap(const std::optional<JsonItem>& sampler, std::string_view key) {
  const auto item = sampler ? sampler->find(key) : std::nullopt;
  if (!item) return TextureWrap::repeat;
  switch (gltf_integer(*item, kLargestNumber)) {
    case 10497:
      return TextureWrap::repeat;
    case 33071:
      return TextureWrap::clamp;
    case 33648:
      return TextureWrap::mirror;
    default:
      item->fail("is none of 10497, 33071 and 33648");
  }
}

Eigen::Vector2d read_pair(const JsonItem& item) {
  if (item.size() != 2) item.fail(fmt::format("has {} numbers, expected 2", item.size()));
  return {item[0].number(), item[1].number()};
}

/// uv' = T R S uv, with the rotation from u to v (KHR_texture_transform).
GltfPlacement read_placement(const JsonItem& info) {
  GltfPlacement placement;
  if (const auto set = info.find("texCoord")) placement.set = gltf_integer(*set, kLargestNumber);
  const auto given = find_inside(info, {"extensions", "KHR_texture_transform"});
  if (!given) return placement;
  if (const auto set = given->find("texCoord")) {
    placement.set = gltf_integer(*set, kLargestNumber);
  }
  if (const auto offset = given->find("offset")) placement.transform.translate(read_pair(*offset));
  if (const auto rotation = given->find("rotation")) {
    placement.transform.rotate(Eigen::Rotation2Dd(-rotation->number()));
  }
  if (const auto scale = given->find("scale")) placement.transform.scale(read_pair(*scale));
  return placement;
}

}  // namespace

std::shared_ptr<const radiosity::TextureImage> GltfTextures::picture(const JsonItem& index) {
  const JsonItem image = document_.element("images", index);
  const auto number = static_cast<std::size_t>(index.number());
  const auto known = read_.find(number);
  if (known != read_.end()) return known->second;
  try {
    return read_.emplace(number, pictures_.decode(document_.image(image))).first->second;
  } catch (const radiosity::SceneError& error) {
    const std::string message = error.what();
    // What the document says has its place in it already.
    if (message.find("images[") != std::string::npos) throw;
    image.fail(message);
  }
}

GltfPlacement GltfTextures::read(const JsonItem& texture_info, radiosity::Material& material) {
  const JsonItem item = document_.element("textures", texture_info.at("index"));
  std::optional<JsonItem> sampler;
  if (const auto index = item.find("sampler")) {
    sampler.emplace(document_.element("samplers", *index));
  }
  Texture texture{.image = picture(item.at("source")),
                  .factor = material.reflectance,
                  .across = read_wrap(sampler, "wrapS"),
                  .down = read_wrap(sampler, "wrapT")};
  GltfPlacement placement = read_placement(texture_info);
  material.reflectance = texture_mean(texture).mean;
  material.texture = std::move(texture);
  return placement;
}

}  // namespace io
