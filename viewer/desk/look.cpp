#include "viewer/desk/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "radiosity/solve/solution.h"
#include "viewer/work/arrivals.h"
#include "viewer/work/plan_meter.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::Quantity;
using radiosity::QuantityField;

const std::vector<ShowName>& names() {
  static const std::vector<ShowName> all = [] {
    std::vector<ShowName> list = {
        {"true-colour", Show::true_color}, {"work-plane", Show::work_plane}, {"grid", Show::grid}};
    for (const auto& info : radiosity::quantity_infos()) {
      list.push_back({info.name, Show::quantity, info.quantity});
    }
    for (const ShowName& name :
         {ShowName{"area", Show::area}, ShowName{"unseen", Show::unseen},
          ShowName{"direct", Show::direct}, ShowName{"indirect", Show::indirect},
          ShowName{"form-factors", Show::form_factors}, ShowName{"arriving", Show::arriving},
          ShowName{"light-path", Show::light_path}, ShowName{"watched", Show::watched},
          ShowName{"unshot", Show::unshot}}) {
      list.push_back(name);
    }
    return list;
  }();
  return all;
}

/// The chosen band, or the mean over all.
Eigen::VectorXd one_band(const Eigen::MatrixXd& values, const radiosity::Bands& bands,
                         std::optional<Index> band) {
  if (values.cols() == 1) return values.col(0);
  if (band && *band < values.cols()) return values.col(*band);
  return radiosity::mean_over_bands(values, bands.wavelengths);
}

ShownField banded(std::string what, const std::string& unit, const Eigen::MatrixXd& values,
                  const Known& known, const Look& look) {
  const radiosity::Bands& bands = known.model.bands;
  ShownField field{
      .title = {std::move(what)}, .unit = unit, .values = one_band(values, bands, look.band)};
  if (!unit.empty()) field.title.push_back(unit);
  if (values.cols() > 1) field.title.push_back(band_title(bands, look.band));
  return field;
}

std::optional<ShownField> quantity_field(const Known& known, const Look& look) {
  if (!known.light) return std::nullopt;
  if (look.quantity == Quantity::error && !known.light->has_errors()) return std::nullopt;
  if (look.quantity == Quantity::temperature && known.light->solution.temperature.size() == 0) {
    return std::nullopt;
  }
  const QuantityField field =
      make_field(look.quantity, *known.model.mesh, known.light->solution, known.model.bands);
  std::string name(field.info.name);
  std::replace(name.begin(), name.end(), '-', ' ');
  if (look.quantity == Quantity::error) name = "error of radiosity (1 σ)";
  return banded(std::move(name), field.unit, field.values, known, look);
}

/// Irradiance straight from the emitters, or the rest.
std::optional<ShownField> direct_field(const Known& known, const Look& look) {
  if (!known.light || !known.model.transport) return std::nullopt;
  const radiosity::Solution& solution = known.light->solution;
  Eigen::MatrixXd direct = known.model.transport->apply(solution.exitance);
  if (known.light->mix) {
    const Eigen::MatrixXd outer = outer_irradiance(known.model, *known.light->mix);
    if (outer.size() > 0) direct += outer;
  }
  const std::string unit = radiosity::band_unit("W/m²", known.model.bands);
  if (look.show == Show::direct) return banded("direct irradiance", unit, direct, known, look);
  const Eigen::MatrixXd indirect = (solution.irradiance - direct).cwiseMax(0);
  return banded("indirect irradiance", unit, indirect, known, look);
}

/// What patches see of no surface, before any correction; negative where they see too much.
std::optional<ShownField> unseen_field(const Known& known) {
  if (!known.model.transport) return std::nullopt;
  const radiosity::AssemblyReport& report = known.model.transport->report();
  return ShownField{.title = {"unseen share: 1 − covered − Σ F", "before correction"},
                    .values = 1 - report.covered.array() - report.row_sums.array()};
}

std::optional<ShownField> row_field(const Known& known) {
  if (!known.row) return std::nullopt;
  return ShownField{.title = {fmt::format("form factor from patch {}", known.row->patch)},
                    .values = known.row->factors};
}

std::optional<ShownField> arriving_field(const Known& known, const Look& look) {
  const Model& model = known.model;
  if (!known.row || !known.light) return std::nullopt;
  const Index patch = known.row->patch;
  const Eigen::MatrixXd density =
      arrival_density(*model.mesh, known.row->factors, known.light->solution.radiosity);
  return banded(fmt::format("light sent to patch {}", patch),
                radiosity::band_unit("W/m² per m²", model.bands), density, known, look);
}

std::optional<ShownField> path_field(const Known& known, const Look& look) {
  const LightPath* path = known.light_path.get();
  if (path == nullptr) return std::nullopt;
  // Per area, so that the size of the patches does not show.
  const Eigen::Map<const Eigen::VectorXd> area(known.model.mesh->area.data(),
                                               known.model.mesh->size());
  const Eigen::MatrixXd density = area.cwiseInverse().asDiagonal() * path->importance;
  return banded(fmt::format("importance for patch {}", path->patch), "B there per W emitted, 1/m²",
                density, known, look);
}

}  // namespace

