#include "io/result/result_file.h"

#include <fmt/format.h>

#include <cassert>
#include <string>
#include <vector>

#include "io/base/extension.h"
#include "io/result/color_glb.h"
#include "io/result/color_ply.h"
#include "io/result/patch_csv.h"
#include "io/result/write_vtp.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

CornerColors shown_colors(const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
                          const ResultOptions& options) {
  const std::vector<double> wavelengths =
      options.bands ? options.bands->wavelengths : std::vector<double>();
  return options.quantities.empty()
             ? radiosity_colors(mesh, solution, wavelengths)
             : quantity_colors(mesh, options.quantities.front(), wavelengths);
}

}  // namespace

void write(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
           const radiosity::Solution& solution, const ResultOptions& options) {
  assert(solution.radiosity.rows() == mesh.size());
  const std::string extension = lower_case_extension(path);
  if (extension == ".vtp") {
    if (radiosity_io_write_vtp == nullptr) {
      throw radiosity::OutputError(fmt::format(
          "{}: this program was built without VTK, which .vtp files need; expected .csv, .ply or "
          ".glb",
          path.string()));
    }
    radiosity_io_write_vtp(path, mesh, solution, options.quantities, options.bands, options.camera);
  } else if (extension == ".csv") {
    write_patch_csv(path, mesh, solution, options.quantities);
  } else if (extension == ".ply") {
    write_color_ply(path, mesh, shown_colors(mesh, solution, options));
  } else if (extension == ".glb") {
    write_color_glb(path, mesh, shown_colors(mesh, solution, options), up_axis(options.camera));
  } else {
    throw radiosity::OutputError(
        fmt::format("{}: cannot write a result as '{}', expected .vtp, .csv, .ply or .glb",
                    path.string(), extension));
  }
}

}  // namespace io
