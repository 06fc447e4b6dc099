#include "meshing/base/text.h"

#include <sstream>

namespace meshing {

std::string number(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

std::string place(const radiosity::Vec3& point) {
  std::ostringstream out;
  out.precision(6);
  out << '(' << point.x() << ", " << point.y() << ", " << point.z() << ')';
  return out.str();
}

std::string polygon_name(const radiosity::Scene& scene, radiosity::Index polygon) {
  return "surface '" + scene.surfaces[scene.polygon_surface[polygon]].name + "', polygon " +
         std::to_string(polygon);
}

std::string source_prefix(const radiosity::Scene& scene) {
  return scene.source.empty() ? std::string() : scene.source + ": ";
}

}  // namespace meshing
