#include "io/result/surface_csv.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>

#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"
#include "radiosity/operator/surface_factors.h"

namespace io {

void write_surface_csv(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                       const Eigen::MatrixXd& factors) {
  const Eigen::VectorXd areas = radiosity::surface_areas(mesh);
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "surface,area";
    for (const std::string& name : mesh.surface_names) stream << ',' << csv_field(name);
    stream << ",unseen\n";
    for (Eigen::Index s = 0; s < factors.rows() && stream; ++s) {
      std::string row = fmt::format("{},{}", csv_field(mesh.surface_names[s]), areas[s]);
      for (const double factor : factors.row(s)) {
        fmt::format_to(std::back_inserter(row), ",{}", factor);
      }
      stream << row << fmt::format(",{}\n", 1 - factors.row(s).sum());
    }
  });
}

}  // namespace io
