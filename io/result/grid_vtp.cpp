#include "io/result/grid_vtp.h"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/base/xml_escaped.h"

namespace io {
namespace {

using radiosity::GridLight;
using radiosity::GridQuantity;
using radiosity::Index;
using radiosity::kLightParts;
using radiosity::PointPlace;
using radiosity::Vec3;

/// Points, and cells of so many of them each.
struct Cells {
  std::vector<Vec3> points;
  std::vector<Index> corners;
  Index n_corners = 1;
};

Cells cells_of(const GridLight& light) {
  Cells cells;
  if (!light.where.grid) {
    cells.points = light.where.points;
    for (Index k = 0; k < light.where.size(); ++k) cells.corners.push_back(k);
    return cells;
  }
  const radiosity::PointGrid& grid = *light.where.grid;
  cells.n_corners = 4;
  for (Index r = 0; r <= grid.n_rows; ++r) {
    for (Index c = 0; c <= grid.n_columns; ++c) {
      cells.points.emplace_back(grid.corner + static_cast<double>(c) * grid.column +
                                static_cast<double>(r) * grid.row);
    }
  }
  const Index width = grid.n_columns + 1;
  for (Index k = 0; k < grid.size(); ++k) {
    const Index first = k / grid.n_columns * width + k % grid.n_columns;
    for (const Index corner : {first, first + 1, first + width + 1, first + width}) {
      cells.corners.push_back(corner);
    }
  }
  return cells;
}

class Writer {
 public:
  explicit Writer(std::ofstream& stream) : stream_(stream) {}

  template <typename Value>
  void array(const std::string& name, const char* type, Index n, int n_components,
             const Value& value) {
    stream_ << fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type,
        xml_escaped(name), n_components);
    for (Index k = 0; k < n; ++k) stream_ << fmt::format("{}\n", value(k));
    stream_ << "</DataArray>\n";
  }

  void light(const GridLight& light) {
    const Index n = light.where.size();
    const auto is_open = [&](Index k) {
      return light.places[static_cast<std::size_t>(k)] == PointPlace::open;
    };
    array("place", "Int32", n, 1,
          [&](Index k) { return static_cast<int>(light.places[static_cast<std::size_t>(k)]); });
    const Index n_lights = light.quantities.front().values.cols() / kLightParts;
    for (const GridQuantity& quantity : light.quantities) {
      for (Index k = 0; k < n_lights; ++k) {
        const std::string name = quantity.name + (k == 0 ? "" : "_maintained");
        const auto add = [&](const char* part, const Eigen::VectorXd& values) {
          array(name + part, "Float64", n, 1, [&](Index point) {
            return is_open(point) ? fmt::format("{}", values[point]) : std::string("nan");
          });
        };
        add("", quantity.total(k));
        add("_direct", quantity.part(k, radiosity::LightPart::direct));
        add("_indirect", quantity.part(k, radiosity::LightPart::indirect));
        add("_error", quantity.part(k, radiosity::LightPart::error));
      }
    }
  }

 private:
  std::ofstream& stream_;
};

}  // namespace

void write_grid_vtp(const std::filesystem::path& path, const GridLight& light) {
  const Cells cells = cells_of(light);
  const auto n_points = static_cast<Index>(cells.points.size());
  const Index n_cells = light.where.size();
  const char* kind = cells.n_corners == 1 ? "Verts" : "Polys";
  write_stream_atomically(path, [&](std::ofstream& stream) {
    Writer writer(stream);
    stream << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
              "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n";
    stream << fmt::format(
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n<Points>\n",
        n_points, cells.n_corners == 1 ? n_cells : 0, cells.n_corners == 1 ? 0 : n_cells);
    writer.array("Points", "Float64", n_points, 3, [&](Index k) {
      const Vec3& x = cells.points[static_cast<std::size_t>(k)];
      return fmt::format("{} {} {}", x[0], x[1], x[2]);
    });
    stream << "</Points>\n<" << kind << ">\n";
    writer.array("connectivity", "Int64", static_cast<Index>(cells.corners.size()), 1,
                 [&](Index k) { return cells.corners[static_cast<std::size_t>(k)]; });
    writer.array("offsets", "Int64", n_cells, 1,
                 [&](Index k) { return (k + 1) * cells.n_corners; });
    stream << "</" << kind << ">\n<CellData Scalars=\"illuminance\">\n";
    writer.light(light);
    stream << "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  });
}

}  // namespace io
