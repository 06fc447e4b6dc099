#include "study/comfort.h"

#include <cmath>
#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/exchange/point_factors.h"
#include "radiosity/picture/final_gather.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/scene/sun.h"
#include "radiosity/solve/surface_flux.h"
#include "study/projected_area.h"
#include "study/seen_body.h"

namespace study {
namespace {

using namespace radiosity;

constexpr std::size_t kPlanes = 6;

/// Up, down, front, back, left, right.
struct Planes {
  std::array<Vec3, kPlanes> normals;
  std::array<double, kPlanes> weights;  // that add up to 1
};

Planes make_planes(const ComfortOptions& options) {
  const Vec3 up = options.up.normalized();
  const Vec3 wanted = options.facing ? *options.facing : usual_north(up);
  const Vec3 front = wanted - up.dot(wanted) * up;
  if (!(front.norm() > 1e-6 * wanted.norm())) {
    throw SceneError(
        "a person cannot face upwards or downwards; expected a direction that is not "
        "along \"up\"");
  }
  const Vec3 ahead = front.normalized();
  const Vec3 left = up.cross(ahead);
  const bool is_seated = options.posture == Posture::seated;
  const double above = is_seated ? 0.18 : 0.08;
  double along = is_seated ? 0.30 : 0.35;
  double across = is_seated ? 0.22 : 0.23;
  if (!options.facing) along = across = (along + across) / 2;
  const double sum = 2 * (above + along + across);
  return {
      .normals = {up, -up, ahead, -ahead, left, -left},
      .weights = {above / sum, above / sum, along / sum, along / sum, across / sum, across / sum}};
}

/// Bands that are thermal radiation, 1, or the sun's own, 0.
Eigen::VectorXd thermal_bands(const Bands& bands) {
  Eigen::VectorXd shares = Eigen::VectorXd::Ones(bands.count());
  if (bands.kind == Bands::Kind::solar_infrared) shares[0] = 0;
  return shares;
}

double black_temperature(double irradiance) {
  return std::pow(std::max(irradiance, 0.) / kStefanBoltzmann, 0.25);
}

/// What all persons have in common.
struct ComfortScene {
  explicit ComfortScene(const Study& study)
      : solved(study),
        bands(thermal_bands(study.scene.bands)),
        gather(study.mesh, study.solution.radiosity, {study.scene, study.mesh}) {
    const Eigen::VectorXd environment = environment_exitance(study.scene);
    if (environment.size() > 0) around = bands.dot(environment);
  }

  const Study& solved;
  Eigen::VectorXd bands;  // weights
  double around = 0;      // exitance of the environment, W/m²
  FinalGather gather;

  [[nodiscard]] Index n_surfaces() const {
    return static_cast<Index>(solved.mesh.surface_names.size());
  }
};

ComfortPoint by_planes(const ComfortScene& scene, const Planes& planes, const Vec3& point,
                       const Progress& progress) {
  ComfortPoint person;
  person.position = point;
  person.surfaces.setZero(scene.n_surfaces());
  double mean = 0;
  for (std::size_t p = 0; p < kPlanes; ++p) {
    const Destinations seen = point_factors(scene.solved.mesh, point, planes.normals[p], progress);
    const Eigen::MatrixXd gathered =
        scene.gather.irradiance(std::span(&point, 1), planes.normals[p]);
    const double irradiance = gathered.row(0).dot(scene.bands) + seen.sky * scene.around;
    person.plane_temperatures[p] = black_temperature(irradiance);
    mean += planes.weights[p] * irradiance;
    person.surfaces += planes.weights[p] * seen.surfaces;
    person.backs += planes.weights[p] * seen.backs;
    person.sky += planes.weights[p] * seen.sky;
  }
  person.mean_radiant_temperature = black_temperature(mean);
  return person;
}

}  // namespace

std::optional<BodyModel> body_model_named(std::string_view name) {
  if (name == "six-planes") return BodyModel::six_planes;
  if (name == "projected-area") return BodyModel::projected_area;
  return std::nullopt;
}

void check_comfort(const Scene& scene, const ComfortOptions& options) {
  if (!is_thermal(scene)) {
    throw SceneError(
        scene.source +
        ": a radiant temperature wants heat: surfaces with temperatures, and \"bands\": "
        "\"grey\" or bands of heat");
  }
  if (options.body == BodyModel::projected_area && (scene.sky || !scene.luminaires.empty())) {
    throw SceneError(scene.source +
                     ": projected areas of a person are not known to a sky or luminaires; expected "
                     "six planes, or surfaces, surroundings and a sun alone");
  }
  (void)make_planes(options);
}

std::vector<ComfortPoint> comfort(const Study& solved, std::span<const Vec3> points,
                                  const ComfortOptions& options) {
  check_comfort(solved.scene, options);
  const Planes planes = make_planes(options);
  const ComfortScene scene(solved);
  const bool has_areas = options.body == BodyModel::projected_area;
  std::optional<SeenBody> body;
  if (has_areas) {
    const Vec3 up = options.up.normalized();
    body.emplace(solved, scene.bands,
                 ProjectedArea(options.posture, up,
                               options.facing ? std::optional(planes.normals[2]) : std::nullopt),
                 up);
  }
  std::vector<ComfortPoint> result(points.size());
  const Progress each{.report = {}, .stop = options.progress.stop};
  parallel_for(std::ssize(points), [&](std::ptrdiff_t k) {
    const auto at = static_cast<std::size_t>(k);
    result[at] = by_planes(scene, planes, points[at], each);
    if (!body) return;
    BodyRadiation seen = body->at(points[at]);
    ComfortPoint& person = result[at];
    person.mean_radiant_temperature = black_temperature(seen.irradiance + seen.sky * scene.around);
    person.surfaces = std::move(seen.surfaces);
    person.backs = seen.backs;
    person.sky = seen.sky;
  });
  return result;
}

}  // namespace study
