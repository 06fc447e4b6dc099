#include "io/result/operator_file.h"

#include <utility>
#include <vector>

#include "io/result/compressed_file.h"
#include "io/result/form_factor_file.h"
#include "io/result/form_factor_reader.h"
#include "io/result/hdf5_input.h"
#include "io/result/hdf5_output.h"
#include "io/result/hdf5_patches.h"
#include "radiosity/assembly/dense_memory.h"
#include "radiosity/assembly/dense_transport.h"

namespace io {
namespace {

using hdf5::Handle;
using radiosity::AssemblyReport;
using radiosity::CompressedTransport;
using radiosity::PatchMesh;

constexpr const char* kKind = "an operator or form-factor file";

StoredOperator read_compressed_file(hid_t file) {
  hdf5::check_version(file, "operator file", kOperatorVersion, {});
  std::vector<std::string> warnings;
  StoredOperator stored;
  stored.mesh = hdf5::read_mesh(file, warnings);
  stored.transport = hdf5::read_compressed(file, stored.mesh);
  stored.tolerance = hdf5::read_attribute<double>(file, "tolerance");
  stored.geometry = hdf5::find_text_attribute(file, "geometry").value_or("");
  return stored;
}

StoredOperator read_dense_file(const std::filesystem::path& path,
                               const radiosity::Progress& progress, std::size_t memory) {
  const FormFactorReader reader(path);
  const PatchMesh& mesh = reader.mesh();
  radiosity::check_memory(mesh.size(), mesh.n_polygons(), memory);
  return {.mesh = mesh,
          .transport = radiosity::dense_transport_of(mesh, reader, reader.row_sums(),
                                                     reader.report(), progress),
          .tolerance = reader.tolerance(),
          .geometry = reader.geometry()};
}

}  // namespace

void write_operator(const std::filesystem::path& path, const PatchMesh& mesh,
                    const radiosity::Transport& transport, const OperatorFileOptions& options,
                    const radiosity::Progress& progress) {
  const auto* compressed = dynamic_cast<const CompressedTransport*>(&transport);
  if (compressed == nullptr) {
    write_form_factors(path, mesh, transport,
                       {.tolerance = options.tolerance,
                        .fingerprint = options.fingerprint,
                        .geometry = options.geometry},
                       progress);
    return;
  }
  hdf5::write_file(path, [&](hid_t file) {
    hdf5::write_attribute(file, "version", kOperatorVersion);
    hdf5::write_attribute(file, "tolerance", options.tolerance);
    hdf5::write_attribute(file, "geometry", options.geometry);
    if (!options.fingerprint.empty()) {
      hdf5::write_attribute(file, "fingerprint", options.fingerprint);
    }
    hdf5::write_mesh(file, mesh);
    progress.check();
    hdf5::write_compressed(file, *compressed);
  });
}

bool is_compressed_operator(const std::filesystem::path& path) {
  return hdf5::checked(path, [&] { return hdf5::has_compressed(hdf5::open_file(path, kKind)); });
}

StoredOperator read_operator(const std::filesystem::path& path, const radiosity::Progress& progress,
                             std::size_t memory) {
  if (!is_compressed_operator(path)) return read_dense_file(path, progress, memory);
  return hdf5::checked(path, [&] { return read_compressed_file(hdf5::open_file(path, kKind)); });
}

}  // namespace io
