#include "apps/run/factor_outputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Error.hpp>
#include <algorithm>
#include <filesystem>

#include "apps/run/factor_table.h"
#include "apps/terminal/output_files.h"
#include "io/base/extension.h"
#include "io/result/elmer_factors.h"
#include "io/result/energyplus_factors.h"
#include "io/result/foam_factors.h"
#include "radiosity/operator/polygon_rows.h"

namespace apps {
namespace {

/// Whether a file of this name can have the format that is asked for.
bool goes_with(const std::string& path, const std::string& asked) {
  const std::string extension = io::lower_case_extension(path);
  if (asked == "moose") return extension == ".csv";
  if (asked == "energyplus") return extension == ".idf" || extension == ".epjson";
  if (asked == "openfoam") return is_foam_file(path);
  return extension == ".dat";
}

}  // namespace

std::vector<std::string> all_factor_outputs(const std::vector<std::string>& outputs,
                                            const std::string& asked) {
  const bool is_used = std::any_of(outputs.begin(), outputs.end(), [&](const std::string& output) {
    return goes_with(output, asked);
  });
  if (!asked.empty() && !is_used) {
    throw CLI::ValidationError(
        "--format", fmt::format("no output is of {}: that takes a file name ending in {}", asked,
                                asked == "moose"        ? ".csv"
                                : asked == "openfoam"   ? "F"
                                : asked == "energyplus" ? ".idf or .epJSON"
                                                        : ".dat"));
  }
  std::vector<std::string> all = outputs;
  for (const std::string& output : outputs) {
    if (!is_foam_file(output)) continue;
    for (const auto& beside : io::foam_companions(output)) all.push_back(beside.string());
  }
  return all;
}

void check_factor_outputs(const std::vector<std::string>& outputs, const std::string& asked,
                          const radiosity::Scene& scene, const radiosity::PatchMesh& mesh) {
  for (const std::string& output : outputs) {
    const FactorFormat format = factor_format(output, asked);
    if (is_by_polygon(format)) (void)radiosity::PolygonRows(mesh, {});
    if (format == FactorFormat::openfoam) {
      io::check_foam_case(output, radiosity::n_polygons(mesh));
    }
    if (format == FactorFormat::energyplus) {
      io::check_energyplus_names(output, zone_factors(scene, mesh, {}));
    }
  }
}

void write_polygon_factors(const std::string& path, FactorFormat format,
                           const radiosity::PatchMesh& mesh,
                           const std::function<void(const radiosity::RowVisitor&)>& visit) {
  const io::ElementRows rows{
      .n_elements = radiosity::n_polygons(mesh),
      .visit = [&](const io::ElementRows::Visitor& each) {
        radiosity::PolygonRows sums(mesh, each);
        visit([&](radiosity::Index i, const Eigen::VectorXd& row,
                  const Eigen::VectorXd& /*error*/) { sums.add_row(i, row); });
      }};
  if (format == FactorFormat::openfoam) {
    io::write_foam_factors(path, rows);
  } else {
    io::write_elmer_factors(
        path, rows,
        format == FactorFormat::elmer_binary ? io::ElmerFile::binary : io::ElmerFile::text);
  }
}

}  // namespace apps
