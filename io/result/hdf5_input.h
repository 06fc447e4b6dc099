#pragma once

#include <fmt/format.h>
#include <hdf5.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/base/line_reader.h"
#include "io/result/hdf5_file.h"

/// Reading HDF5 files that may be damaged or made by others. All functions throw HdfError telling
/// what of the file is not as asked for.
namespace io::hdf5 {

/// Whether the file has something of this name, "name" or "group/name".
bool has_dataset(hid_t file, const std::string& name);

/// An open dataset of one or two dimensions, whose values are all there.
struct Dataset {
  Dataset(hid_t file, const char* dataset_name);

  [[noreturn]] void fail(const std::string& what) const;  ///< HdfError "/name what"
  [[noreturn]] void fail_reading() const;  ///< likewise, of values that HDF5 cannot give
  void require_shape(const std::vector<hsize_t>& expected) const;
  void require_class(std::initializer_list<H5T_class_t> expected) const;

  std::string name;
  Handle set;
  Handle type;
  std::vector<hsize_t> shape;

 private:
  void check_storage() const;
  void check_chunk(hid_t properties) const;
};

template <typename T>
void require_numbers(const Dataset& dataset) {
  if (std::is_floating_point_v<T>) {
    dataset.require_class({H5T_FLOAT, H5T_INTEGER});
  } else {
    dataset.require_class({H5T_INTEGER});
  }
}

/// All values of a dataset of numbers, row by row; finite.
template <typename T>
std::vector<T> read_all(hid_t file, const char* name, const std::vector<hsize_t>& shape) {
  const Dataset dataset(file, name);
  dataset.require_shape(shape);
  require_numbers<T>(dataset);
  std::vector<T> values(shape.size() == 2 ? shape[0] * shape[1] : shape[0]);
  if (!values.empty() &&
      H5Dread(dataset.set, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    dataset.fail_reading();
  }
  if constexpr (std::is_floating_point_v<T>) {
    for (const T value : values) {
      if (!std::isfinite(value)) dataset.fail("has a value that is not finite");
    }
  }
  return values;
}

/// Values `first` to `first + n - 1` of a dataset of one dimension, which has them.
template <typename T>
std::vector<T> read_slice(const Dataset& dataset, hsize_t first, hsize_t n) {
  std::vector<T> values(n);
  if (n == 0) return values;
  const Handle space(H5Dget_space(dataset.set), H5Sclose);
  const Handle memory(H5Screate_simple(1, &n, nullptr), H5Sclose);
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &n, nullptr) < 0 ||
      H5Dread(dataset.set, type_of<T>(), memory, space, H5P_DEFAULT, values.data()) < 0) {
    dataset.fail_reading();
  }
  return values;
}

/// A list of texts, each of its own length or all of one, which zeros fill up.
std::vector<std::string> read_names(hid_t file, const char* name);

/// A number that the file has as an attribute.
template <typename T>
T read_attribute(hid_t file, const char* name) {
  if (H5Aexists(file, name) <= 0) throw HdfError(fmt::format("has no attribute \"{}\"", name));
  const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type);
  T value{};
  if (H5Sget_simple_extent_npoints(space) != 1 || (kind != H5T_INTEGER && kind != H5T_FLOAT) ||
      H5Aread(attribute, type_of<T>(), &value) < 0) {
    throw HdfError(fmt::format("the attribute \"{}\" is no number", name));
  }
  return value;
}

/// A text that the file has as an attribute, of fixed length; nothing if there is none.
std::optional<std::string> find_text_attribute(hid_t file, const char* name);

/// Opens a file of ours to be read; `kind` is what it should be, for messages.
Handle open_file(const std::filesystem::path& path, std::string_view kind);

/// Refuses files without an attribute "version", of a version above `newest`, or without one of the
/// datasets `required`.
void check_version(hid_t file, std::string_view kind, std::int64_t newest,
                   std::span<const char* const> required);

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

}  // namespace io::hdf5
