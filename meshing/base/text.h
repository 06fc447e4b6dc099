#pragma once

#include <string>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// A measure for a message, four digits: "0.0032", "1.5e-07".
std::string number(double value);

/// A point for a message: "(0.5, 0, 1.2)".
std::string place(const radiosity::Vec3& point);

/// "surface 'floor', polygon 12" for messages.
std::string polygon_name(const radiosity::Scene& scene, radiosity::Index polygon);

/// "room.obj: " if the scene has a source, else nothing.
std::string source_prefix(const radiosity::Scene& scene);

}  // namespace meshing
