#include "io/result/hdf5_input.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace io::hdf5 {
namespace {

/// zlib makes no block smaller than this part of it (1032, and some slack). Ours are not
/// compressed; repacked ones may be.
constexpr hsize_t kMostCompressed = 1100;

Handle open_dataset(hid_t file, const char* name) {
  const hid_t id = H5Dopen2(file, name, H5P_DEFAULT);
  if (id < 0) throw HdfError(fmt::format("/{} cannot be opened", name));
  return {id, H5Dclose};
}

/// Texts of one length; the storage check has bounded their size.
std::vector<std::string> read_fixed_names(const Dataset& dataset) {
  const std::size_t length = H5Tget_size(dataset.type);
  std::string all(dataset.shape[0] * length, '\0');
  if (H5Dread(dataset.set, dataset.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()) < 0) {
    dataset.fail_reading();
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < dataset.shape[0]; ++i) {
    const std::string text = all.substr(i * length, length);
    names.push_back(text.substr(0, text.find('\0')));
  }
  return names;
}

/// Whether the values may take more room than they do in the file.
bool is_compressed(hid_t properties) {
  for (int k = 0; k < H5Pget_nfilters(properties); ++k) {
    unsigned flags = 0;
    std::size_t n_values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(properties, static_cast<unsigned>(k), &flags,
                                               &n_values, nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_FLETCHER32 && filter != H5Z_FILTER_SHUFFLE) return true;
  }
  return false;
}

}  // namespace

bool has_dataset(hid_t file, const std::string& name) {
  const std::size_t slash = name.find('/');
  if (slash != std::string::npos &&
      H5Lexists(file, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) {
    return false;
  }
  return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0;
}

Dataset::Dataset(hid_t file, const char* dataset_name)
    : name(dataset_name), set(open_dataset(file, dataset_name)), type(H5Dget_type(set), H5Tclose) {
  const Handle space(H5Dget_space(set), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2) fail("has another number of dimensions than 1 or 2");
  shape.resize(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  check_storage();
}

void Dataset::fail(const std::string& what) const {
  throw HdfError(fmt::format("/{} {}", name, what));
}

void Dataset::fail_reading() const {
  const Handle properties(H5Dget_create_plist(set), H5Pclose);
  for (int k = 0; k < H5Pget_nfilters(properties); ++k) {
    unsigned flags = 0;
    std::size_t n_values = 0;
    if (H5Pget_filter2(properties, static_cast<unsigned>(k), &flags, &n_values, nullptr, 0, nullptr,
                       nullptr) == H5Z_FILTER_FLETCHER32) {
      fail("is damaged: its values do not match their checksum, or are cut off");
    }
  }
  fail("cannot be read");
}

void Dataset::require_shape(const std::vector<hsize_t>& expected) const {
  if (shape == expected) return;
  fail(fmt::format("is {}, expected {}", fmt::join(shape, " x "), fmt::join(expected, " x ")));
}

void Dataset::require_class(std::initializer_list<H5T_class_t> expected) const {
  if (std::find(expected.begin(), expected.end(), H5Tget_class(type)) == expected.end()) {
    fail("holds another type of values");
  }
}

/// A damaged shape must not make us ask for more memory than the values in the file take.
void Dataset::check_storage() const {
  hsize_t room = H5Dget_storage_size(set);
  const Handle properties(H5Dget_create_plist(set), H5Pclose);
  if (H5Pget_layout(properties) == H5D_CHUNKED) check_chunk(properties);
  if (is_compressed(properties)) room *= kMostCompressed;
  room /= std::max<std::size_t>(H5Tget_size(type), 1);
  for (const hsize_t length : shape) {
    if (length == 0) return;
    room /= length;
  }
  if (room == 0) fail("is longer than its data");
}

/// HDF5 takes memory for a whole chunk.
void Dataset::check_chunk(hid_t properties) const {
  constexpr double kLargest = 64e6;  // bytes, in a file that holds less
  std::vector<hsize_t> lengths(shape.size(), 1);
  H5Pget_chunk(properties, static_cast<int>(lengths.size()), lengths.data());
  auto bytes = static_cast<double>(H5Tget_size(type));
  for (const hsize_t length : lengths) bytes *= static_cast<double>(length);
  if (bytes > std::max(kLargest, static_cast<double>(H5Dget_storage_size(set)))) {
    fail("has chunks that are larger than its data");
  }
}

std::vector<std::string> read_names(hid_t file, const char* name) {
  const Dataset dataset(file, name);
  if (dataset.shape.size() != 1 || H5Tget_class(dataset.type) != H5T_STRING) {
    dataset.fail("is no list of names");
  }
  if (dataset.shape[0] == 0) return {};
  if (H5Tis_variable_str(dataset.type) <= 0) return read_fixed_names(dataset);
  std::vector<char*> pointers(dataset.shape[0], nullptr);
  const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(memory, H5T_VARIABLE);
  H5Tset_cset(memory, H5Tget_cset(dataset.type));
  const bool is_read =
      H5Dread(dataset.set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) >= 0;
  std::vector<std::string> names;
  for (char* text : pointers) {
    names.emplace_back(text != nullptr ? text : "");
    if (text != nullptr) H5free_memory(text);
  }
  if (!is_read) dataset.fail_reading();
  return names;
}

std::optional<std::string> find_text_attribute(hid_t file, const char* name) {
  if (H5Aexists(file, name) <= 0) return std::nullopt;
  const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
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

Handle open_file(const std::filesystem::path& path, std::string_view kind) {
  (void)input_size(path);
  prepare_library();
  if (H5Fis_hdf5(path.c_str()) <= 0) throw HdfError(fmt::format("is not {} (HDF5)", kind));
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) throw HdfError("is cut off or damaged: HDF5 cannot open it");
  return {id, H5Fclose};
}

void check_version(hid_t file, std::string_view kind, std::int64_t newest,
                   std::span<const char* const> required) {
  std::vector<std::string> missing;
  if (H5Aexists(file, "version") > 0) {
    const auto version = read_attribute<std::int64_t>(file, "version");
    if (version > newest) {
      throw HdfError(fmt::format(
          "was written by a newer version of this program (format {}, this one reads {})", version,
          newest));
    }
  } else {
    missing.emplace_back("attribute \"version\"");
  }
  for (const char* name : required) {
    if (!has_dataset(file, name)) missing.push_back(fmt::format("/{}", name));
  }
  if (missing.empty()) return;
  throw HdfError(
      fmt::format("is no {} of this program: it lacks {}", kind, fmt::join(missing, ", ")));
}

}  // namespace io::hdf5
