#include "io/result/grid_csv.h"

#include <fmt/format.h>

#include <fstream>

#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"

namespace io {
namespace {

using radiosity::GridLight;
using radiosity::GridQuantity;
using radiosity::Index;
using radiosity::kLightParts;
using radiosity::PointPlace;

const char* name_of(PointPlace place) {
  if (place == PointPlace::inside) return "inside";
  return place == PointPlace::open ? "open" : "outside";
}

Index n_lights(const GridLight& light) {
  return light.quantities.front().values.cols() / kLightParts;
}

std::string header(const GridLight& light) {
  std::string text = "x,y,z,normal_x,normal_y,normal_z,place";
  for (const GridQuantity& quantity : light.quantities) {
    for (Index k = 0; k < n_lights(light); ++k) {
      const std::string name = quantity.name + (k == 0 ? "" : "_maintained");
      for (const char* part : {"", "_direct", "_indirect", "_error"}) {
        text += "," + csv_field(name + part);
      }
    }
  }
  return text + '\n';
}

std::string row(const GridLight& light, Index point) {
  const auto i = static_cast<std::size_t>(point);
  const radiosity::Vec3& x = light.where.points[i];
  const radiosity::Vec3& n = light.where.normals[i];
  const bool is_open = light.places[i] == PointPlace::open;
  std::string text = fmt::format("{},{},{},{},{},{},{}", x[0], x[1], x[2], n[0], n[1], n[2],
                                 name_of(light.places[i]));
  for (const GridQuantity& quantity : light.quantities) {
    for (Index k = 0; k < n_lights(light); ++k) {
      if (!is_open) {
        text += ",,,,";
        continue;
      }
      const auto parts = quantity.values.row(point).segment<kLightParts>(kLightParts * k);
      text += fmt::format(",{},{},{},{}", parts[0] + parts[1], parts[0], parts[1], parts[2]);
    }
  }
  return text + '\n';
}

}  // namespace

void write_grid_csv(const std::filesystem::path& path, const GridLight& light) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << header(light);
    for (Index k = 0; k < light.where.size() && stream; ++k) stream << row(light, k);
  });
}

}  // namespace io
