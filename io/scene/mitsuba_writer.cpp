#include "io/scene/mitsuba_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <string>
#include <unordered_map>

#include "io/base/atomic_file.h"
#include "io/base/printable.h"
#include "io/base/xml_escaped.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"

namespace io {
namespace {

namespace fs = std::filesystem;
using radiosity::Bands;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Scene;
using radiosity::Vec3;

/// Patches of each surface; of those that are back to back the front.
std::vector<std::vector<std::int32_t>> fronts_by_surface(const PatchMesh& mesh) {
  std::vector<std::vector<std::int32_t>> patches(mesh.surface_names.size());
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.twin[i] >= 0 && mesh.twin[i] < i) continue;
    patches[mesh.surface[i]].push_back(static_cast<std::int32_t>(i));
  }
  return patches;
}

fs::path mesh_path(const fs::path& path, std::size_t surface) {
  fs::path result = path;
  return result.replace_filename(path.stem().string() + fmt::format(".{}.ply", surface));
}

void write_surface_ply(const fs::path& path, const PatchMesh& mesh,
                       const std::vector<std::int32_t>& patches) {
  static_assert(std::endian::native == std::endian::little, "the header says little endian");
  std::unordered_map<std::int32_t, std::int32_t> local;
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  const auto vertex = [&](std::int32_t corner) {
    const auto [entry, is_new] =
        local.try_emplace(corner, static_cast<std::int32_t>(vertices.size()));
    if (is_new) vertices.push_back(mesh.vertices[corner]);
    return entry->second;
  };
  for (const std::int32_t patch : patches) {
    const auto& corners = mesh.corners[patch];
    for (int k = 2; k < mesh.n_corners(patch); ++k) {
      // In this order, so that vertices are numbered as they come.
      const std::int32_t a = vertex(corners[0]);
      const std::int32_t b = vertex(corners[k - 1]);
      triangles.push_back({a, b, vertex(corners[k])});
    }
  }
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\n"
        "property double y\nproperty double z\nelement face {}\n"
        "property list uchar int vertex_indices\nend_header\n",
        vertices.size(), triangles.size());
    for (const Vec3& point : vertices) {
      stream.write(reinterpret_cast<const char*>(point.data()), sizeof(double) * 3);
    }
    for (const auto& triangle : triangles) {
      stream.put(3);
      stream.write(reinterpret_cast<const char*>(triangle.data()), sizeof(triangle));
    }
  });
}

/// An element with the values of the bands.
std::string spectrum(const char* name, const Bands& bands, const Eigen::VectorXd& values) {
  std::string text;
  if (bands.kind == Bands::Kind::wavelengths && values.size() > 1) {
    for (Index k = 0; k < values.size(); ++k) {
      text += fmt::format("{}{}:{}", k == 0 ? "" : ", ", bands.wavelengths[k], values[k]);
    }
    return fmt::format("<spectrum name=\"{}\" value=\"{}\"/>", name, text);
  }
  for (Index k = 0; k < 3; ++k) {
    text += fmt::format("{}{}", k == 0 ? "" : ", ", values[values.size() == 3 ? k : 0]);
  }
  return fmt::format("<rgb name=\"{}\" value=\"{}\"/>", name, text);
}

/// What Mitsuba takes for an id, which has neither dots nor blanks.
std::string identifier(std::size_t surface, const std::string& name) {
  std::string result = fmt::format("surface-{}-", surface);
  for (const char letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    result += code < 0x80 && std::isalnum(code) != 0 ? letter : '_';
  }
  return result;
}

/// `text` between quotes of XML.
std::string escaped(const std::string& text) { return xml_escaped(printable(text)); }

std::string point(const char* name, const Vec3& value) {
  return fmt::format("{}=\"{}, {}, {}\"", name, value.x(), value.y(), value.z());
}

std::string sensor(const radiosity::Camera& camera, double size) {
  // Mitsuba shows nothing nearer or farther than these planes.
  const double near = 1e-4 * size;
  const double far = 1e4 * size;
  const double degrees = camera.vertical_fov * 180 / std::numbers::pi;
  return fmt::format(R"(  <sensor type="perspective">
    <string name="fov_axis" value="y"/>
    <float name="fov" value="{}"/>
    <float name="near_clip" value="{}"/>
    <float name="far_clip" value="{}"/>
    <transform name="to_world">
      <lookat {} {} {}/>
    </transform>
    <sampler type="independent">
      <integer name="sample_count" value="$spp"/>
    </sampler>
    <film type="hdrfilm">
      <integer name="width" value="$width"/>
      <integer name="height" value="$height"/>
      <rfilter type="box"/>
    </film>
  </sensor>
)",
                     degrees, near, far, point("origin", camera.position),
                     point("target", camera.position + size * camera.direction),
                     point("up", camera.up));
}

std::string shape(const fs::path& file, const std::string& id, const std::string& bsdf,
                  const std::string& emitter) {
  return fmt::format(R"(  <shape type="ply" id="{}">
    <string name="filename" value="{}"/>
    <boolean name="face_normals" value="true"/>
{}{}  </shape>
)",
                     id, escaped(file.filename().string()), bsdf, emitter);
}

