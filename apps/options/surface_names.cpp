#include "apps/options/surface_names.h"

#include <algorithm>

#include "io/base/json_item.h"

namespace apps {

const std::string& nearest_surface(const radiosity::Scene& scene, const std::string& name) {
  return std::min_element(scene.surfaces.begin(), scene.surfaces.end(),
                          [&](const auto& a, const auto& b) {
                            return io::edit_distance(name, a.name) <
                                   io::edit_distance(name, b.name);
                          })
      ->name;
}

}  // namespace apps
