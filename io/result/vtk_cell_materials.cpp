#include "io/result/vtk_cell_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "io/base/input_checks.h"
#include "io/base/line_reader.h"
#include "io/result/bands_name.h"
#include "io/result/vtp_values.h"

namespace io {

using radiosity::Bands;
using radiosity::Emission;

namespace {

/// Increasing wavelengths in the field data of the name; none if there are no numbers.
std::vector<double> field_wavelengths(const VtpFile& file, const char* name,
                                      const std::filesystem::path& path) {
  const auto found = file.fields.find(name);
  if (found == file.fields.end() || found->second.type == "String") return {};
  std::vector<double> result;
  for (std::size_t k = 0; k < n_values(found->second); ++k) {
    const double before = result.empty() ? 0 : result.back();
    result.push_back(number<double>(found->second, k));
    if (!(std::isfinite(result.back()) && result.back() > before)) {
      fail(path, fmt::format("its {} do not increase", name));
    }
  }
  return result;
}

/// The bands of heat that a result tells, if it does.
std::optional<Bands> heat_bands(const VtpFile& file, const std::filesystem::path& path) {
  const auto found = file.fields.find("bands");
  if (found == file.fields.end() || found->second.type != "String") return std::nullopt;
  const std::string_view name = found->second.bytes.c_str();
  for (const Bands::Kind kind : {Bands::Kind::solar_infrared, Bands::Kind::thermal}) {
    if (name != bands_name(kind)) continue;
    return Bands{
        .kind = kind, .wavelengths = {}, .edges = field_wavelengths(file, "band_edges", path)};
  }
  return std::nullopt;
}

}  // namespace

VtkCellMaterials::VtkCellMaterials(const VtpFile& file, const std::filesystem::path& path)
    : file_(file), path_(path) {
  const bool is_result = file.fields.contains("radiosity_version");
  reflectance_ = of_cells("reflectance");
  if (const VtpArray* const emissivity = is_result ? nullptr : of_cells("emissivity")) {
    if (reflectance_ != nullptr) fail(path, "has both \"reflectance\" and \"emissivity\"");
    reflectance_ = emissivity;
    is_emissivity_ = true;
  }
  for (const auto& [name, kind] : {std::pair("exitance", Emission::Kind::exitance),
                                   {"radiance", Emission::Kind::radiance},
                                   {"temperature", Emission::Kind::temperature}}) {
    const VtpArray* const array = of_cells(name);
    if (array == nullptr || (is_result && kind != Emission::Kind::exitance)) continue;
    if (reflectance_ == nullptr) {
      left_out_ = fmt::format(
          "has \"{}\", but neither \"reflectance\" nor \"emissivity\"; it is left out", name);
      continue;
    }
    if (emission_ != nullptr) {
      fail(path, fmt::format("has both \"{}\" and \"{}\"", emission_name_, name));
    }
    emission_ = array;
    emission_name_ = name;
    kind_ = kind;
  }
  if (reflectance_ != nullptr) find_bands();
}

const VtpArray* VtkCellMaterials::of_cells(const char* name) const {
  const auto found = file_.cells.find(name);
  return found == file_.cells.end() || found->second.type == "String" ? nullptr : &found->second;
}

void VtkCellMaterials::find_bands() {
  std::uint64_t n = reflectance_->n_components;
  if (emission_ != nullptr) n = std::max(n, emission_->n_components);
  const bool is_grey_only = is_emissivity_ || kind_ == Emission::Kind::temperature;
  for (const VtpArray* array : {reflectance_, emission_}) {
    if (array == nullptr || array->n_components == n || array->n_components == 1) continue;
    fail(path_, fmt::format("its materials have {} and {} columns", array->n_components, n));
  }
  if (is_grey_only && n > 1) {
    fail(path_, fmt::format("its materials have {} columns, expected 1 beside an emissivity or a "
                            "temperature",
                            n));
  }
  if (const auto heat = heat_bands(file_, path_);
      heat && heat->count() == static_cast<radiosity::Index>(n)) {
    bands_ = *heat;
    return;
  }
  std::vector<double> wavelengths = field_wavelengths(file_, "wavelengths", path_);
  if (wavelengths.size() == n) {
    bands_.kind = Bands::Kind::wavelengths;
    bands_.wavelengths = std::move(wavelengths);
  } else if (n == 1) {
    bands_.kind = Bands::Kind::grey;
  } else if (n != 3) {
    fail(path_, fmt::format("its materials have {} columns, expected 1, or 3 (RGB)", n));
  }
}

Eigen::VectorXd VtkCellMaterials::values(const VtpArray& array, std::size_t cell) const {
  Eigen::VectorXd result(bands_.count());
  for (Eigen::Index k = 0; k < result.size(); ++k) {
    const std::size_t column = array.n_components == 1 ? 0 : static_cast<std::size_t>(k);
    result[k] = number<double>(array, cell * array.n_components + column);
  }
  return result;
}

int VtkCellMaterials::find_or_add(std::size_t cell, radiosity::Scene& scene) {
  if (empty()) return -1;
  Eigen::VectorXd reflectance = values(*reflectance_, cell);
  if (is_emissivity_) reflectance = (1 - reflectance.array()).matrix();
  Emission emission;
  if (emission_ != nullptr) emission = {.kind = kind_, .value = values(*emission_, cell)};
  if (const auto problem = reflectance_problem(reflectance)) {
    fail(path_, fmt::format("cell {}: {}", cell, *problem));
  }
  if (const auto problem = emission_problem(emission_name_, emission.value)) {
    fail(path_, fmt::format("cell {}: {}", cell, *problem));
  }
  if ((emission.value.array() == 0).all()) emission = {};
  std::vector<double> key(reflectance.begin(), reflectance.end());
  key.insert(key.end(), emission.value.begin(), emission.value.end());
  const auto [entry, is_new] = known_.try_emplace(key, static_cast<int>(scene.materials.size()));
  if (is_new) {
    scene.materials.push_back({.name = fmt::format("material {}", scene.materials.size() + 1),
                               .reflectance = std::move(reflectance),
                               .emission = std::move(emission)});
  }
  return entry->second;
}

}  // namespace io
