#include "io/result/color_ply.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/picture/color_map.h"
#include "io/picture/tone_mapping.h"
#include "io/result/colored_mesh.h"
#include "radiosity/scene/corner_values.h"

namespace io {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Solution;

/// Exposure for the light that surfaces reflect; what emits by itself may become white.
double reflected_light_exposure(const Solution& solution, const std::vector<double>& wavelengths) {
  std::vector<Index> reflecting;
  for (Index i = 0; i < solution.radiosity.rows(); ++i) {
    if ((solution.exitance.row(i).array() == 0).all()) reflecting.push_back(i);
  }
  if (reflecting.empty())
    return automatic_exposure(display_colors(solution.radiosity.cast<float>(), wavelengths));
  const Eigen::MatrixXd values = solution.radiosity(reflecting, Eigen::all);
  return automatic_exposure(display_colors(values.cast<float>(), wavelengths));
}

template <typename T>
void put(std::ostream& stream, T value) {
  static_assert(std::endian::native == std::endian::little, "the PLY header says little endian");
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  stream.write(bytes.data(), sizeof(T));
}

}  // namespace

CornerColors radiosity_colors(const PatchMesh& mesh, const Solution& solution,
                              const std::vector<double>& wavelengths) {
  const double exposure = reflected_light_exposure(solution, wavelengths);
  const Eigen::MatrixX3f linear =
      display_colors(radiosity::corner_values(mesh, solution.radiosity).cast<float>(), wavelengths);
  CornerColors colors;
  for (Index k = 0; k < linear.rows(); ++k) colors.push_back(srgb_bytes(linear.row(k), exposure));
  return colors;
}

CornerColors quantity_colors(const PatchMesh& mesh, const radiosity::QuantityField& quantity,
                             const std::vector<double>& wavelengths) {
  const Eigen::VectorXd values = quantity.info.is_photometric
                                     ? Eigen::VectorXd(quantity.values.col(0))
                                     : radiosity::mean_over_bands(quantity.values, wavelengths);
  const ColorScale scale = fitting_scale(values, false);
  CornerColors colors;
  const Eigen::MatrixXd corners = radiosity::corner_values(mesh, values);
  for (const double value : corners.col(0)) {
    colors.push_back(map_color(position_on(scale, value)));
  }
  return colors;
}

void write_color_ply(const std::filesystem::path& path, const PatchMesh& mesh,
                     const CornerColors& colors) {
  const ColoredMesh colored = color_corners(mesh, colors);
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment radiosity, sRGB vertex colours, metres\n"
        "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        colored.vertices.size(), colored.corners.size());
    for (const ColoredMesh::Vertex& vertex : colored.vertices) {
      for (const double x : mesh.vertices[vertex.vertex]) put(stream, static_cast<float>(x));
      for (const std::uint8_t c : vertex.color) put(stream, c);
    }
    for (Index i = 0; i < mesh.size(); ++i) {
      put(stream, static_cast<std::uint8_t>(mesh.n_corners(i)));
      for (int k = 0; k < mesh.n_corners(i); ++k) put(stream, colored.corners[i][k]);
    }
  });
}

}  // namespace io
