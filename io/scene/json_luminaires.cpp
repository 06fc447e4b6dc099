#include "io/scene/json_luminaires.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "io/base/printable.h"
#include "io/light/photometric_file.h"
#include "io/scene/json_light_plan.h"
#include "io/scene/json_materials.h"
#include "io/scene/light_factor.h"
#include "io/scene/scene_keys.h"
#include "radiosity/scene/luminaire_flux.h"
#include "radiosity/solve/quantity.h"

namespace io {
namespace {

using radiosity::kPi;
using radiosity::Luminaire;
using radiosity::Scene;
using radiosity::Vec3;

/// Sine of the angle between directions below which they count as parallel.
constexpr double kSameDirection = 1e-6;
/// More luminaires than that are a mistake of an array.
constexpr double kMostLuminaires = 10000;
constexpr double kMostDistance = 1e9;  // m

double radians(const JsonItem& item) { return item.number() * kPi / 180; }

/// Index of the file's photometry; it is read if no luminaire before has it.
int photometry_of(const JsonItem& item, const std::filesystem::path& folder,
                  const radiosity::Progress& progress, Scene& scene) {
  const std::filesystem::path path = folder / item.text();
  const auto known = std::find_if(scene.photometries.begin(), scene.photometries.end(),
                                  [&](const auto& other) { return other.file == path; });
  if (known != scene.photometries.end()) {
    return static_cast<int>(known - scene.photometries.begin());
  }
  scene.photometries.push_back(read_photometric_file(path, progress));
  scene.files.push_back(path);
  const auto& warnings = scene.photometries.back().warnings;
  scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
  return static_cast<int>(scene.photometries.size()) - 1;
}

/// Turns about the scene's axes, x first, from how a luminaire hangs.
Eigen::Matrix3d read_rotations(const JsonItem& item) {
  const Vec3 degrees = item.point();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (int k = 0; k < 3; ++k) {
    axes = Eigen::AngleAxisd(degrees[k] * kPi / 180, Vec3::Unit(k)).toRotationMatrix() * axes;
  }
  return axes;
}

/// Where the axis points: straight down if nothing is said.
Vec3 read_axis(const JsonItem& item, const Vec3& position, double unit, const Vec3& up) {
  if (const auto direction = item.find("direction")) return direction->direction();
  const auto aim = item.find("aim");
  if (!aim) return -up;
  const Vec3 way = unit * aim->point() - position;
  const double length = way.stableNorm();
  if (!(length > 0)) aim->fail("is the luminaire's position");
  return way / length;
}

Eigen::Matrix3d read_axes(const JsonItem& item, const Vec3& position, double unit) {
  const int n_given = static_cast<int>(item.has("aim")) + static_cast<int>(item.has("direction")) +
                      static_cast<int>(item.has("rotations_deg"));
  if (n_given > 1) item.fail("expected one of \"aim\", \"direction\" and \"rotations_deg\"");
  if (const auto rotations = item.find("rotations_deg")) {
    for (const char* key : {"up", "turn_deg", "c0"}) {
      if (item.has(key)) item.at(key).fail("does not go with \"rotations_deg\"");
    }
    return read_rotations(*rotations);
  }
  const auto up_item = item.find("up");
  const Vec3 up = up_item ? up_item->direction() : Vec3(0, 0, 1);
  const Vec3 axis = read_axis(item, position, unit, up);
  const auto turn = item.find("turn_deg");
  if (const auto c0_item = item.find("c0")) {
    if (turn) turn->fail("does not go with \"c0\"");
    const Vec3 c0 = c0_item->direction();
    if (!(axis.cross(c0).norm() > kSameDirection)) c0_item->fail("is parallel to the axis");
    return radiosity::aimed_axes(axis, c0);
  }
  const Vec3 east = radiosity::usual_north(up).cross(up);
  return radiosity::aimed_axes(axis, turn ? radians(*turn) : 0, up, east);
}

/// What one lumen has in each band: such that the bands' luminous weights make one lumen of it.
Eigen::VectorXd read_watts_per_lumen(const JsonItem& item, const std::filesystem::path& folder,
                                     const Scene& scene) {
  const auto spectrum = item.find("spectrum");
  if (const auto watts = item.find("watts_per_lumen")) {
    if (spectrum) spectrum->fail("does not go with \"watts_per_lumen\"");
    return read_band_values(*watts, "watts_per_lumen", scene.bands, folder);
  }
  const Eigen::VectorXd shape = spectrum
                                    ? read_band_values(*spectrum, "spectrum", scene.bands, folder)
                                    : Eigen::VectorXd::Ones(scene.bands.count()).eval();
  const double lumens = radiosity::luminous_weights(scene.bands).dot(shape);
  if (lumens > 0) return shape / lumens;
  item.fail(
      "has no light that is seen in the scene's bands, so that its lumens are no watts: expected "
      "\"watts_per_lumen\"");
}

double read_positive(const JsonItem& item) {
  const double value = item.number();
  if (!(value > 0)) item.fail(fmt::format("is {}, expected more than 0", value));
  return value;
}

long read_number(const JsonItem& item, double most) {
  const double value = item.number();
  if (value != std::floor(value) || !(value >= 1) || !(value <= most)) {
    item.fail(fmt::format("found {}, expected a whole number from 1 to {}", value, most));
  }
  return static_cast<long>(value);
}

/// Rows and columns of luminaires, the first of which stands where its position says.
struct LuminaireArray {
  long n_rows = 1;
  long n_columns = 1;
  Vec3 row_step = Vec3::Zero();
  Vec3 column_step = Vec3::Zero();
};

LuminaireArray read_array(const JsonItem& item, double unit) {
  item.check_keys(keys::kLuminaireArray);
  LuminaireArray array;
  const auto read = [&](const char* number, const char* step, long& n, Vec3& way) {
    if (const auto count = item.find(number)) n = read_number(*count, kMostLuminaires);
    if (const auto given = item.find(step)) way = unit * given->point();
    if (n > 1 && way.isZero(0)) {
      item.fail(fmt::format("{} {} without a \"{}\" would all be in one place", n, number, step));
    }
  };
  read("rows", "row_step", array.n_rows, array.row_step);
  read("columns", "column_step", array.n_columns, array.column_step);
  return array;
}

/// Points along both sides of the luminous opening.
std::array<int, 2> read_points(const JsonItem& item, const radiosity::Photometry& photometry) {
  constexpr double kMostPoints = 100;
  if (item.size() != 2) item.fail("expected two numbers: along C0, and along C90");
  const std::array extents{photometry.along_c0, photometry.along_c90};
  std::array<int, 2> points{};
  for (std::size_t k = 0; k < 2; ++k) {
    points[k] = static_cast<int>(read_number(item[k], kMostPoints));
    if (points[k] > 1 && extents[k] == 0) {
      item[k].fail(
          fmt::format("has {} points of a luminous opening that has no extent there", points[k]));
    }
  }
  return points;
}

void add_luminaire(Luminaire luminaire, const JsonItem& item, Scene& scene) {
  const bool is_new = std::none_of(scene.luminaires.begin(), scene.luminaires.end(),
                                   [&](const auto& other) { return other.name == luminaire.name; });
  if (!is_new) item.at("name").fail("is the name of another luminaire, too: " + luminaire.name);
  scene.luminaires.push_back(std::move(luminaire));
}

/// Finds luminaires of an item that are tilted further than what the file of theirs tells of.
class TiltCheck {
 public:
  void add(const Luminaire& luminaire, const radiosity::Photometry& photometry) {
    if (photometry.tilt.angles.empty()) return;
    const double last = photometry.tilt.angles.back();
    const double angle = radiosity::tilt_angle(luminaire);
    if (angle > last + kRounding && angle > angle_) {
      angle_ = angle;
      last_ = last;
    }
  }
  void report(const std::string& name, Scene& scene) const {
    if (angle_ == 0) return;
    constexpr double kDegrees = 180 / radiosity::kPi;
    scene.warnings.push_back(
        fmt::format("{}: luminaire {} is tilted by {:.4g} degrees, but the TILT table of its file "
                    "ends at {:.4g}; the last factor counts",
                    scene.source, in_quotes(name), angle_ * kDegrees, last_ * kDegrees));
  }

