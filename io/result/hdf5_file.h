#pragma once

#include <hdf5.h>

#include <cstdint>
#include <utility>

#include "radiosity/base/error.h"

/// What reading and writing HDF5 share. For sources only: headers of ours do not show HDF5.
namespace io::hdf5 {

/// What HDF5 could not do, before the file's name is put to it.
struct HdfError : radiosity::OutputError {
  using radiosity::OutputError::OutputError;
};

/// Closes an HDF5 handle. Throws HdfError if it is given none.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {
    if (id_ < 0) throw HdfError("HDF5 cannot make an object");
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  /// Closes it before its end, to throw HdfError if that fails.
  void finish() {
    if (close_(std::exchange(id_, -1)) < 0) throw HdfError("HDF5 cannot write (is the disk full?)");
  }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): for the C calls

 private:
  hid_t id_;
  Close close_;
};

/// Before any other use of the library: it then prints nothing and leaves the end of the program
/// alone.
inline void prepare_library() {
  // What a full disk leaves open cannot be flushed at the end of the program either: HDF5 1.10 then
  // crashes in the attempt.
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are ours to tell
}

/// HDF5's type of a number in memory.
template <typename T>
hid_t type_of();
template <>
inline hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t type_of<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t type_of<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}
template <>
inline hid_t type_of<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
inline hid_t type_of<std::int64_t>() {
  return H5T_NATIVE_INT64;
}

}  // namespace io::hdf5
