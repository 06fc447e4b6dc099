#include "apps/summary/inspection_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "apps/summary/scene_text.h"
#include "apps/summary/text_table.h"
#include "apps/terminal/terminal_progress.h"
#include "radiosity/scene/luminaire_flux.h"
#include "radiosity/solve/quantity.h"

namespace apps {
namespace {

/// How many there are, and what they give in all.
std::string luminaires_text(const radiosity::Scene& scene) {
  double lumens = 0;
  for (const radiosity::Luminaire& luminaire : scene.luminaires) {
    lumens +=
        luminaire.dimming * undimmed_flux(luminaire, scene.photometries[luminaire.photometry]);
  }
  return fmt::format("{}, {:.6g} lm", scene.luminaires.size(), lumens);
}

std::string emission_text(const radiosity::Emission& emission, double factor,
                          const radiosity::Bands& bands) {
  using Kind = radiosity::Emission::Kind;
  if (emission.kind == Kind::none) return "-";
  std::string_view unit = "W/m²";
  if (emission.kind == Kind::radiance) unit = "W/(m² sr)";
  if (emission.kind == Kind::power || emission.kind == Kind::heat_power) unit = "W";
  if (emission.kind == Kind::temperature) unit = "K";
  std::string light;
  if (factor != 1) light = factor == 0 ? ", off" : fmt::format(", {:.4g} of it", factor);
  return fmt::format("{} {} {}{}", emission_name(emission.kind), numbers(emission.value),
                     radiosity::band_unit(unit, bands), light);
}

std::string surface_table(const radiosity::Scene& scene, const meshing::Inspection& inspection) {
  std::vector<Row> rows = {
      {"surface", "polygons", "area, m²", "material", "reflectance", "emission"}};
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const radiosity::Surface& surface = scene.surfaces[s];
    const radiosity::Material& material = scene.materials[surface.material];
    rows.push_back({one_line(surface.name) + (surface.two_sided ? " (two-sided)" : ""),
                    fmt::format("{}", inspection.surface_polygons[s]),
                    fmt::format("{:.4g}", inspection.surface_area[s]), one_line(material.name),
                    numbers(material.reflectance),
                    emission_text(material.emission, surface.emission_factor, scene.bands)});
  }
  return table(rows);
}

std::string bounds_text(const radiosity::Box3& box) {
  if (box.isEmpty()) return "empty";
  const radiosity::Vec3 size = box.sizes();
  return fmt::format(
      "{:.4g} x {:.4g} x {:.4g} m, from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, "
      "{:.4g})",
      size.x(), size.y(), size.z(), box.min().x(), box.min().y(), box.min().z(), box.max().x(),
      box.max().y(), box.max().z());
}

std::string finding_lines(const meshing::Inspection& inspection) {
  if (inspection.findings.empty()) return "no findings\n";
  std::string text;
  for (const meshing::Finding& finding : inspection.findings) {
    const std::string times = finding.count > 1 ? fmt::format(" ({} times)", finding.count) : "";
    text += fmt::format("{}: {}{}: {}\n", severity_name(finding.severity),
                        meshing::kind_name(finding.kind), times, one_line(finding.message));
  }
  return text;
}

}  // namespace

std::string inspect_text(const radiosity::Scene& scene, const meshing::Inspection& inspection,
                         const std::vector<std::string>& outputs) {
  std::string text = line("scene", one_line(scene.source));
  text += line("vertices", fmt::format("{}", inspection.n_vertices));
  text +=
      line("polygons", fmt::format("{}: {} triangles, {} quads, {} others", inspection.n_polygons,
                                   inspection.n_triangles, inspection.n_quads, inspection.n_other));
  text += line("area", fmt::format("{:.6g} m²", inspection.area));
  text += line("bounds", bounds_text(inspection.bounds));
  text += line("precision", scene.precision > 0 ? fmt::format("coordinates are rounded to {:.1g} m",
                                                              scene.precision)
                                                : "coordinates are exact");
  if (!scene.symmetry.is_none()) {
    text += line("symmetry", fmt::format("one part of a whole of {}", n_parts(scene)));
  }
  text += line("closed",
               fmt::format("{}: light {} ({} boundary edges)", inspection.closed ? "yes" : "no",
                           inspection.closed ? "meets fronts only" : "escapes or meets backs",
                           inspection.n_boundary_edges));
  text += line("bands", fmt::format("{}", fmt::join(band_names(scene.bands), ", ")));
  if (!scene.luminaires.empty()) text += line("luminaires", luminaires_text(scene));
  text += surface_table(scene, inspection) + finding_lines(inspection);
  for (const std::string& output : outputs) text += line("written", one_line(output));
  return text;
}

}  // namespace apps
