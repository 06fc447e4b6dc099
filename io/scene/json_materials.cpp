#include "io/scene/json_materials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "io/base/input_checks.h"
#include "io/scene/json_light_plan.h"
#include "io/scene/scene_keys.h"
#include "io/scene/spectrum.h"
#include "radiosity/scene/celsius.h"
#include "radiosity/scene/emissivity_table.h"

namespace io {
namespace {

using radiosity::Bands;
using radiosity::Emission;
using radiosity::Material;

constexpr double kCelsius = 273.15;  // 0 °C, K

/// What is wrong with values, if anything.
using ValueCheck = std::function<std::optional<std::string>(const Eigen::VectorXd&)>;

Eigen::VectorXd read_csv(const JsonItem& item, const Bands& bands,
                         const std::filesystem::path& folder, const ValueCheck& check) {
  item.check_keys(keys::kSpectrum);
  if (bands.kind != Bands::Kind::wavelengths) {
    item.fail("a spectrum needs \"bands\" given as wavelengths");
  }
  const std::string file = item.at("csv").text();
  const Spectrum spectrum =
      read_spectrum(folder / file, item.at("column").text(),
                    [&](double value) { return check(Eigen::VectorXd::Constant(1, value)); });
  const auto& x = spectrum.wavelengths;
  if (bands.wavelengths.front() < x.front() || bands.wavelengths.back() > x.back()) {
    item.fail(fmt::format("{} covers {} to {} nm, expected to cover the bands, {} to {} nm", file,
                          x.front(), x.back(), bands.wavelengths.front(),
                          bands.wavelengths.back()));
  }
  return interpolate(spectrum, bands.wavelengths);
}

/// One value per band from a number or a list.
Eigen::VectorXd read_numbers(const JsonItem& item, const Bands& bands) {
  if (!item.value().is_array()) return Eigen::VectorXd::Constant(bands.count(), item.number());
  if (static_cast<Eigen::Index>(item.size()) != bands.count()) {
    item.fail(
        fmt::format("found {} values, expected {}, one per band", item.size(), bands.count()));
  }
  Eigen::VectorXd values(bands.count());
  for (std::size_t k = 0; k < item.size(); ++k) {
    values[static_cast<Eigen::Index>(k)] = item[k].number();
  }
  return values;
}

/// The same, or from a reference to a CSV column; checked.
Eigen::VectorXd read_values(const JsonItem& item, const Bands& bands,
                            const std::filesystem::path& folder, const ValueCheck& check) {
  if (item.value().is_object()) return read_csv(item, bands, folder, check);
  Eigen::VectorXd values = read_numbers(item, bands);
  if (const auto problem = check(values)) item.fail(*problem);
  return values;
}

/// A number in [0, 1].
double read_share(const JsonItem& item, std::string_view name) {
  const double share = item.number();
  if (!(share >= 0 && share <= 1)) item.fail(fmt::format("{} {} is outside [0, 1]", name, share));
  return share;
}

/// Of what a material is to the sun's light and to thermal radiation.
Eigen::VectorXd read_solar_infrared(const JsonItem& material, const Bands& bands) {
  if (bands.kind != Bands::Kind::solar_infrared) {
    material.fail("\"solar\" and \"infrared\" need \"bands\": \"solar-infrared\"");
  }
  for (const std::string_view key : {"reflectance", "emissivity"}) {
    if (material.has(key)) {
      material.fail(fmt::format("expected either \"solar\" and \"infrared\" or \"{}\"", key));
    }
  }
  const JsonItem solar = material.at("solar");
  const JsonItem infrared = material.at("infrared");
  solar.check_keys(keys::kSolar);
  infrared.check_keys(keys::kInfrared);
  return Eigen::Vector2d(1 - read_share(solar.at("absorptivity"), "absorptivity"),
                         1 - read_share(infrared.at("emissivity"), "emissivity"));
}

/// Whether it is a list of pairs, of a temperature and the emissivity at it.
bool is_table(const JsonItem& emissivity) {
  return emissivity.value().is_array() && emissivity.size() > 0 && emissivity[0].value().is_array();
}

std::vector<std::pair<double, double>> read_emissivity_table(const JsonItem& item,
                                                             const Bands& bands) {
  if (bands.kind != Bands::Kind::grey) {
    item.fail("an emissivity by temperature needs \"bands\": \"grey\"");
  }
  if (item.size() < 2) item.fail("has one pair, expected at least two");
  std::vector<std::pair<double, double>> table;
  for (std::size_t k = 0; k < item.size(); ++k) {
    const JsonItem pair = item[k];
    if (pair.size() != 2) pair.fail("expected a pair of a temperature, K, and an emissivity");
    const double kelvin = pair[0].number();
    const double emissivity = pair[1].number();
    if (kelvin < 0) pair.fail(fmt::format("temperature is {} K, below absolute zero", kelvin));
    if (!table.empty() && !(kelvin > table.back().first)) {
      pair.fail(fmt::format("temperature {} K does not follow {} K, expected increasing ones",
                            kelvin, table.back().first));
    }
    if (!(emissivity > 0 && emissivity <= 1)) {
      pair.fail(fmt::format("emissivity {} is outside (0, 1]", emissivity));
    }
    table.emplace_back(kelvin, emissivity);
  }
  return table;
}

Eigen::VectorXd read_reflectance(const JsonItem& material, const Bands& bands,
                                 const std::filesystem::path& folder) {
  if (material.has("solar") || material.has("infrared")) {
    return read_solar_infrared(material, bands);
  }
  if (material.has("reflectance") == material.has("emissivity")) {
    material.fail("expected either \"reflectance\" or \"emissivity\"");
  }
  if (const auto item = material.find("reflectance")) {
    return read_values(*item, bands, folder, reflectance_problem);
  }
  const JsonItem item = material.at("emissivity");
  // Of a table the temperature, which is read later, tells.
  if (is_table(item)) return Eigen::VectorXd::Zero(bands.count());
  if (!item.value().is_array()) {
    return Eigen::VectorXd::Constant(bands.count(), 1 - read_share(item, "emissivity"));
  }
  Eigen::VectorXd result = read_numbers(item, bands);
  for (std::size_t k = 0; k < item.size(); ++k) {
    result[static_cast<Eigen::Index>(k)] = 1 - read_share(item[k], "emissivity");
  }
  return result;
}

Emission::Kind emission_kind(std::string_view key) {
  if (key == "radiance") return Emission::Kind::radiance;
  if (key == "exitance") return Emission::Kind::exitance;
  if (key == "power") return Emission::Kind::power;
  if (key == "heat_flux" || key == "adiabatic") return Emission::Kind::heat_flux;
  if (key == "heat_power") return Emission::Kind::heat_power;
  return Emission::Kind::temperature;
}

void require_grey(const JsonItem& item, const char* what, const Bands& bands) {
  if (bands.kind == Bands::Kind::grey) return;
  if (bands.hold_heat()) {
    item.fail(
        fmt::format("{} needs \"bands\": \"grey\": the temperature that follows would couple "
                    "the bands, which is not reckoned with",
                    what));
  }
  item.fail(fmt::format("{} needs \"bands\": \"grey\", which then is all thermal radiation", what));
}

double read_temperature(const JsonItem& item) {
  const double kelvin = item.number();
  if (kelvin < 0) {
    item.fail(fmt::format(
        "temperature is {:g} K, below absolute zero, expected kelvin; {:g} °C are {:g} K", kelvin,
        kelvin, kelvin + kCelsius));
  }
  return kelvin;
}

bool is_heat(const Emission& emission) {
  return emission.kind == Emission::Kind::heat_flux || emission.kind == Emission::Kind::heat_power;
}

Emission read_emission_value(const JsonItem& item, std::string_view key, const Bands& bands,
                             const std::filesystem::path& folder) {
  const ValueCheck check = [&](const Eigen::VectorXd& value) {
    return emission_problem(std::string(key), value);
  };
  Emission emission{.kind = emission_kind(key), .value = {}};
  if (emission.kind == Emission::Kind::temperature) {
    if (!bands.hold_heat()) {
      item.fail(
          "a temperature needs \"bands\": \"grey\", which then is all thermal radiation, or "
          "bands of heat");
    }
    emission.value = Eigen::VectorXd::Constant(1, read_temperature(item));
  } else if (is_heat(emission)) {
    require_grey(item, "heat", bands);
    if (key == "adiabatic" && !item.boolean()) item.fail("is false, expected true or no such key");
    emission.value = Eigen::VectorXd::Constant(1, key == "adiabatic" ? 0 : item.number());
  } else {
    emission.value = read_values(item, bands, folder, check);
  }
  return emission;
}

/// The emission given by at most one key, in the material itself or in its "emission".
Emission read_emission(const JsonItem& material, const Bands& bands,
                       const std::filesystem::path& folder) {
  const auto nested = material.find("emission");
  if (nested) nested->check_keys(keys::kEmission);
  Emission emission;
  std::string_view first;
  for (const std::string_view key : keys::kEmission) {
    for (const JsonItem* place : {&material, nested ? &*nested : nullptr}) {
      if (place == nullptr || !place->has(key)) continue;
      if (!first.empty()) {
        material.fail(fmt::format("emission is given twice, by \"{}\" and by \"{}\"", first, key));
      }
      first = key;
      emission = read_emission_value(place->at(key), key, bands, folder);
    }
  }
  if (nested && first.empty()) {
    nested->fail(fmt::format("expected one of {}", fmt::join(keys::kEmission, ", ")));
  }
  return emission;
}

Material read_material(const JsonItem& item, const std::string& name, const Bands& bands,
                       const std::filesystem::path& folder) {
  item.check_keys(keys::kMaterial);
  if (const auto description = item.find("description")) (void)description->text();
  Material material{.name = name,
                    .reflectance = read_reflectance(item, bands, folder),
                    .emission = read_emission(item, bands, folder)};
  if (const auto emissivity = item.find("emissivity"); emissivity && is_table(*emissivity)) {
    material.emissivity_table = read_emissivity_table(*emissivity, bands);
    const bool is_known = material.emission.kind == Emission::Kind::temperature;
    const double kelvin = is_known ? material.emission.value[0] : radiosity::kUsualTemperature;
    material.reflectance[0] = 1 - radiosity::emissivity_at(material, kelvin);
  }
  if (needs_emissivity(material.emission) && material.reflectance.minCoeff() == 1) {
    item.fail(
        "emissivity 0 with a temperature or heat that it cannot give off; expected more than 0, or "
        "\"adiabatic\": true");
  }
  if (const auto factor = item.find("maintenance_factor")) {
    material.maintenance_factor = read_maintenance_factor(*factor);
  }
  return material;
}

}  // namespace

Emission read_environment(const JsonItem& item, const Bands& bands,
                          const std::filesystem::path& folder) {
  item.check_keys(keys::kEnvironment);
  if (item.value().size() != 1) {
    item.fail(fmt::format("expected one of {}", fmt::join(keys::kEnvironment, ", ")));
  }
  const std::string key = item.value().begin().key();
  return read_emission_value(item.at(key), key, bands, folder);
}

std::optional<std::string> temperature_warning(const radiosity::Scene& scene) {
  std::vector<const Emission*> emissions = {&scene.environment};
  for (const Material& material : scene.materials) emissions.push_back(&material.emission);
  std::vector<double> kelvins;
  for (const Emission* emission : emissions) {
    if (emission->kind == Emission::Kind::temperature) kelvins.push_back(emission->value[0]);
  }
  return radiosity::celsius_warning(kelvins);
}

Eigen::VectorXd read_band_values(const JsonItem& item, const std::string& name, const Bands& bands,
                                 const std::filesystem::path& folder) {
  return read_values(item, bands, folder,
                     [&](const Eigen::VectorXd& value) { return emission_problem(name, value); });
}

Eigen::VectorXd read_reflectances(const JsonItem& item, const Bands& bands,
                                  const std::filesystem::path& folder) {
  return read_values(item, bands, folder, reflectance_problem);
}

std::vector<Material> read_materials(const JsonItem& materials, const Bands& bands,
                                     const std::filesystem::path& folder) {
  std::vector<Material> result;
  if (materials.value().is_object()) {
    for (const auto& [name, unused] : materials.value().items()) {
      const JsonItem item = materials.at(name);
      if (item.has("name") && item.at("name").text() != name) {
        item.fail(fmt::format("is named \"{}\" inside", item.at("name").text()));
      }
      result.push_back(read_material(item, name, bands, folder));
    }
    return result;
  }
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const JsonItem item = materials[i];
    const std::string name = item.at("name").text();
    if (std::any_of(result.begin(), result.end(), [&](const auto& m) { return m.name == name; })) {
      item.fail(fmt::format("a material named \"{}\" exists already", name));
    }
    result.push_back(read_material(item, name, bands, folder));
  }
  return result;
}

}  // namespace io
