#pragma once

#include <hdf5.h>

#include <span>
#include <vector>

#include "io/result/hdf5_output.h"

namespace io::hdf5 {

/// A one-dimensional dataset that grows at its end.
template <typename T>
class GrowingDataset {
 public:
  GrowingDataset(hid_t file, const char* name) : set_(make(file, name)) {}

  void push_back(T value) {
    pending_.push_back(value);
    if (pending_.size() == kChunk) flush();
  }

  void append(std::span<const T> values) {
    pending_.insert(pending_.end(), values.begin(), values.end());
    if (pending_.size() >= kChunk) flush();
  }

  /// To be called at the end: closing cannot tell that the disk is full.
  void finish() {
    flush();
    require(H5Dflush(set_));
  }

 private:
  /// Values that are collected before they are written.
  static constexpr hsize_t kChunk = 1 << 16;

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

  static Handle make(hid_t file, const char* name) {
    const hsize_t none = 0;
    const hsize_t unlimited = H5S_UNLIMITED;
    const Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose);
    const Handle properties = dataset_properties();
    const hsize_t chunk = kChunk;
    require(H5Pset_chunk(properties, 1, &chunk));
    require(H5Pset_fletcher32(properties));
    return {H5Dcreate2(file, name, type_of<T>(), space, H5P_DEFAULT, properties, H5P_DEFAULT),
            H5Dclose};
  }

  Handle set_;
  std::vector<T> pending_;
  hsize_t size_ = 0;
};

}  // namespace io::hdf5
