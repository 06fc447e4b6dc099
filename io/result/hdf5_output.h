#pragma once

#include <hdf5.h>

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/result/hdf5_file.h"

/// Writing HDF5 files whose bytes depend on nothing but what they hold, all of it with checksums.
/// All functions throw HdfError if HDF5 cannot write.
namespace io::hdf5 {

void require(herr_t status);

/// Writes a new file through `write`, beside `path` and renamed into place. Throws OutputError
/// (a full disk, say), and what `write` throws.
void write_file(const std::filesystem::path& path, const std::function<void(hid_t file)>& write);

Handle make_group(hid_t file, const char* name);

/// How datasets are made: without the time, so that equal content makes equal files.
Handle dataset_properties();
/// The same for values of so many bytes, in chunks with checksums (Fletcher32), so that damage is
/// noticed; not where `shape` has a zero.
Handle checked_properties(const std::vector<hsize_t>& shape, std::size_t bytes);

/// A dataset of these values, by rows.
template <typename T>
void write_dataset(hid_t file, const char* name, const std::vector<T>& values,
                   const std::vector<hsize_t>& shape) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle properties = checked_properties(shape, sizeof(T));
  const Handle set(
      H5Dcreate2(file, name, type_of<T>(), space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  if (!values.empty()) {
    require(H5Dwrite(set, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  }
  require(H5Dflush(set));  // while it can be told that the disk is full
}

/// The same of a list.
template <typename T>
void write_list(hid_t file, const char* name, const std::vector<T>& values) {
  write_dataset(file, name, values, {values.size()});
}
void write_list(hid_t file, const char* name, const Eigen::VectorXd& values);

/// As texts of one length, filled up with zeros: of texts of their own lengths HDF5 checks nothing
/// but where they are.
void write_names(hid_t file, const char* name, const std::vector<std::string>& names);

template <typename T>
void write_attribute(hid_t file, const char* name, T value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(file, name, type_of<T>(), space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  require(H5Awrite(attribute, type_of<T>(), &value));
}

/// Text of fixed length, for programs of all kinds to read.
void write_attribute(hid_t file, const char* name, const std::string& text);

}  // namespace io::hdf5