std::string sun_emitter(const radiosity::Sun& sun, const Bands& bands) {
  const Vec3& d = sun.direction;
  return fmt::format(
      "  <emitter type=\"directional\">\n    <vector name=\"direction\" x=\"{}\" "
      "y=\"{}\" z=\"{}\"/>\n    {}\n  </emitter>\n",
      d.x(), d.y(), d.z(), spectrum("irradiance", bands, sun.irradiance));
}

std::string environment_emitter(const Eigen::VectorXd& exitance, const Bands& bands) {
  return "  <emitter type=\"constant\">" + spectrum("radiance", bands, exitance / radiosity::kPi) +
         "</emitter>\n";
}

void refuse_heats(const Scene& scene) {
  using Kind = radiosity::Emission::Kind;
  for (const radiosity::Surface& surface : scene.surfaces) {
    const Kind kind = scene.materials[surface.material].emission.kind;
    if (kind != Kind::heat_flux && kind != Kind::heat_power && surface.back_material < 0 &&
        !surface.is_shield) {
      continue;
    }
    throw radiosity::SceneError(printable(
        fmt::format("surface {} has a heat given, is a shield or has a back of its own, which "
                    "Mitsuba does not know",
                    in_quotes(surface.name))));
  }
}

std::string bsdf_of(const std::string& reflectance, bool is_two_sided) {
  const std::string diffuse = "<bsdf type=\"diffuse\">" + reflectance + "</bsdf>";
  return "    " + (is_two_sided ? "<bsdf type=\"twosided\">" + diffuse + "</bsdf>" : diffuse) +
         "\n";
}

}  // namespace

std::vector<fs::path> mitsuba_meshes(const fs::path& path, const PatchMesh& mesh) {
  const auto patches = fronts_by_surface(mesh);
  std::vector<fs::path> files;
  for (std::size_t s = 0; s < patches.size(); ++s) {
    if (!patches[s].empty()) files.push_back(mesh_path(path, s));
  }
  return files;
}

void write_mitsuba(const fs::path& path, const Scene& scene, const PatchMesh& mesh,
                   const radiosity::Camera& camera, const MitsubaOptions& options) {
  refuse_heats(scene);
  if (!scene.luminaires.empty()) {
    throw radiosity::SceneError(printable(
        fmt::format("luminaire {} has a photometric file, which is not written for Mitsuba",
                    in_quotes(scene.luminaires.front().name))));
  }
  if (scene.sky || std::any_of(scene.materials.begin(), scene.materials.end(),
                               [](const auto& material) { return material.glazing.has_value(); })) {
    throw radiosity::SceneError(printable(scene.source) +
                                ": a sky or glazing is not written for Mitsuba");
  }
  const auto patches = fronts_by_surface(mesh);
  const Eigen::MatrixXd radiance = radiosity::exitance(scene, mesh) / radiosity::kPi;
  const Eigen::MatrixXd reflectance = radiosity::reflectance(scene, mesh);
  const double size = radiosity::bounds(mesh).diagonal().norm() +
                      (camera.position - radiosity::bounds(mesh).center()).norm();
  std::string xml = fmt::format(R"(<scene version="3.0.0">
  <default name="spp" value="{}"/>
  <default name="width" value="{}"/>
  <default name="height" value="{}"/>
  <integrator type="path">
    <integer name="max_depth" value="-1"/>
  </integrator>
)",
                                options.samples, options.width, options.height) +
                    sensor(camera, size);
  for (std::size_t s = 0; s < patches.size(); ++s) {
    if (patches[s].empty()) continue;
    const Index first = patches[s].front();
    const bool is_two_sided = mesh.surface_two_sided[s];
    std::string emitter;
    if ((radiance.row(first).array() > 0).any()) {
      if (is_two_sided) {
        throw radiosity::SceneError(printable(fmt::format(
            "surface {} emits to both sides, which area lights of Mitsuba do not: write it as two "
            "one-sided surfaces a little apart",
            in_quotes(mesh.surface_names[s]))));
      }
      emitter = "    <emitter type=\"area\">" +
                spectrum("radiance", scene.bands, radiance.row(first)) + "</emitter>\n";
    }
    // Of one with a texture the mean, as in scenes that are saved.
    const radiosity::Material& material = scene.materials[scene.surfaces[s].material];
    const Eigen::VectorXd rho =
        material.texture ? material.reflectance : Eigen::VectorXd(reflectance.row(first));
    const std::string bsdf = bsdf_of(spectrum("reflectance", scene.bands, rho), is_two_sided);
    xml += shape(mesh_path(path, s), identifier(s, mesh.surface_names[s]), bsdf, emitter);
  }
  if (scene.sun) xml += sun_emitter(*scene.sun, scene.bands);
  const Eigen::VectorXd environment = radiosity::environment_exitance(scene);
  if (environment.size() > 0) xml += environment_emitter(environment, scene.bands);
  xml += "</scene>\n";
  for (std::size_t s = 0; s < patches.size(); ++s) {
    if (!patches[s].empty()) write_surface_ply(mesh_path(path, s), mesh, patches[s]);
  }
  write_stream_atomically(path, [&](std::ofstream& stream) { stream << xml; });
}

}  // namespace io
