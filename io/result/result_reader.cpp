#include "io/result/result_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "io/base/line_reader.h"
#include "io/result/bands_name.h"
#include "io/result/polydata_arrays.h"
#include "io/result/vtk_polydata.h"
#include "io/result/vtk_polydata_reader.h"

namespace io {
namespace {

using radiosity::Bands;
using radiosity::Index;
using radiosity::Method;
using radiosity::PatchMesh;
using radiosity::Solution;

constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();

void check_version(const PolydataArrays& arrays, const std::filesystem::path& path) {
  const auto version = arrays.field_integers("radiosity_version", {1, kLargest});
  if (!version) return;  // before there were versions
  if (version->size() != 1) fail(path, "array \"radiosity_version\" is not one number");
  if (version->front() > kResultVersion) {
    fail(path, fmt::format("was written by a newer version of this program (format {}, this one "
                           "reads {})",
                           version->front(), kResultVersion));
  }
}

/// Says all that a file of another program lacks at once.
void check_presence(const PolydataArrays& arrays, const std::filesystem::path& path) {
  std::vector<std::string> missing;
  for (const char* name : {"radiosity", "irradiance", "exitance", "reflectance", "radiosity_error",
                           "surface", "polygon"}) {
    if (!arrays.has_cell_array(name)) missing.push_back(fmt::format("cell array \"{}\"", name));
  }
  if (!arrays.field_texts("surface_names")) missing.emplace_back("field data \"surface_names\"");
  if (missing.empty()) return;
  fail(path, fmt::format("is no result of this program: it lacks {}", fmt::join(missing, ", ")));
}

/// The back of each patch: one of the same polygon with the same corners. -1 where there is none.
std::vector<std::int32_t> find_twins(const PatchMesh& mesh) {
  std::map<std::pair<std::int32_t, std::array<std::int32_t, 4>>, std::int32_t> open;
  std::vector<std::int32_t> twins(mesh.corners.size(), -1);
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    auto corners = mesh.corners[i];
    std::sort(corners.begin(), corners.end());
    const auto number = static_cast<std::int32_t>(i);
    const auto [place, is_new] = open.try_emplace({mesh.polygon[i], corners}, number);
    if (is_new) continue;
    const std::int32_t other = place->second;
    if (mesh.normal[i].dot(mesh.normal[other]) < 0) {
      twins[i] = other;
      twins[other] = number;
    }
  }
  return twins;
}

void check_twins(const PatchMesh& mesh, const std::filesystem::path& path) {
  for (std::size_t i = 0; i < mesh.twin.size(); ++i) {
    const std::int32_t twin = mesh.twin[i];
    if (twin < 0) continue;
    if (mesh.twin[twin] != static_cast<std::int32_t>(i) || twin == static_cast<std::int32_t>(i)) {
      fail(path, fmt::format("patch {} has the back {}, which has another one", i, twin));
    }
  }
}

PatchMesh read_mesh(const PolydataArrays& arrays, const std::filesystem::path& path) {
  PatchMesh mesh;
  mesh.vertices = arrays.points();
  mesh.surface_names = *arrays.field_texts("surface_names");
  const auto corners = arrays.corners();
  const auto n = static_cast<std::int64_t>(corners.size());
  const auto n_surfaces = static_cast<std::int64_t>(mesh.surface_names.size());
  const auto surface = arrays.cell_integers("surface", {0, n_surfaces - 1});
  const auto polygon = arrays.cell_integers("polygon", {0, kLargest});
  for (std::size_t i = 0; i < corners.size(); ++i) {
    mesh.add_patch(corners[i], surface[i], polygon[i]);
    if (!(mesh.area[i] > 0 && std::isfinite(mesh.area[i]))) {
      fail(path, fmt::format("patch {} has the area {} m²", i, mesh.area[i]));
    }
  }
  if (arrays.has_cell_array("family")) mesh.family = arrays.cell_integers("family", {-1, kLargest});
  mesh.twin =
      arrays.has_cell_array("twin") ? arrays.cell_integers("twin", {-1, n - 1}) : find_twins(mesh);
  check_twins(mesh, path);
  mesh.surface_two_sided.assign(mesh.surface_names.size(), false);
  if (const auto two_sided = arrays.field_integers("surface_two_sided", {0, 1})) {
    if (two_sided->size() != mesh.surface_names.size()) {
      fail(path, fmt::format("array \"surface_two_sided\" has {} values, but there are {} surfaces",
                             two_sided->size(), mesh.surface_names.size()));
    }
    mesh.surface_two_sided.assign(two_sided->begin(), two_sided->end());
  } else {
    for (std::size_t i = 0; i < mesh.twin.size(); ++i) {
      if (mesh.twin[i] >= 0) mesh.surface_two_sided[mesh.surface[i]] = true;
    }
  }
  return mesh;
}

/// Wavelengths of an array, in its unit, increasing; none if there is no array.
std::vector<double> read_wavelengths(const PolydataArrays& arrays, const char* name,
                                     const std::filesystem::path& path) {
  std::vector<double> wavelengths = arrays.field_values(name).value_or(std::vector<double>());
  double before = 0;
  for (const double wavelength : wavelengths) {
    if (!(wavelength > before && std::isfinite(wavelength))) {
      fail(path, fmt::format("array \"{}\" has {} after {}, expected increasing ones", name,
                             wavelength, before));
    }
    before = wavelength;
  }
  return wavelengths;
}

/// Bands of a file that does not tell them.
Bands guess_bands(Index n_bands, std::vector<std::string>& warnings) {
  if (n_bands == 1) return {.kind = Bands::Kind::grey, .wavelengths = {}};
  if (n_bands == 3) return {.kind = Bands::Kind::rgb, .wavelengths = {}};
  Bands bands{.kind = Bands::Kind::wavelengths, .wavelengths = {}};
  for (Index k = 1; k <= n_bands; ++k) bands.wavelengths.push_back(static_cast<double>(k));
  warnings.push_back(
      fmt::format("the file does not tell the wavelengths of its {} bands; they are shown as 1 to "
                  "{} nm, and photometric quantities mean nothing",
                  n_bands, n_bands));
  return bands;
}

Bands read_bands(const PolydataArrays& arrays, Index n_bands, const std::filesystem::path& path,
                 std::vector<std::string>& warnings) {
  const auto texts = arrays.field_texts("bands");
  if (!texts) return guess_bands(n_bands, warnings);
  const std::string name = texts->size() == 1 ? texts->front() : "";
  constexpr std::array kKinds = {Bands::Kind::grey, Bands::Kind::rgb, Bands::Kind::wavelengths,
                                 Bands::Kind::solar_infrared, Bands::Kind::thermal};
  const auto* const kind = std::find_if(kKinds.begin(), kKinds.end(),
                                        [&](Bands::Kind each) { return bands_name(each) == name; });
  if (kind == kKinds.end()) {
    fail(path, fmt::format("array \"bands\" has \"{}\", expected grey, rgb, wavelengths, "
                           "solar-infrared or thermal",
                           name));
  }
  Bands bands{.kind = *kind, .wavelengths = {}};
  if (*kind == Bands::Kind::wavelengths) {
    bands.wavelengths = read_wavelengths(arrays, "wavelengths", path);
    if (bands.count() != n_bands) {
      fail(path, fmt::format("array \"wavelengths\" has {} values, but there are {} bands",
                             bands.count(), n_bands));
    }
    return bands;
  }
  if (bands.hold_heat() && *kind != Bands::Kind::grey) {
    bands.edges = read_wavelengths(arrays, "band_edges", path);
  }
  if (bands.count() != n_bands) {
    fail(path, fmt::format("has {} values per patch, expected {} for {} bands", n_bands,
                           bands.count(), name));
  }
  return bands;
}

Eigen::MatrixXd read_fields(const PolydataArrays& arrays, const char* name, Index n_bands,
                            const std::filesystem::path& path) {
  Eigen::MatrixXd values = arrays.cell_values(name);
  if (values.cols() != n_bands) {
    fail(path, fmt::format("array \"{}\" has {} columns, but \"radiosity\" has {}", name,
                           values.cols(), n_bands));
  }
  return values;
}

Eigen::VectorXd read_energy(const PolydataArrays& arrays, const char* name, Index n_bands,
                            const Eigen::VectorXd& summed, const std::filesystem::path& path) {
  const auto stored = arrays.field_values(name);
  if (!stored) return summed;
  if (static_cast<Index>(stored->size()) != n_bands) {
    fail(path, fmt::format("array \"{}\" has {} values, but there are {} bands", name,
                           stored->size(), n_bands));
  }
  return Eigen::Map<const Eigen::VectorXd>(stored->data(), n_bands);
}

void read_energies(const PolydataArrays& arrays, const PatchMesh& mesh, Solution& solution,
                   const std::filesystem::path& path) {
  const Eigen::Map<const Eigen::VectorXd> area(mesh.area.data(), mesh.size());
  const Index n_bands = solution.radiosity.cols();
  const Eigen::VectorXd emitted = solution.exitance.transpose() * area;
  const Eigen::MatrixXd taken = (1 - solution.reflectance.array()) * solution.irradiance.array();
  const Eigen::VectorXd absorbed = taken.transpose() * area;
  solution.energy = {
      .emitted = read_energy(arrays, "energy_emitted", n_bands, emitted, path),
      .incident = read_energy(arrays, "energy_incident", n_bands, {}, path),
      .absorbed = read_energy(arrays, "energy_absorbed", n_bands, absorbed, path),
      .escaped = read_energy(arrays, "energy_escaped", n_bands, emitted - absorbed, path)};
}

Method read_method(const PolydataArrays& arrays, const std::filesystem::path& path) {
  const auto texts = arrays.field_texts("solve_method");
  if (!texts) return Method::conjugate_gradients;
  for (const Method method : {Method::conjugate_gradients, Method::jacobi, Method::gauss_seidel,
                              Method::southwell, Method::chebyshev, Method::external}) {
    if (texts->size() == 1 && texts->front() == method_name(method)) return method;
  }
  fail(path,
       fmt::format("array \"solve_method\" has \"{}\", which is none", fmt::join(*texts, " ")));
}

double read_number(const PolydataArrays& arrays, const char* name,
                   const std::filesystem::path& path) {
  const auto values = arrays.field_values(name);
  if (!values) return 0;
  if (values->size() != 1) fail(path, fmt::format("array \"{}\" is not one number", name));
  return values->front();
}

Solution read_solution(const PolydataArrays& arrays, const PatchMesh& mesh,
                       const std::filesystem::path& path) {
  Solution solution;
  solution.radiosity = arrays.cell_values("radiosity");
  const Index n_bands = solution.radiosity.cols();
  solution.irradiance = read_fields(arrays, "irradiance", n_bands, path);
  solution.exitance = read_fields(arrays, "exitance", n_bands, path);
  solution.reflectance = read_fields(arrays, "reflectance", n_bands, path);
  solution.radiosity_error = read_fields(arrays, "radiosity_error", n_bands, path);
  if (arrays.has_cell_array("surface_temperature")) {
    solution.temperature = read_fields(arrays, "surface_temperature", 1, path);
    if (!(solution.temperature.minCoeff() >= 0)) {
      fail(path, "array \"surface_temperature\" has values below 0 K");
    }
  }
  read_energies(arrays, mesh, solution, path);
  solution.method = read_method(arrays, path);
  const auto integer = [&](const char* name, std::int64_t high) {
    const auto values = arrays.field_integers(name, {0, high});
    return values && !values->empty() ? values->front() : 0;
  };
  solution.iterations = integer("solve_iterations", kLargest);
  solution.converged = integer("solve_converged", 1) == 1;
  solution.products = read_number(arrays, "solve_products", path);
  solution.residual = read_number(arrays, "solve_residual", path);
  solution.error_bound = read_number(arrays, "solve_error_bound", path);
  solution.transport_error_bound = read_number(arrays, "transport_error_bound", path);
  return solution;
}

std::optional<radiosity::Camera> read_camera(const PolydataArrays& arrays,
                                             const std::filesystem::path& path) {
  const auto numbers = arrays.field_values("camera");
  if (!numbers) return std::nullopt;
  if (numbers->size() != 10) fail(path, "array \"camera\" is not ten numbers");
  const auto vector = [&](std::size_t first) { return radiosity::Vec3(numbers->data() + first); };
  const radiosity::Camera camera = {.position = vector(0),
                                    .direction = vector(3),
                                    .up = vector(6),
                                    .vertical_fov = numbers->back()};
  const bool sees = camera.position.allFinite() && std::abs(camera.direction.norm() - 1) < 1e-6 &&
                    std::abs(camera.up.norm() - 1) < 1e-6 &&
                    camera.direction.cross(camera.up).norm() > 0 && camera.vertical_fov > 0 &&
                    camera.vertical_fov < radiosity::kPi;
  if (!sees) fail(path, "array \"camera\" is of one that sees nothing");
  return camera;
}

}  // namespace

StoredResult read_result(const std::filesystem::path& path) {
  const auto polydata = read_polydata(path);
  const PolydataArrays arrays(*polydata, path);
  check_version(arrays, path);
  check_presence(arrays, path);
  StoredResult result;
  result.mesh = read_mesh(arrays, path);
  result.solution = read_solution(arrays, result.mesh, path);
  result.bands = read_bands(arrays, result.solution.radiosity.cols(), path, result.warnings);
  result.camera = read_camera(arrays, path);
  return result;
}

}  // namespace io
