#include "io/result/form_factor_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/result/hdf5_file.h"
#include "io/result/hdf5_input.h"
#include "io/result/hdf5_output.h"
#include "io/result/hdf5_patches.h"
#include "io/result/hdf5_report.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using hdf5::dataset_properties;
using hdf5::Handle;
using hdf5::make_group;
using hdf5::require;
using hdf5::type_of;
using hdf5::write_attribute;
using radiosity::Index;

constexpr const char* kFingerprint = "fingerprint";
/// Entries that are collected before they are written.
constexpr hsize_t kChunk = 1 << 16;

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
  write_list(group, "indptr", row_starts);
}

}  // namespace

void write_form_factors(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                        const FormFactorRows& rows, const FormFactorFileOptions& options) {
  hdf5::write_file(path, [&](hid_t file) {
    write_attribute(file, "version", kFormFactorVersion);
    write_attribute(file, "tolerance", options.tolerance);
    write_attribute(file, "min_factor", options.min_factor);
    write_attribute(file, kFingerprint, options.fingerprint);
    write_attribute(file, "geometry", options.geometry);
    hdf5::write_mesh(file, mesh);
    hdf5::write_report(file, rows.report);
    if (rows.sums) hdf5::write_list(file, "row_sums", *rows.sums);
    write_rows(file, rows);
  });
}

void write_form_factors(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                        const radiosity::Transport& transport, const FormFactorFileOptions& options,
                        const radiosity::Progress& progress) {
  const auto visit = [&](const radiosity::RowVisitor& visit_row) {
    for (Index i = 0; i < transport.size(); ++i) {
      progress.check();
      visit_row(i, rows_of(transport).row(i), rows_of(transport).row_error(i));
    }
  };
  const Eigen::VectorXd sums = transport.apply(Eigen::VectorXd::Ones(transport.size()));
  write_form_factors(path, mesh, {transport.report(), visit, sums}, options);
}

std::optional<std::string> read_fingerprint(const std::filesystem::path& path) {
  hdf5::prepare_library();
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) return std::nullopt;
  const Handle file(id, H5Fclose);
  return hdf5::find_text_attribute(file, kFingerprint);
}

}  // namespace io