const std::vector<std::int32_t>* open_patches(const Known& known) {
  return known.model.transport ? &known.model.transport->report().open_patches : nullptr;
}

std::span<const ShowName> show_names() { return names(); }

std::optional<ShowName> show_named(std::string_view name) {
  std::string wanted(name);
  std::replace(wanted.begin(), wanted.end(), '_', '-');
  std::replace(wanted.begin(), wanted.end(), ' ', '-');
  if (wanted == "true-color") wanted = "true-colour";
  if (wanted == "lux") wanted = "illuminance";
  for (const ShowName& known : names()) {
    if (known.name == wanted) return known;
  }
  return std::nullopt;
}

std::string_view show_name(const Look& look) {
  for (const ShowName& known : names()) {
    if (known.show == look.show &&
        (known.show != Show::quantity || known.quantity == look.quantity))
      return known.name;
  }
  return "";
}

bool is_offered(const ShowName& name, const Session& session) {
  if (name.show == Show::quantity && name.quantity == Quantity::temperature) {
    return session.light() != nullptr && session.light()->solution.temperature.size() > 0;
  }
  if (name.show == Show::grid) return has_grids(session);
  const bool is_seen =
      name.show == Show::true_color ||
      (name.show == Show::quantity && radiosity::quantity_info(name.quantity).is_photometric);
  return !is_seen || !session.is_thermal();
}

bool is_smooth(const Look& look) {
  switch (look.show) {
    case Show::quantity:
      return look.smooth && look.quantity != Quantity::error && look.quantity != Quantity::power &&
             look.quantity != Quantity::luminous_flux && look.quantity != Quantity::reflectance;
    case Show::true_color:
    case Show::work_plane:
    case Show::grid:
    case Show::watched:
    case Show::direct:
    case Show::indirect:
      return look.smooth;
    case Show::area:
    case Show::unseen:
    case Show::form_factors:
    case Show::arriving:
    case Show::light_path:
    case Show::unshot:
      return false;
  }
  return false;
}

bool is_plane(Show show) { return show == Show::work_plane || show == Show::grid; }

bool is_wide(Show show) {
  return show == Show::form_factors || show == Show::arriving || show == Show::light_path;
}

const IterationFrame* watched_frame(const IterationRecord* record, const Look& look) {
  const bool is_shown = look.show == Show::watched || look.show == Show::unshot;
  if (!is_shown || record == nullptr || record->frames.empty()) return nullptr;
  return record->frames[std::min(look.step, record->frames.size() - 1)].get();
}

std::optional<ShownField> shown_field(const Known& known, const Look& look) {
  if (!known.model.mesh) return std::nullopt;
  switch (look.show) {
    case Show::true_color:
    case Show::work_plane:
    case Show::grid:
    case Show::watched:
      return std::nullopt;
    case Show::quantity:
      return quantity_field(known, look);
    case Show::area:
      return ShownField{.title = {"area", "m²"},
                        .unit = "m²",
                        .values = Eigen::Map<const Eigen::VectorXd>(known.model.mesh->area.data(),
                                                                    known.model.mesh->size())};
    case Show::unseen:
      return unseen_field(known);
    case Show::direct:
    case Show::indirect:
      return direct_field(known, look);
    case Show::form_factors:
      return row_field(known);
    case Show::arriving:
      return arriving_field(known, look);
    case Show::light_path:
      return path_field(known, look);
    case Show::unshot: {
      const IterationFrame* frame = watched_frame(known.iteration.get(), look);
      if (frame == nullptr) return std::nullopt;
      return banded("unshot radiosity", radiosity::band_unit("W/m²", known.model.bands),
                    frame->unshot.cast<double>(), known, look);
    }
  }
  return std::nullopt;
}

std::optional<Eigen::MatrixXd> shown_radiosity(const Known& known, const Look& look) {
  if (look.show == Show::watched) {
    const IterationFrame* frame = watched_frame(known.iteration.get(), look);
    if (frame != nullptr) return frame->radiosity.cast<double>();
  }
  if (!known.light) return std::nullopt;
  // Behind a work plane in heat there is nothing to see.
  const bool is_dark =
      is_plane(look.show) && known.model.scene && radiosity::is_thermal(*known.model.scene);
  if (is_dark) return std::nullopt;
  return known.light->solution.radiosity;
}

std::string band_title(const radiosity::Bands& bands, std::optional<Index> band) {
  if (!band || *band >= bands.count()) return fmt::format("mean of {} bands", bands.count());
  return radiosity::band_names(bands)[static_cast<std::size_t>(*band)];
}

}  // namespace viewer
