#include "io/result/form_factor_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "io/result/form_factor_file.h"
#include "io/result/hdf5_file.h"
#include "io/result/hdf5_input.h"
#include "io/result/hdf5_patches.h"
#include "io/result/hdf5_report.h"

namespace io {
namespace {

using hdf5::checked;
using hdf5::Dataset;
using hdf5::Handle;
using hdf5::has_dataset;
using hdf5::HdfError;
using hdf5::read_all;
using hdf5::read_attribute;
using hdf5::read_slice;
using hdf5::require_numbers;
using radiosity::Index;
using radiosity::PatchMesh;

constexpr auto kRequired = std::to_array<const char*>(
    {"patches/area", "patches/centroid", "patches/normal", "patches/surface", "patches/polygon",
     "surfaces/name", "closure", "form_factors/data", "form_factors/error", "form_factors/indices",
     "form_factors/indptr"});

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

}  // namespace

struct FormFactorReader::File {
  explicit File(const std::filesystem::path& name)
      : path(name), file(hdf5::open_file(name, "a form-factor file")) {
    hdf5::check_version(file, "form-factor file", kFormFactorVersion, kRequired);
    data = std::make_unique<Dataset>(file, "form_factors/data");
    error = std::make_unique<Dataset>(file, "form_factors/error");
    indices = std::make_unique<Dataset>(file, "form_factors/indices");
    mesh = hdf5::read_mesh(file, warnings);
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
    fingerprint = hdf5::find_text_attribute(file, "fingerprint").value_or("");
    geometry = hdf5::find_text_attribute(file, "geometry").value_or("");
    if (has_dataset(file, "row_sums")) {
      const auto own = read_all<double>(file, "row_sums", {n});
      row_sums = Eigen::Map<const Eigen::VectorXd>(own.data(), mesh.size());
    }
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

  [[nodiscard]] Eigen::VectorXd sums() const {
    if (row_sums) return *row_sums;
    Eigen::VectorXd result(mesh.size());
    for (Index i = 0; i < mesh.size(); ++i) result[i] = row(i, *data).sum();
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
  std::string geometry;
  std::optional<Eigen::VectorXd> row_sums;
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
const std::string& FormFactorReader::geometry() const { return file_->geometry; }
Eigen::VectorXd FormFactorReader::row_sums() const {
  return checked(file_->path, [&] { return file_->sums(); });
}
radiosity::AssemblyReport FormFactorReader::report() const {
  return checked(file_->path, [&] {
    if (!has_dataset(file_->file, "covered")) {
      throw HdfError("was written before form factors could be used again; make it anew");
    }
    return hdf5::read_report(file_->file, size());
  });
}
const std::vector<std::string>& FormFactorReader::warnings() const { return file_->warnings; }

}  // namespace io
