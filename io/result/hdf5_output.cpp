#include "io/result/hdf5_output.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/base/atomic_file.h"

namespace io::hdf5 {
namespace {

/// What of a dataset has one checksum; larger ones have several.
constexpr hsize_t kChunkBytes = 1 << 20;
constexpr std::size_t kMostNameBytes = 1 << 30;

void write_new_file(const std::filesystem::path& path,
                    const std::function<void(hid_t file)>& write) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // From this format on, what describes the values has checksums too.
  require(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
  // The file is new and locked by us: HDF5's own lock would meet that.
  require(H5Pset_file_locking(access, 0, 1));
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  require(H5Pset_obj_track_times(creation, 0));
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  write(file);
  require(H5Fflush(file, H5F_SCOPE_GLOBAL));
  file.finish();
}

}  // namespace

void require(herr_t status) {
  if (status < 0) throw HdfError("HDF5 cannot write (is the disk full?)");
}

void write_file(const std::filesystem::path& path, const std::function<void(hid_t file)>& write) {
  prepare_library();
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    try {
      write_new_file(temporary, write);
    } catch (const HdfError& error) {
      throw radiosity::OutputError(fmt::format("{}: {}", path.string(), error.what()));
    }
  });
}

Handle make_group(hid_t file, const char* name) {
  const Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  require(H5Pset_obj_track_times(properties, 0));
  return {H5Gcreate2(file, name, H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose};
}

Handle dataset_properties() {
  Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (H5Pset_obj_track_times(properties, 0) < 0) throw HdfError("HDF5 is too old");
  return properties;
}

Handle checked_properties(const std::vector<hsize_t>& shape, std::size_t bytes) {
  Handle properties = dataset_properties();
  if (std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end()) return properties;
  std::vector<hsize_t> chunk = shape;
  hsize_t row = 1;
  for (std::size_t k = 1; k < shape.size(); ++k) row *= shape[k];
  chunk[0] = std::clamp<hsize_t>(kChunkBytes / std::max<hsize_t>(row * bytes, 1), 1, shape[0]);
  require(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()));
  require(H5Pset_fletcher32(properties));
  return properties;
}

void write_list(hid_t file, const char* name, const Eigen::VectorXd& values) {
  write_list(file, name, std::vector<double>(values.data(), values.data() + values.size()));
}

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
  const Handle properties = checked_properties({size}, longest);
  const Handle set(H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                   H5Dclose);
  std::string all(names.size() * longest, '\0');
  for (std::size_t i = 0; i < names.size(); ++i) names[i].copy(&all[i * longest], longest);
  if (!names.empty()) {
    require(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()));
  }
  require(H5Dflush(set));
}

void write_attribute(hid_t file, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  require(H5Tset_size(type, std::max<std::size_t>(text.size(), 1)));
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(H5Awrite(attribute, type, text.c_str()));
}

}  // namespace io::hdf5
