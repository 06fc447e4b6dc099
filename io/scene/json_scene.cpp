#include "io/scene/json_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "io/base/json_item.h"
#include "io/base/line_reader.h"
#include "io/scene/json_glazing.h"
#include "io/scene/json_light_plan.h"
#include "io/scene/json_luminaires.h"
#include "io/scene/json_materials.h"
#include "io/scene/json_sky.h"
#include "io/scene/json_sun.h"
#include "io/scene/json_surfaces.h"
#include "io/scene/json_symmetry.h"
#include "io/scene/scene_keys.h"

namespace io {
namespace {

using radiosity::Bands;
using radiosity::Camera;
using radiosity::kPi;
using radiosity::Scene;
using radiosity::Vec3;

/// Sine of the angle between `up` and the view below which they count as parallel.
constexpr double kParallel = 1e-6;

double read_wavelength(const JsonItem& item) {
  const double wavelength = item.number();
  if (!(wavelength > 0)) item.fail(fmt::format("wavelength {} is not positive", wavelength));
  return wavelength;
}

/// Increasing ones, of any unit.
std::vector<double> read_wavelengths(const JsonItem& item) {
  std::vector<double> wavelengths;
  for (std::size_t i = 0; i < item.size(); ++i) {
    const double wavelength = read_wavelength(item[i]);
    if (i > 0 && !(wavelength > wavelengths.back())) {
      item[i].fail(fmt::format("wavelength {} does not follow {}, expected increasing ones",
                               wavelength, wavelengths.back()));
    }
    wavelengths.push_back(wavelength);
  }
  return wavelengths;
}

/// Bands of heat with their edges.
Bands read_heat_bands(const JsonItem& item) {
  item.check_keys(keys::kBands);
  if (item.has("thermal") == item.has("split_wavelength")) {
    item.fail("expected either \"thermal\" or \"split_wavelength\"");
  }
  Bands bands;
  if (const auto split = item.find("split_wavelength")) {
    bands.kind = Bands::Kind::solar_infrared;
    bands.edges = {read_wavelength(*split)};
    return bands;
  }
  bands.kind = Bands::Kind::thermal;
  bands.edges = read_wavelengths(item.at("thermal"));
  if (bands.edges.empty()) item.at("thermal").fail("has no wavelengths");
  return bands;
}

Bands read_bands(const JsonItem& item) {
  Bands bands;
  if (item.value().is_object()) return read_heat_bands(item);
  if (item.value().is_string()) {
    const std::string name = item.text();
    if (name != "rgb" && name != "grey" && name != "solar-infrared") {
      item.fail(
          fmt::format("found \"{}\", expected \"rgb\", \"grey\", \"solar-infrared\", "
                      "wavelengths in nm or an object",
                      name));
    }
    bands.kind = name == "rgb"    ? Bands::Kind::rgb
                 : name == "grey" ? Bands::Kind::grey
                                  : Bands::Kind::solar_infrared;
    return bands;
  }
  bands.kind = Bands::Kind::wavelengths;
  bands.wavelengths = read_wavelengths(item);
  if (bands.wavelengths.empty()) item.fail("has no wavelengths");
  return bands;
}

double positive(const JsonItem& item) {
  const double number = item.number();
  if (!(number > 0)) item.fail(fmt::format("is {}, expected more than 0", number));
  return number;
}

/// Height of the film: a number for a square one, or [width, height].
double film_height(const JsonItem& film) {
  if (film.value().is_number()) return positive(film);
  if (film.size() != 2) film.fail("expected a number or [width, height]");
  (void)positive(film[0]);
  return positive(film[1]);
}

double read_vertical_fov(const JsonItem& camera) {
  if (const auto degrees = camera.find("vertical_fov_deg")) {
    if (camera.has("focal_length") || camera.has("film")) {
      camera.fail("expected either \"vertical_fov_deg\" or \"focal_length\" and \"film\"");
    }
    const double angle = degrees->number();
    if (!(angle > 0 && angle < 180)) degrees->fail(fmt::format("{} is outside (0, 180)", angle));
    return angle * kPi / 180;
  }
  if (!camera.has("focal_length") && !camera.has("film")) return Camera().vertical_fov;
  return 2 * std::atan(film_height(camera.at("film")) / 2 / positive(camera.at("focal_length")));
}

Vec3 read_view_direction(const JsonItem& camera, const Vec3& position) {
  if (camera.has("look_at") == camera.has("direction")) {
    camera.fail("expected either \"look_at\" or \"direction\"");
  }
  if (const auto direction = camera.find("direction")) return direction->direction();
  const Vec3 view = camera.at("look_at").point() - position;
  const double length = view.stableNorm();
  if (!(length > 0)) camera.at("look_at").fail("is the camera's position");
  return view / length;
}

Camera read_camera(const JsonItem& item, double unit) {
  item.check_keys(keys::kCamera);
  Camera camera;
  camera.position = item.at("position").point();
  camera.direction = read_view_direction(item, camera.position);
  camera.position *= unit;
  camera.vertical_fov = read_vertical_fov(item);
  const auto up = item.find("up");
  camera.up = up ? up->direction() : Vec3(0, 1, 0);
  if (camera.up.cross(camera.direction).norm() > kParallel) return camera;
  if (up) up->fail("is parallel to the viewing direction");
  camera.up = Vec3(0, 0, 1);  // looking straight up or down, with the usual up
  return camera;
}

/// Cameras by name.
std::vector<radiosity::View> read_views(const JsonItem& item, double unit) {
  if (!item.value().is_object()) item.fail("expected an object of cameras by name");
  std::vector<radiosity::View> views;
  for (const auto& [name, camera] : item.value().items()) {
    if (name.empty()) item.fail("has a view without a name");
    views.push_back({name, read_camera(item.at(name), unit)});
  }
  return views;
}

/// The files that "csv" names in the materials, or in a part of them.
void add_spectra(const Json& part, const std::filesystem::path& folder, Scene& scene) {
  if (!part.is_structured()) return;
  for (const auto& [key, value] : part.items()) {
    if (key == "csv" && value.is_string()) {
      scene.files.push_back(folder / value.get<std::string>());
    } else {
      add_spectra(value, folder, scene);
    }
  }
}

double scene_unit(const JsonItem& root, const ReadOptions& options) {
  const auto unit = root.find("unit");
  const double metres = unit ? read_unit(*unit) : 1.0;
  return options.unit ? metres_per_unit(*options.unit) : metres;
}

/// What the scene says in its unit.
std::optional<double> given_precision(const JsonItem& root) {
  const auto item = root.find("precision");
  if (!item) return std::nullopt;
  const double precision = item->number();
  if (!(precision >= 0)) item->fail(fmt::format("is {}, expected no negative number", precision));
  return precision;
}

}  // namespace

FileScene read_json_scene(const std::filesystem::path& path, const ReadOptions& options) {
  const Json json = parse_json(path);
  const JsonItem root(json, path);
  root.check_keys(keys::kScene);
  if (const auto schema = root.find("$schema")) (void)schema->text();
  const double unit = scene_unit(root, options);
  FileScene file;
  Scene& scene = file.scene;
  scene.source = path.string();
  if (const auto name = root.find("name")) scene.name = name->text();
  if (const auto description = root.find("description")) scene.description = description->text();
  if (const auto bands = root.find("bands")) scene.bands = read_bands(*bands);
  if (const auto materials = root.find("materials")) {
    scene.materials = read_materials(*materials, scene.bands, path.parent_path());
    add_glazing(*materials, path.parent_path(), scene);
    add_spectra(materials->value(), path.parent_path(), scene);
  }
  if (const auto environment = root.find("environment")) {
    scene.environment = read_environment(*environment, scene.bands, path.parent_path());
    add_spectra(environment->value(), path.parent_path(), scene);
  }
  add_surfaces(root.at("surfaces"), path.parent_path(), unit, options.progress, file);
  if (const auto precision = given_precision(root)) scene.precision = unit * *precision;
  if (const auto camera = root.find("camera")) scene.camera = read_camera(*camera, unit);
  if (const auto sun = root.find("sun")) {
    read_sun(*sun, path.parent_path(), scene);
    add_spectra(sun->value(), path.parent_path(), scene);
  }
  if (const auto luminaires = root.find("luminaires")) {
    read_luminaires(*luminaires, path.parent_path(), unit, options.progress, scene);
    add_spectra(luminaires->value(), path.parent_path(), scene);
  }
  if (const auto sky = root.find("sky")) {
    read_sky(*sky, path.parent_path(), scene);
    add_spectra(sky->value(), path.parent_path(), scene);
  }
  if (const auto views = root.find("views")) scene.views = read_views(*views, unit);
  read_light_plan(root, path.parent_path(), unit, scene);
  if (const auto closed = root.find("closed")) scene.closed = closed->boolean();
  if (const auto warning = temperature_warning(scene)) {
    scene.warnings.push_back(scene.source + ": " + *warning);
  }
  if (const auto symmetry = root.find("symmetry")) scene.symmetry = read_symmetry(*symmetry, unit);
  if (scene.n_polygons() == 0) fail(path, "has no polygons");
  if (!scene.luminaires.empty() && !scene.symmetry.is_none()) {
    fail(path, "has both luminaires and a symmetry, whose images they would light otherwise");
  }
  if (scene.sun && !scene.symmetry.is_none()) {
    fail(path, "has both a sun and a symmetry, whose images it would shine upon otherwise");
  }
  if (scene.sky && !scene.symmetry.is_none()) {
    fail(path, "has both a sky and a symmetry, on whose images it would be another one");
  }
  return file;
}

}  // namespace io
