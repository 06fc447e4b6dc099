#include "io/result/patch_csv.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"

namespace io {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Solution;

using radiosity::QuantityField;

std::string csv_header(Index n_bands, bool is_heat, const std::vector<QuantityField>& quantities) {
  std::string header = "patch,surface,polygon,x,y,z,area";
  const auto add_bands = [&](std::string_view quantity) {
    for (Index band = 0; band < n_bands; ++band) {
      fmt::format_to(std::back_inserter(header), ",{}_{}", quantity, band);
    }
  };
  for (const char* quantity : {"B", "H", "error", "net"}) add_bands(quantity);
  if (is_heat) header += ",T";
  for (const QuantityField& quantity : quantities) {
    if (quantity.info.is_photometric) {
      header += fmt::format(",{}", quantity.info.column);
    } else {
      add_bands(quantity.info.column);
    }
  }
  return header + '\n';
}

}  // namespace

void write_patch_csv(const std::filesystem::path& path, const PatchMesh& mesh,
                     const Solution& solution, const std::vector<QuantityField>& quantities) {
  std::vector<std::string> names;
  for (const std::string& name : mesh.surface_names) names.push_back(csv_field(name));
  const Eigen::MatrixXd net_flux = solution.net_flux();
  const Eigen::MatrixXd temperature = solution.temperature;
  std::vector<const Eigen::MatrixXd*> columns = {&solution.radiosity, &solution.irradiance,
                                                 &solution.radiosity_error, &net_flux};
  if (temperature.size() > 0) columns.push_back(&temperature);
  for (const QuantityField& quantity : quantities) columns.push_back(&quantity.values);

  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << csv_header(solution.radiosity.cols(), temperature.size() > 0, quantities);
    fmt::memory_buffer row;
    for (Index i = 0; i < mesh.size() && stream; ++i) {
      row.clear();
      const auto out = std::back_inserter(row);
      const radiosity::Vec3& x = mesh.centroid[i];
      fmt::format_to(out, "{},{},{},{},{},{},{}", i, names[mesh.surface[i]], mesh.polygon[i], x[0],
                     x[1], x[2], mesh.area[i]);
      for (const Eigen::MatrixXd* values : columns) {
        for (Index band = 0; band < values->cols(); ++band) {
          fmt::format_to(out, ",{}", (*values)(i, band));
        }
      }
      row.push_back('\n');
      stream.write(row.data(), static_cast<std::streamsize>(row.size()));
    }
  });
}

}  // namespace io
