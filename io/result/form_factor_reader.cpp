#include "io/result/form_factor_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "io/base/line_reader.h"
#include "io/result/form_factor_file.h"
#include "io/result/hdf5_file.h"
#include "io/result/hdf5_input.h"

namespace io {
namespace {

using hdf5::Dataset;
using hdf5::Handle;
using hdf5::has_dataset;
using hdf5::HdfError;
using hdf5::read_all;
using hdf5::read_attribute;
using hdf5::read_names;
using hdf5::read_slice;
using hdf5::require_numbers;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

/// How far the area of a patch's corners may be from the one stored, as a share of it. Both were
/// worked out by the same sums.
constexpr double kAreaTolerance = 1e-6;

constexpr auto kRequired = std::to_array<const char*>(
    {"patches/area", "patches/centroid", "patches/normal", "patches/surface", "patches/polygon",
     "surfaces/name", "closure", "form_factors/data", "form_factors/error", "form_factors/indices",
     "form_factors/indptr"});

Vec3 vector_at(const std::vector<double>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

void add_corner_patches(hid_t file, const std::vector<std::int32_t>& surface,
                        const std::vector<std::int32_t>& polygon, PatchMesh& mesh) {
  const hsize_t n = surface.size();
  const hsize_t n_vertices = Dataset(file, "vertices").shape[0];
  const auto vertices = read_all<double>(file, "vertices", {n_vertices, 3});
  const auto corners = read_all<std::int32_t>(file, "patches/corners", {n, 4});
  for (std::size_t i = 0; i < n_vertices; ++i) mesh.vertices.push_back(vector_at(vertices, i));
  for (std::size_t i = 0; i < n; ++i) {
    std::array<std::int32_t, 4> patch{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t corner = corners[4 * i + k];
      const std::int32_t least = k == 3 ? -1 : 0;
      if (corner < least || (corner >= 0 && static_cast<hsize_t>(corner) >= n_vertices)) {
        throw HdfError(
            fmt::format("patch {} uses vertex {}, but there are {}", i, corner, n_vertices));
      }
      patch[k] = corner;
    }
    mesh.add_patch(patch, surface[i], polygon[i]);
  }
}

void add_square_patches(hid_t file, const std::vector<double>& area,
                        const std::vector<std::int32_t>& surface,
                        const std::vector<std::int32_t>& polygon, PatchMesh& mesh) {
  const hsize_t n = surface.size();
  const auto centroids = read_all<double>(file, "patches/centroid", {n, 3});
  const auto normals = read_all<double>(file, "patches/normal", {n, 3});
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 center = vector_at(centroids, i);
    const Vec3 normal = vector_at(normals, i);
    if (!(std::abs(normal.norm() - 1) < kAreaTolerance)) {
      throw HdfError(fmt::format("patch {} has no unit normal", i));
    }
    const Vec3 u = std::sqrt(area[i]) / 2 * normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vec3& offset : {Vec3(-u - v), Vec3(u - v), Vec3(u + v), Vec3(v - u)}) {
      mesh.vertices.push_back(center + offset);
    }
    mesh.add_patch({first, first + 1, first + 2, first + 3}, surface[i], polygon[i]);
    mesh.area.back() = area[i];
    mesh.normal.back() = normal;
    mesh.centroid.back() = center;
  }
}

void read_sides(hid_t file, PatchMesh& mesh) {
  mesh.surface_two_sided.assign(mesh.surface_names.size(), false);
  if (has_dataset(file, "patches/twin")) {
    mesh.twin = read_all<std::int32_t>(file, "patches/twin", {mesh.twin.size()});
  }
  const auto n = static_cast<std::int32_t>(mesh.size());
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t twin = mesh.twin[i];
    if (twin < 0) continue;
    if (twin >= n || twin == i || mesh.twin[twin] != i) {
      throw HdfError(fmt::format("patch {} has the back {}, which has another one", i, twin));
    }
    mesh.surface_two_sided[mesh.surface[i]] = true;
  }
  if (!has_dataset(file, "surfaces/two_sided")) return;
  const auto two_sided =
      read_all<std::int32_t>(file, "surfaces/two_sided", {mesh.surface_names.size()});
  mesh.surface_two_sided.assign(two_sided.begin(), two_sided.end());
}

void check_patches(const PatchMesh& mesh, const std::vector<double>& area) {
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (!(std::abs(mesh.area[i] - area[i]) <= kAreaTolerance * area[i])) {
      throw HdfError(
          fmt::format("patch {} has an area of {} m² by its corners, {} by /patches/area", i,
                      mesh.area[i], area[i]));
    }
  }
}

