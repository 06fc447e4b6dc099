#include "io/scene/json_glazing.h"

#include <fmt/format.h>

#include <vector>

#include "io/scene/json_materials.h"
#include "io/scene/scene_keys.h"

namespace io {
namespace {

using radiosity::Glazing;

void refuse_all_but_transmittance(const JsonItem& item) {
  if (item.value().size() == 1) return;
  item.fail("has a \"transmittance\" at all angles, with which nothing else goes");
}

}  // namespace

Glazing read_glazing(const JsonItem& item, const radiosity::Bands& bands,
                     const std::filesystem::path& folder) {
  item.check_keys(keys::kGlazing);
  Glazing glazing;
  if (const auto transmittance = item.find("transmittance")) {
    refuse_all_but_transmittance(item);
    glazing.transmittance = read_reflectances(*transmittance, bands, folder);
    return glazing;
  }
  const auto index = item.find("refractive_index");
  if (!index) item.fail("expected either \"transmittance\" or \"refractive_index\"");
  glazing.refractive_index = index->number();
  if (!(glazing.refractive_index > 1)) {
    index->fail(fmt::format("is {}, expected more than 1", glazing.refractive_index));
  }
  const bool is_by_thickness = item.has("thickness") || item.has("absorption");
  if (item.has("internal_transmittance") == is_by_thickness) {
    item.fail(
        "expected either \"internal_transmittance\" or \"thickness\" and \"absorption\" beside "
        "\"refractive_index\"");
  }
  if (!is_by_thickness) {
    glazing.transmittance = read_reflectances(item.at("internal_transmittance"), bands, folder);
    if (const auto by_thickness = item.find("by_thickness")) {
      glazing.is_by_thickness = by_thickness->boolean();
    }
    return glazing;
  }
  const double thickness = item.at("thickness").number();
  if (!(thickness > 0)) {
    item.at("thickness").fail(fmt::format("is {} m, expected more than 0", thickness));
  }
  const Eigen::VectorXd absorption =
      read_band_values(item.at("absorption"), "absorption", bands, folder);
  glazing.is_by_thickness = true;
  glazing.transmittance = (-thickness * absorption.array()).exp();
  return glazing;
}

void add_glazing(const JsonItem& materials, const std::filesystem::path& folder,
                 radiosity::Scene& scene) {
  std::vector<JsonItem> items;
  if (materials.value().is_object()) {
    for (const auto& [name, unused] : materials.value().items())
      items.push_back(materials.at(name));
  } else {
    for (std::size_t k = 0; k < materials.size(); ++k) items.push_back(materials[k]);
  }
  for (std::size_t k = 0; k < items.size(); ++k) {
    const auto glazing = items[k].find("glazing");
    if (glazing) scene.materials[k].glazing = read_glazing(*glazing, scene.bands, folder);
  }
}

}  // namespace io
