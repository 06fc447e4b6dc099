#include "io/result/form_factor_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/result/hdf5_file.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using hdf5::Handle;
using hdf5::HdfError;
using hdf5::type_of;
using radiosity::Index;

constexpr const char* kFingerprint = "fingerprint";
/// Entries that are collected before they are written.
constexpr hsize_t kChunk = 1 << 16;
/// What of other datasets has one checksum; larger ones have several.
constexpr hsize_t kChunkBytes = 1 << 20;
constexpr std::size_t kMostNameBytes = 1 << 30;

void require(herr_t status) {
  if (status < 0) throw HdfError("HDF5 cannot write (is the disk full?)");
}

/// How datasets are made: without the time, so that equal content makes equal files.
Handle dataset_properties() {
  Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (H5Pset_obj_track_times(properties, 0) < 0) throw HdfError("HDF5 is too old");
  return properties;
}

/// The same for a dataset of values of so many bytes, in chunks with checksums (Fletcher32), so
/// that damage is noticed. `shape` has no zero.
Handle checked_properties(std::vector<hsize_t> shape, std::size_t bytes) {
  Handle properties = dataset_properties();
  hsize_t row = 1;
  for (std::size_t k = 1; k < shape.size(); ++k) row *= shape[k];
  shape[0] = std::clamp<hsize_t>(kChunkBytes / std::max<hsize_t>(row * bytes, 1), 1, shape[0]);
  require(H5Pset_chunk(properties, static_cast<int>(shape.size()), shape.data()));
  require(H5Pset_fletcher32(properties));
  return properties;
}

Handle checked_properties_or_none(const std::vector<hsize_t>& shape, std::size_t bytes) {
  const bool is_empty = std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end();
  return is_empty ? dataset_properties() : checked_properties(shape, bytes);
}

Handle make_group(hid_t file, const char* name) {
  const Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  require(H5Pset_obj_track_times(properties, 0));
  return {H5Gcreate2(file, name, H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose};
}

template <typename T>
void write_dataset(hid_t file, const char* name, const std::vector<T>& values,
                   const std::vector<hsize_t>& shape) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle properties = checked_properties_or_none(shape, sizeof(T));
  const Handle set(
      H5Dcreate2(file, name, type_of<T>(), space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  if (!values.empty()) {
    require(H5Dwrite(set, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  }
  require(H5Dflush(set));  // while it can be told that the disk is full
}

/// As texts of one length, filled up with zeros: of texts of their own lengths HDF5 checks nothing
/// but where they are.
void write_names(hid_t file, const char* name, const std::vector<std::string>& names) {
  std::size_t longest = 1;
  for (const std::string& text : names) longest = std::max(longest, text.size());
  if (longest > kMostNameBytes / std::max<std::size_t>(names.size(), 1)) {
    throw HdfError("the names of the surfaces are too long to be written");
  }
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  require(H5Tset_size(type, longest));
  require(H5Tset_strpad(type, H5T_STR_NULLPAD));
  require(H5Tset_cset(type, H5T_CSET_UTF8));
  const hsize_t size = names.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle properties = checked_properties_or_none({size}, longest);
  const Handle set(H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                   H5Dclose);
  std::string all(names.size() * longest, '\0');
  for (std::size_t i = 0; i < names.size(); ++i) names[i].copy(&all[i * longest], longest);
  if (!names.empty()) {
    require(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()));
  }
  require(H5Dflush(set));
}

template <typename T>
void write_attribute(hid_t file, const char* name, T value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(file, name, type_of<T>(), space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  require(H5Awrite(attribute, type_of<T>(), &value));
}

/// Text of fixed length, for programs of all kinds to read.
void write_attribute(hid_t file, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  require(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)));
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(H5Awrite(attribute, type, text.c_str()));
}

/// A one-dimensional dataset that grows at its end.
template <typename T>
class GrowingDataset {
 public:
  GrowingDataset(hid_t file, const char* name) : set_(make(file, name)) {}

  void push_back(T value) {
    pending_.push_back(value);
    if (pending_.size() == kChunk) flush();
  }

  void flush() {
    if (pending_.empty()) return;
    const hsize_t count = pending_.size();
    const hsize_t size = size_ + count;
    require(H5Dset_extent(set_, &size));
    const Handle file_space(H5Dget_space(set_), H5Sclose);
    require(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, &size_, nullptr, &count, nullptr));
    const Handle memory_space(H5Screate_simple(1, &count, nullptr), H5Sclose);
    require(H5Dwrite(set_, type_of<T>(), memory_space, file_space, H5P_DEFAULT, pending_.data()));
    size_ = size;
    pending_.clear();
  }

  /// To be called at the end: closing cannot tell that the disk is full.
  void finish() {
    flush();
    require(H5Dflush(set_));
  }

 private:
  static Handle make(hid_t file, const char* name) {
    const hsize_t none = 0;
    const hsize_t unlimited = H5S_UNLIMITED;
    const Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose);
    const Handle properties = dataset_properties();
    require(H5Pset_chunk(properties, 1, &kChunk));
    require(H5Pset_fletcher32(properties));
    return {H5Dcreate2(file, name, type_of<T>(), space, H5P_DEFAULT, properties, H5P_DEFAULT),
            H5Dclose};
  }

  Handle set_;
  std::vector<T> pending_;
  hsize_t size_ = 0;
};