PatchMesh read_mesh(hid_t file, std::vector<std::string>& warnings) {
  PatchMesh mesh;
  mesh.surface_names = read_names(file, "surfaces/name");
  const hsize_t n = Dataset(file, "patches/area").shape[0];
  if (n == 0 || n > static_cast<hsize_t>(std::numeric_limits<std::int32_t>::max())) {
    throw HdfError(fmt::format("has {} patches", n));
  }
  const auto area = read_all<double>(file, "patches/area", {n});
  const auto surface = read_all<std::int32_t>(file, "patches/surface", {n});
  const auto polygon = read_all<std::int32_t>(file, "patches/polygon", {n});
  for (std::size_t i = 0; i < n; ++i) {
    if (!(area[i] > 0)) throw HdfError(fmt::format("patch {} has the area {} m²", i, area[i]));
    if (surface[i] < 0 || static_cast<std::size_t>(surface[i]) >= mesh.surface_names.size()) {
      throw HdfError(fmt::format("patch {} is of surface {}, but there are {}", i, surface[i],
                                 mesh.surface_names.size()));
    }
    if (polygon[i] < 0) throw HdfError(fmt::format("patch {} is of polygon {}", i, polygon[i]));
  }
  if (has_dataset(file, "patches/corners") && has_dataset(file, "vertices")) {
    add_corner_patches(file, surface, polygon, mesh);
    check_patches(mesh, area);
  } else {
    add_square_patches(file, area, surface, polygon, mesh);
    warnings.emplace_back(
        "the file does not have the corners of the patches; each is shown as a square of its area");
  }
  read_sides(file, mesh);
  return mesh;
}

void check_version(hid_t file) {
  std::vector<std::string> missing;
  if (H5Aexists(file, "version") > 0) {
    const auto version = read_attribute<std::int64_t>(file, "version");
    if (version > kFormFactorVersion) {
      throw HdfError(fmt::format(
          "was written by a newer version of this program (format {}, this one reads {})", version,
          kFormFactorVersion));
    }
  } else {
    missing.emplace_back("attribute \"version\"");
  }
  for (const char* name : kRequired) {
    if (!has_dataset(file, name)) missing.push_back(fmt::format("/{}", name));
  }
  if (missing.empty()) return;
  throw HdfError(
      fmt::format("is no form-factor file of this program: it lacks {}", fmt::join(missing, ", ")));
}

/// Where each row starts in the list of entries, and their number.
std::vector<std::int64_t> read_row_starts(hid_t file, hsize_t n, hsize_t n_entries) {
  auto starts = read_all<std::int64_t>(file, "form_factors/indptr", {n + 1});
  for (std::size_t i = 0; i < n; ++i) {
    // Compared without a difference, which the file's numbers could make overflow.
    if (starts[i] < 0 || starts[i + 1] < starts[i] ||
        starts[i + 1] > static_cast<std::int64_t>(n_entries)) {
      throw HdfError(fmt::format("row {} lies outside the list of entries", i));
    }
  }
  if (starts.front() != 0 || starts.back() != static_cast<std::int64_t>(n_entries)) {
    throw HdfError("the rows do not make up the list of entries");
  }
  return starts;
}

std::string read_fingerprint_of(const std::filesystem::path& path) {
  return read_fingerprint(path).value_or("");
}

Handle open_file(const std::filesystem::path& path) {
  (void)input_size(path);
  hdf5::prepare_library();
  if (H5Fis_hdf5(path.c_str()) <= 0) throw HdfError("is not a form-factor file (HDF5)");
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) throw HdfError("is cut off or damaged: HDF5 cannot open it");
  return {id, H5Fclose};
}

/// Does `action`; what goes wrong becomes a SceneError that names the file.
template <typename Action>
auto checked(const std::filesystem::path& path, const Action& action) {
  try {
    return action();
  } catch (const HdfError& error) {
    fail(path, error.what());
  } catch (const std::bad_alloc&) {
    fail(path, "is damaged, or needs more memory than there is");
  } catch (const std::length_error&) {
    fail(path, "is damaged: it holds less than it says");
  }
}

}  // namespace

