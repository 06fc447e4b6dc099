#include "io/result/view3d_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "io/base/atomic_file.h"
#include "radiosity/operator/surface_factors.h"

namespace io {
namespace {

/// What View3D takes emissivities to be, at least and at most.
constexpr double kLeastEmissivity = 0.001;
constexpr double kMostEmissivity = 0.999;

}  // namespace

void write_view3d(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                  const Eigen::MatrixXd& factors, const Eigen::VectorXd& emissivities) {
  const Eigen::VectorXd areas = radiosity::surface_areas(mesh);
  write_stream_atomically(path, [&](std::ofstream& stream) {
    // Text, of an enclosure, factors F rather than exchange factors.
    const std::string header = fmt::format("View3D 4.0.0 0 1 0 {}", factors.rows());
    stream << fmt::format("{:<30}\n", header);
    std::string line;
    const auto add = [&](const std::string& number) {
      if (!line.empty()) line += ' ';
      line += number;
    };
    const auto end_line = [&] {
      stream << line << '\n';
      line.clear();
    };
    for (const double area : areas) add(fmt::format("{:g}", area));
    end_line();
    for (Eigen::Index s = 0; s < factors.rows() && stream; ++s) {
      for (const double factor : factors.row(s)) add(fmt::format("{:.6f}", factor));
      end_line();
    }
    for (const double emissivity : emissivities) {
      add(fmt::format("{:.3f}", std::clamp(emissivity, kLeastEmissivity, kMostEmissivity)));
    }
    end_line();
  });
}

}  // namespace io