 private:
  static constexpr double kRounding = 1e-9;
  double angle_ = 0;
  double last_ = 0;
};

void read_luminaire(const JsonItem& item, const std::filesystem::path& folder, double unit,
                    const radiosity::Progress& progress, Scene& scene) {
  item.check_keys(keys::kLuminaire);
  Luminaire luminaire;
  luminaire.name = item.at("name").text();
  const Vec3 first = unit * item.at("position").point();
  LuminaireArray array;
  const auto array_item = item.find("array");
  if (array_item) array = read_array(*array_item, unit);
  if (static_cast<double>(array.n_rows) * static_cast<double>(array.n_columns) > kMostLuminaires) {
    array_item->fail(fmt::format("has {} x {} luminaires, more than {}", array.n_rows,
                                 array.n_columns, kMostLuminaires));
  }
  luminaire.photometry = photometry_of(item.at("file"), folder, progress, scene);
  if (const auto lumens = item.find("lumens")) {
    luminaire.lumens = read_positive(*lumens);
  }
  if (const auto dimming = item.find("dimming")) luminaire.dimming = read_light_factor(*dimming);
  if (const auto factor = item.find("maintenance_factor")) {
    luminaire.maintenance_factor = read_maintenance_factor(*factor);
  }
  if (const auto up = item.find("up")) luminaire.up = up->direction();
  luminaire.watts_per_lumen = read_watts_per_lumen(item, folder, scene);
  if (const auto points = item.find("points")) {
    luminaire.divisions = read_points(*points, scene.photometries[luminaire.photometry]);
  }
  const std::string name = luminaire.name;
  TiltCheck tilted_too_far;
  for (long row = 0; row < array.n_rows; ++row) {
    for (long column = 0; column < array.n_columns; ++column) {
      luminaire.position = first + static_cast<double>(row) * array.row_step +
                           static_cast<double>(column) * array.column_step;
      if (!(luminaire.position.lpNorm<Eigen::Infinity>() <= kMostDistance)) {
        item.at("position")
            .fail(fmt::format("is more than {:g} m away, expected metres", kMostDistance));
      }
      luminaire.axes = read_axes(item, luminaire.position, unit);
      tilted_too_far.add(luminaire, scene.photometries[luminaire.photometry]);
      if (array_item) luminaire.name = fmt::format("{}-{}-{}", name, row + 1, column + 1);
      add_luminaire(luminaire, item, scene);
    }
  }
  tilted_too_far.report(name, scene);
}

std::vector<double> numbers(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

}  // namespace

void read_luminaires(const JsonItem& luminaires, const std::filesystem::path& folder, double unit,
                     const radiosity::Progress& progress, Scene& scene) {
  for (std::size_t k = 0; k < luminaires.size(); ++k) {
    read_luminaire(luminaires[k], folder, unit, progress, scene);
  }
}

Json luminaires_json(const Scene& scene, const std::filesystem::path& folder) {
  Json list = Json::array();
  for (const Luminaire& luminaire : scene.luminaires) {
    const radiosity::Photometry& photometry = scene.photometries[luminaire.photometry];
    std::error_code ignored;
    const std::filesystem::path base = folder.empty() ? std::filesystem::path(".") : folder;
    const std::filesystem::path beside = std::filesystem::proximate(photometry.file, base, ignored);
    const std::filesystem::path file = beside.empty() ? photometry.file : beside;
    Json item = {{"name", luminaire.name},
                 {"file", file.generic_string()},
                 {"position", numbers(luminaire.position)},
                 {"direction", numbers(-luminaire.axes.col(2))},
                 {"c0", numbers(luminaire.axes.col(0))},
                 {"watts_per_lumen", numbers(luminaire.watts_per_lumen)}};
    if (luminaire.lumens > 0) item["lumens"] = luminaire.lumens;
    if (luminaire.divisions != std::array{0, 0}) item["points"] = luminaire.divisions;
    if (luminaire.dimming != 1) item["dimming"] = luminaire.dimming;
    if (luminaire.maintenance_factor != 1) {
      item["maintenance_factor"] = luminaire.maintenance_factor;
    }
    if (luminaire.up != Vec3::UnitZ()) item["up"] = numbers(luminaire.up);
    list.push_back(std::move(item));
  }
  return list;
}

}  // namespace io
