#include "viewer/desk/luminaires.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace viewer {
namespace {

using radiosity::Vec3;

constexpr double kShareOfScene = 0.08;
constexpr double kMarkReach = 9;  // pixels at scale 1

}  // namespace

std::optional<double> emitter_lumens(const Desk& desk, std::size_t emitter) {
  const Emitter& of = desk.session.mix().emitters[emitter];
  if (of.kind != Emitter::Kind::luminaires) return std::nullopt;
  double sum = 0;
  for (const int k : of.luminaires) {
    const auto index = static_cast<std::size_t>(k);
    if (index < desk.luminaires.size()) sum += desk.luminaires[index].lumens;
  }
  return of.factor() * sum;
}

double luminaire_size(const Session& session) {
  return kShareOfScene * session.model().bounds.diagonal().norm();
}

std::optional<Eigen::Vector2d> picture_place(const Desk& desk, const Vec3& point) {
  if (desk.region.height <= 0 || desk.region.width <= 0) return std::nullopt;
  const radiosity::Camera camera = picture_camera(desk);
  const Vec3 offset = point - camera.position;
  const double depth = offset.dot(camera.direction);
  if (!(depth > 0)) return std::nullopt;
  const Vec3 right = camera.direction.cross(camera.up).normalized();
  const Vec3 up = right.cross(camera.direction);
  const double aspect = static_cast<double>(desk.region.width) / desk.region.height;
  const double unit = 0.5 / (depth * std::tan(camera.vertical_fov / 2));
  return Eigen::Vector2d(0.5 + unit / aspect * offset.dot(right), 0.5 - unit * offset.dot(up));
}

bool is_seen_from_camera(const Desk& desk, const Vec3& point) {
  constexpr double kBeside = 1e-3;  // of the distance: on a surface
  const Model& model = desk.session.model();
  const Vec3 origin = desk.camera.camera().position;
  const double distance = (point - origin).norm();
  if (!(distance > 0) || !model.visibility) return false;
  const auto hit = first_seen(*model.visibility, *model.mesh, desk.look.hidden, Backs::hidden,
                              origin, (point - origin) / distance);
  return !hit || hit->distance > (1 - kBeside) * distance;
}

bool is_luminaire_seen(const Desk& desk, std::size_t luminaire) {
  const auto& scene = desk.session.model().scene;
  return desk.look.luminaires && scene &&
         is_seen_from_camera(desk, scene->luminaires[luminaire].position);
}

std::optional<std::size_t> luminaire_at(const Desk& desk, double x, double y) {
  std::optional<std::size_t> nearest;
  if (!desk.look.luminaires || !desk.session.model().scene) return nearest;
  double least = kMarkReach * desk.scale;
  const auto& luminaires = desk.session.model().scene->luminaires;
  for (std::size_t k = 0; k < luminaires.size(); ++k) {
    const auto place = picture_place(desk, luminaires[k].position);
    if (!place) continue;
    const double distance =
        std::hypot((place->x() - x) * desk.region.width, (place->y() - y) * desk.region.height);
    if (distance > least || !is_luminaire_seen(desk, k)) continue;
    least = distance;
    nearest = k;
  }
  return nearest;
}

void choose_luminaire(Desk& desk, std::optional<std::size_t> luminaire) {
  if (luminaire && *luminaire >= desk.luminaires.size()) {
    throw std::out_of_range(fmt::format("there is no luminaire {}; the scene has {}", *luminaire,
                                        desk.luminaires.size()));
  }
  desk.chosen_luminaire = luminaire;
}

std::optional<std::size_t> first_luminaire(const Desk& desk, std::size_t emitter) {
  const std::vector<int>& luminaires = desk.session.mix().emitters[emitter].luminaires;
  if (luminaires.empty()) return std::nullopt;
  return static_cast<std::size_t>(luminaires.front());
}

}  // namespace viewer
