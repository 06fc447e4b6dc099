#include "io/mesh/surface_index.h"

namespace io {

std::int32_t SurfaceIndex::find_or_add(const std::string& object, int material,
                                       const std::string& wanted) {
  const auto [entry, is_new] = surfaces_.try_emplace(
      {object, material, wanted}, static_cast<std::int32_t>(scene_.surfaces.size()));
  if (!is_new) return entry->second;

  const std::string material_name = material < 0 ? wanted : scene_.materials[material].name;
  std::string name = object;
  if (name.empty()) name = material_name.empty() ? default_name_ : material_name;
  if (names_.contains(name) && !material_name.empty()) name += ":" + material_name;
  name = unused_name(name);
  names_.insert(name);
  scene_.surfaces.push_back({.name = name, .material = material, .two_sided = false});
  return entry->second;
}

std::string SurfaceIndex::unused_name(const std::string& wanted) {
  if (!names_.contains(wanted)) return wanted;
  // Counted on from the last time, or many equal names would take the square of their number.
  int& number = last_number_.try_emplace(wanted, 1).first->second;
  std::string name;
  do {
    name = wanted + "-" + std::to_string(++number);
  } while (names_.contains(name));
  return name;
}

}  // namespace io
