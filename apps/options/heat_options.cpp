#include "apps/options/heat_options.h"

#include <CLI/App.hpp>
#include <utility>

#include "io/result/given_heat_file.h"

namespace apps {

void add_heat_options(CLI::App& command, HeatOptions& options) {
  command
      .add_option("--temperatures", options.temperatures,
                  "Temperatures of single patches or polygons, K, in place of their materials': "
                  ".csv with columns patch or polygon and temperature, or cell data of a .vtp or "
                  ".vtu; a result of solve will do")
      ->type_name("FILE");
  command
      .add_option("--heat-fluxes", options.heat_fluxes,
                  "Likewise what they give off on balance, W/m2 (heat_flux)")
      ->type_name("FILE");
}

void give_heat(const HeatOptions& options, radiosity::Scene& scene,
               const radiosity::Progress& progress) {
  using Kind = radiosity::GivenHeat::Kind;
  for (const auto& [file, kind] : {std::pair(options.temperatures, Kind::temperature),
                                   std::pair(options.heat_fluxes, Kind::heat_flux)}) {
    if (!file) continue;
    scene.given_heat.push_back(io::read_given_heat(*file, kind, progress));
    scene.files.emplace_back(*file);
  }
}

}  // namespace apps
