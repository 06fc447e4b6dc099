#include "io/result/compressed_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/result/hdf5_input.h"
#include "io/result/hdf5_output.h"
#include "io/result/hdf5_report.h"
#include "radiosity/compressed/stored_blocks.h"

namespace io::hdf5 {

using radiosity::CompressedTransport;
using radiosity::Index;
using radiosity::StoredBlocks;
using Source = CompressedTransport::Parts::Source;

namespace {

constexpr const char* kGroup = "compressed";

/// A table with columns, whatever its number of rows.
template <typename T>
void write_table(hid_t group, const char* name, const std::vector<T>& values, hsize_t width) {
  write_dataset(group, name, values, {values.size() / width, width});
}

template <typename T>
std::vector<T> read_list(hid_t group, const char* name) {
  return read_all<T>(group, name, {Dataset(group, name).shape[0]});
}

template <typename T>
std::vector<T> read_table(hid_t group, const char* name, hsize_t width) {
  return read_all<T>(group, name, {Dataset(group, name).shape[0], width});
}

void write_blocks(hid_t group, const StoredBlocks& blocks) {
  write_table(group, "nodes", blocks.nodes, radiosity::kNodeWidth);
  write_table(group, "functions", blocks.functions, radiosity::kFunctionWidth);
  write_list(group, "numbers", blocks.numbers);
  write_table(group, "far", blocks.far, 2);
  write_table(group, "far_degrees", blocks.degrees, 2);
  write_list(group, "far_errors", blocks.far_errors);
  write_list(group, "coefficients", blocks.coefficients);
  write_table(group, "near", blocks.near, 2);
  write_list(group, "near_may_change", blocks.near_change);
  write_list(group, "near_errors", blocks.near_errors);
  write_list(group, "densities", blocks.densities);
}

StoredBlocks read_blocks(hid_t group) {
  return {.nodes = read_table<std::int32_t>(group, "nodes", radiosity::kNodeWidth),
          .functions = read_table<std::uint8_t>(group, "functions", radiosity::kFunctionWidth),
          .numbers = read_list<float>(group, "numbers"),
          .far = read_table<std::int32_t>(group, "far", 2),
          .degrees = read_table<std::uint8_t>(group, "far_degrees", 2),
          .far_errors = read_list<float>(group, "far_errors"),
          .coefficients = read_list<float>(group, "coefficients"),
          .near = read_table<std::int32_t>(group, "near", 2),
          .near_change = read_list<std::uint8_t>(group, "near_may_change"),
          .near_errors = read_list<float>(group, "near_errors"),
          .densities = read_list<float>(group, "densities")};
}

void write_sources(hid_t group, const std::vector<Source>& sources) {
  std::vector<std::int64_t> first{0};
  std::vector<std::int32_t> patches;
  std::vector<double> lacking;
  for (const Source& source : sources) {
    patches.insert(patches.end(), source.patches.begin(), source.patches.end());
    lacking.insert(lacking.end(), source.lacking.begin(), source.lacking.end());
    first.push_back(static_cast<std::int64_t>(patches.size()));
  }
  write_list(group, "first_light_patch", first);
  write_list(group, "light_patches", patches);
  const hsize_t n = sources.empty() ? 0 : lacking.size() / sources.size();
  write_dataset(group, "light", lacking, {sources.size(), n});
}

std::vector<Source> read_sources(hid_t group, Index n) {
  const auto first = read_list<std::int64_t>(group, "first_light_patch");
  const auto patches = read_list<std::int32_t>(group, "light_patches");
  const bool is_whole = !first.empty() && first.front() == 0 &&
                        first.back() == static_cast<std::int64_t>(patches.size()) &&
                        std::is_sorted(first.begin(), first.end());
  if (!is_whole) throw HdfError("the patches of its lights do not make up their list");
  const std::size_t n_sources = first.size() - 1;
  if (n_sources == 0) return {};
  const auto lacking = read_all<double>(group, "light", {n_sources, static_cast<hsize_t>(n)});
  std::vector<Source> sources(n_sources);
  for (std::size_t k = 0; k < n_sources; ++k) {
    Source& source = sources[k];
    source.patches.assign(patches.begin() + first[k], patches.begin() + first[k + 1]);
    const bool is_rising = std::is_sorted(source.patches.begin(), source.patches.end(),
                                          std::less_equal<std::int32_t>());
    if (source.patches.empty() || !is_rising || source.patches.front() < 0 ||
        source.patches.back() >= n) {
      throw HdfError(fmt::format("light {} has patches that are not there", k));
    }
    const double* values = lacking.data() + k * static_cast<std::size_t>(n);
    source.lacking = Eigen::Map<const Eigen::VectorXd>(values, n);
  }
  return sources;
}

void write_compression(hid_t group, const radiosity::CompressionReport& report) {
  write_attribute(group, "verified_error", report.verified_error);
  write_attribute(group, "estimated_error", report.estimated_error);
  write_attribute(group, "rows", std::int64_t{report.n_rows});
  write_attribute(group, "rounds", std::int64_t{report.n_rounds});
  write_attribute(group, "numbers_per_patch", report.coefficients);
  write_attribute(group, "entries_per_patch", report.entries);
}

radiosity::CompressionReport read_compression(hid_t group) {
  return {.verified_error = read_attribute<double>(group, "verified_error"),
          .estimated_error = read_attribute<double>(group, "estimated_error"),
          .n_rows = static_cast<long>(read_attribute<std::int64_t>(group, "rows")),
          .n_rounds = static_cast<int>(read_attribute<std::int64_t>(group, "rounds")),
          .coefficients = read_attribute<double>(group, "numbers_per_patch"),
          .entries = read_attribute<double>(group, "entries_per_patch")};
}

/// Each patch once.
std::vector<std::int32_t> read_order(hid_t group, Index n) {
  auto order = read_all<std::int32_t>(group, "order", {static_cast<hsize_t>(n)});
  std::vector<bool> is_there(order.size(), false);
  for (const std::int32_t patch : order) {
    if (patch < 0 || patch >= n || is_there[patch]) {
      throw HdfError("the order of the patches does not have each of them once");
    }
    is_there[patch] = true;
  }
  return order;
}

Eigen::VectorXd read_multipliers(hid_t group, Index n) {
  const auto values = read_list<double>(group, "multipliers");
  if (!values.empty() && static_cast<Index>(values.size()) != n) {
    throw HdfError(fmt::format("has {} multipliers, expected {}", values.size(), n));
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
}

}  // namespace

bool has_compressed(hid_t file) { return has_dataset(file, "compressed/nodes"); }

void write_compressed(hid_t file, const CompressedTransport& transport) {
  const CompressedTransport::Parts& parts = transport.parts();
  write_report(file, parts.report);
  const Handle group = make_group(file, kGroup);
  write_list(group, "order", parts.order);
  write_blocks(group, radiosity::store(transport.matrix().blocks()));
  write_list(group, "multipliers", parts.multipliers);
  write_sources(group, parts.sources);
  write_attribute(group, "error_scale", parts.error_scale);
  if (parts.report.compression) write_compression(group, *parts.report.compression);
}

std::unique_ptr<CompressedTransport> read_compressed(hid_t file, const radiosity::PatchMesh& mesh) {
  const Index n = mesh.size();
  const Handle group(H5Gopen2(file, kGroup, H5P_DEFAULT), H5Gclose);
  CompressedTransport::Parts parts{.order = read_order(group, n),
                                   .blocks = {},
                                   .area = Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), n),
                                   .multipliers = read_multipliers(group, n),
                                   .sources = read_sources(group, n),
                                   .error_scale = read_attribute<double>(group, "error_scale"),
                                   .report = read_report(file, n)};
  if (!(parts.error_scale >= 0)) throw HdfError("the scale of its errors is below 0");
  parts.report.compression = read_compression(group);
  try {
    parts.blocks = radiosity::restore(read_blocks(group), n);
  } catch (const radiosity::SolveError& error) {
    throw HdfError(error.what());
  }
  return std::make_unique<CompressedTransport>(std::move(parts));
}

}  // namespace io::hdf5