struct FormFactorReader::File {
  explicit File(const std::filesystem::path& name) : path(name), file(open_file(name)) {
    check_version(file);
    data = std::make_unique<Dataset>(file, "form_factors/data");
    error = std::make_unique<Dataset>(file, "form_factors/error");
    indices = std::make_unique<Dataset>(file, "form_factors/indices");
    mesh = read_mesh(file, warnings);
    const auto n = static_cast<hsize_t>(mesh.size());
    const hsize_t n_entries = data->shape[0];
    for (const Dataset* entries : {data.get(), error.get(), indices.get()}) {
      entries->require_shape({n_entries});
    }
    require_numbers<double>(*data);
    require_numbers<double>(*error);
    require_numbers<std::int64_t>(*indices);
    row_starts = read_row_starts(file, n, n_entries);
    const auto sums = read_all<double>(file, "closure", {n});
    closure = Eigen::Map<const Eigen::VectorXd>(sums.data(), mesh.size());
    tolerance = read_attribute<double>(file, "tolerance");
    min_factor = read_attribute<double>(file, "min_factor");
    closed = read_attribute<std::int32_t>(file, "closed") != 0;
    fingerprint = read_fingerprint_of(name);
  }

  /// Reads all entries, which throws where they are damaged.
  void check_entries() const {
    constexpr hsize_t kAtOnce = 1 << 20;
    const hsize_t n_entries = data->shape[0];
    for (hsize_t first = 0; first < n_entries; first += kAtOnce) {
      const hsize_t n = std::min(kAtOnce, n_entries - first);
      for (const Dataset* values : {data.get(), error.get()}) {
        (void)read_slice<double>(*values, first, n);
      }
      (void)read_slice<std::int64_t>(*indices, first, n);
    }
  }

  [[nodiscard]] Eigen::VectorXd row(Index i, const Dataset& values) const {
    assert(i >= 0 && i < mesh.size());
    hdf5::prepare_library();  // whether errors are printed is a setting of each thread
    const auto first = static_cast<hsize_t>(row_starts[i]);
    const auto n = static_cast<hsize_t>(row_starts[i + 1]) - first;
    const auto columns = read_slice<std::int64_t>(*indices, first, n);
    const auto entries = read_slice<double>(values, first, n);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(mesh.size());
    for (std::size_t k = 0; k < n; ++k) {
      if (columns[k] < 0 || columns[k] >= mesh.size()) {
        throw HdfError(fmt::format("row {} has an entry in column {}, but there are {} patches", i,
                                   columns[k], mesh.size()));
      }
      if (!(std::isfinite(entries[k]) && entries[k] >= 0)) {
        throw HdfError(
            fmt::format("row {} has the entry {} in column {}", i, entries[k], columns[k]));
      }
      result[columns[k]] = entries[k];
    }
    return result;
  }

  std::filesystem::path path;
  Handle file;
  std::unique_ptr<Dataset> data;
  std::unique_ptr<Dataset> error;
  std::unique_ptr<Dataset> indices;
  PatchMesh mesh;
  std::vector<std::int64_t> row_starts;
  Eigen::VectorXd closure;
  double tolerance = 0;
  double min_factor = 0;
  bool closed = false;
  std::string fingerprint;
  std::vector<std::string> warnings;
};

FormFactorReader::FormFactorReader(const std::filesystem::path& path)
    : file_(checked(path, [&] { return std::make_unique<File>(path); })) {}
FormFactorReader::~FormFactorReader() = default;
FormFactorReader::FormFactorReader(FormFactorReader&& other) noexcept = default;
FormFactorReader& FormFactorReader::operator=(FormFactorReader&& other) noexcept = default;

Eigen::VectorXd FormFactorReader::row(Index i) const {
  return checked(file_->path, [&] { return file_->row(i, *file_->data); });
}

Eigen::VectorXd FormFactorReader::row_error(Index i) const {
  return checked(file_->path, [&] { return file_->row(i, *file_->error); });
}

radiosity::ExchangeArea FormFactorReader::pair(Index i, Index j) const {
  const double area = mesh().area[i];
  const double error = area * row_error(i)[j];
  return {area * row(i)[j], error, error == 0};
}

void FormFactorReader::check_entries() const {
  checked(file_->path, [&] { file_->check_entries(); });
}

bool has_intact_form_factors(const std::filesystem::path& path) {
  try {
    FormFactorReader(path).check_entries();
    return true;
  } catch (const radiosity::SceneError&) {
    return false;
  }
}

const PatchMesh& FormFactorReader::mesh() const { return file_->mesh; }
const Eigen::VectorXd& FormFactorReader::closure() const { return file_->closure; }
double FormFactorReader::tolerance() const { return file_->tolerance; }
double FormFactorReader::min_factor() const { return file_->min_factor; }
bool FormFactorReader::closed() const { return file_->closed; }
const std::string& FormFactorReader::fingerprint() const { return file_->fingerprint; }
const std::vector<std::string>& FormFactorReader::warnings() const { return file_->warnings; }

}  // namespace io
