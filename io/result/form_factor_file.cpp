#include "io/result/form_factor_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/result/hdf5_file.h"
#include "io/result/hdf5_growing.h"
#include "io/result/hdf5_input.h"
#include "io/result/hdf5_output.h"
#include "io/result/hdf5_patches.h"
#include "io/result/hdf5_report.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using hdf5::GrowingDataset;
using hdf5::Handle;
using hdf5::make_group;
using hdf5::write_attribute;
using radiosity::Index;

constexpr const char* kFingerprint = "fingerprint";

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