std::vector<double> flat(const std::vector<radiosity::Vec3>& points) {
  std::vector<double> values;
  for (const radiosity::Vec3& point : points) {
    values.insert(values.end(), point.data(), point.data() + 3);
  }
  return values;
}

std::vector<std::int32_t> flat(const std::vector<std::array<std::int32_t, 4>>& corners) {
  std::vector<std::int32_t> values;
  for (const auto& patch : corners) values.insert(values.end(), patch.begin(), patch.end());
  return values;
}

void write_patches(hid_t file, const radiosity::PatchMesh& mesh) {
  const Handle group = make_group(file, "patches");
  const auto n = static_cast<hsize_t>(mesh.size());
  write_dataset(group, "area", mesh.area, {n});
  write_dataset(group, "centroid", flat(mesh.centroid), {n, 3});
  write_dataset(group, "normal", flat(mesh.normal), {n, 3});
  write_dataset(group, "surface", mesh.surface, {n});
  write_dataset(group, "polygon", mesh.polygon, {n});
  write_dataset(group, "corners", flat(mesh.corners), {n, 4});
  write_dataset(group, "twin", mesh.twin, {n});
  write_dataset(file, "vertices", flat(mesh.vertices), {mesh.vertices.size(), 3});
}

void write_surfaces(hid_t file, const radiosity::PatchMesh& mesh) {
  const Handle group = make_group(file, "surfaces");
  write_names(group, "name", mesh.surface_names);
  const std::vector<std::int32_t> two_sided(mesh.surface_two_sided.begin(),
                                            mesh.surface_two_sided.end());
  write_dataset(group, "two_sided", two_sided, {two_sided.size()});
}

void write_rows(hid_t file, const FormFactorRows& rows) {
  const Handle group = make_group(file, "form_factors");
  GrowingDataset<double> data(group, "data");
  GrowingDataset<double> error(group, "error");
  GrowingDataset<std::int64_t> indices(group, "indices");
  std::vector<std::int64_t> row_starts{0};
  rows.visit([&](Index, const Eigen::VectorXd& row, const Eigen::VectorXd& row_error) {
    std::int64_t n_entries = row_starts.back();
    for (Index j = 0; j < row.size(); ++j) {
      if (row[j] == 0 && row_error[j] == 0) continue;
      data.push_back(row[j]);
      error.push_back(row_error[j]);
      indices.push_back(j);
      ++n_entries;
    }
    row_starts.push_back(n_entries);
  });
  data.finish();
  error.finish();
  indices.finish();
  write_dataset(group, "indptr", row_starts, {row_starts.size()});
}

void write_file(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                const FormFactorRows& rows, const FormFactorFileOptions& options) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // From this format on, what describes the values has checksums too.
  require(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
  // The file is new and locked by us: HDF5's own lock would meet that.
  require(H5Pset_file_locking(access, 0, 1));
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  require(H5Pset_obj_track_times(creation, 0));
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  write_attribute(file, "version", kFormFactorVersion);
  write_attribute(file, "tolerance", options.tolerance);
  write_attribute(file, "min_factor", options.min_factor);
  write_attribute(file, "closed", static_cast<std::int32_t>(rows.report.closed));
  write_attribute(file, kFingerprint, options.fingerprint);
  write_patches(file, mesh);
  write_surfaces(file, mesh);
  const Eigen::VectorXd& sums = rows.report.row_sums;
  write_dataset(file, "closure", std::vector<double>(sums.data(), sums.data() + sums.size()),
                {static_cast<hsize_t>(sums.size())});
  write_rows(file, rows);
  require(H5Fflush(file, H5F_SCOPE_GLOBAL));
  file.finish();
}

}  // namespace

void write_form_factors(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                        const FormFactorRows& rows, const FormFactorFileOptions& options) {
  hdf5::prepare_library();
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    try {
      write_file(temporary, mesh, rows, options);
    } catch (const HdfError& error) {
      throw radiosity::OutputError(fmt::format("{}: {}", path.string(), error.what()));
    }
  });
}

void write_form_factors(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                        const radiosity::Transport& transport,
                        const FormFactorFileOptions& options) {
  const auto visit = [&](const radiosity::RowVisitor& visit_row) {
    for (Index i = 0; i < transport.size(); ++i) {
      visit_row(i, rows_of(transport).row(i), rows_of(transport).row_error(i));
    }
  };
  write_form_factors(path, mesh, {transport.report(), visit}, options);
}

std::optional<std::string> read_fingerprint(const std::filesystem::path& path) {
  hdf5::prepare_library();
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) return std::nullopt;
  const Handle file(id, H5Fclose);
  if (H5Aexists(file, kFingerprint) <= 0) return std::nullopt;
  const Handle attribute(H5Aopen(file, kFingerprint, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  constexpr std::size_t kLongest = 1 << 12;  // one that we wrote is 16 bytes long
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 ||
      H5Tget_size(type) > kLongest) {
    return std::nullopt;
  }
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0) return std::nullopt;
  return text;
}

}  // namespace io
