#include "viewer/work/light_meter.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "radiosity/picture/final_gather.h"
#include "radiosity/scene/patch_mesh.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::Vec3;

constexpr double kOnSurface = 1e-4;    // of the scene's size: as near, a point lies on a patch
constexpr double kSameFacing = 0.999;  // cosine

/// Exactly on the patch that it lies on, if it does.
Eigen::RowVectorXd reading(const radiosity::FinalGather& gather, const Model& model,
                           const MeterPoint& point) {
  const double reach = kOnSurface * model.bounds.diagonal().norm();
  const auto hit =
      model.visibility->first_hit(point.position + reach * point.normal, -point.normal);
  const bool is_on_patch = hit && hit->front && hit->distance < 2 * reach &&
                           model.mesh->normal[hit->patch].dot(point.normal) > kSameFacing;
  if (!is_on_patch) return gather.irradiance({&point.position, 1}, point.normal).row(0);
  const radiosity::SurfacePoint settled = gather.settled({hit->patch, point.position});
  return gather.irradiance({&settled, 1}).row(0);
}

bool is_same_light(const std::shared_ptr<const Light>& a, const std::shared_ptr<const Light>& b) {
  // Errors that were found meanwhile are no other light.
  return a == b || (a && b && a->solution.radiosity.size() == b->solution.radiosity.size() &&
                    a->solution.radiosity == b->solution.radiosity &&
                    a->solution.irradiance == b->solution.irradiance);
}

}  // namespace

struct LightMeter::Gathering {
  Gathering(const Model& model, std::shared_ptr<const Light> of)
      : mesh(model.mesh),
        light(std::move(of)),
        gather(*mesh, light->solution.radiosity,
               model.scene && light->mix
                   ? radiosity::IncidentLight(mixed_scene(*model.scene, *light->mix), *mesh)
                   : radiosity::IncidentLight()) {}
  std::shared_ptr<const radiosity::PatchMesh> mesh;
  std::shared_ptr<const Light> light;
  radiosity::FinalGather gather;
};

void LightMeter::set_plane(const std::optional<radiosity::WorkPlaneOptions>& plane) {
  task_.plane = plane;
  ++task_version_;
}

void LightMeter::add(const MeterPoint& point) {
  task_.points.push_back(point);
  ++task_version_;
}

void LightMeter::remove(std::size_t point) {
  if (point >= task_.points.size()) {
    throw std::out_of_range(fmt::format("there is no measuring point {}; there are {}", point + 1,
                                        task_.points.size()));
  }
  task_.points.erase(task_.points.begin() + static_cast<std::ptrdiff_t>(point));
  ++task_version_;
}

void LightMeter::clear_points() {
  task_.points.clear();
  ++task_version_;
}

void LightMeter::reset() {
  worker_.cancel();
  task_ = {};
  ++task_version_;
  readings_.reset();
  gathering_.reset();
  begun_ = {};
  measured_ = {};
}

bool LightMeter::is_current(const Session& session) const {
  if (!readings_ || session.is_change_pending()) return false;
  return measured_.task == task_version_ && measured_.light == session.known().light;
}

bool LightMeter::update(const Session& session, const Vec3& up) {
  const bool has_changed = worker_.deliver();
  if (task_.up != up) {
    task_.up = up;
    ++task_version_;
  }
  const Session::Versions& now = session.versions();
  const bool is_same =
      now.light == seen_.light && now.model == seen_.model && task_version_ == seen_task_;
  if (is_same) return has_changed;
  seen_ = now;
  seen_task_ = task_version_;
  if (is_empty()) {
    worker_.cancel();
    readings_.reset();
    gathering_.reset();  // which holds hundreds of bytes for each patch
    begun_ = {};
    return true;
  }
  const Known known = session.known();
  if (!known.light || !known.light->is_solved() || !known.model.visibility) return has_changed;
  const bool is_begun = begun_.task == task_version_ && begun_.mesh == known.model.mesh &&
                        is_same_light(begun_.light, known.light);
  if (is_begun) {
    // Unless it failed, it is under way or done.
    if (measured_.light == begun_.light) measured_.light = known.light;
    begun_.light = known.light;
    return true;
  }
  start(known);
  return true;
}

void LightMeter::start(const Known& known) {
  begun_ = {.mesh = known.model.mesh, .light = known.light, .task = task_version_};
  worker_.start([this, model = known.model, light = known.light, task = task_,
                 version = task_version_,
                 gathering = gathering_](const Worker::Context& context) mutable {
    const bool is_of_this =
        gathering && gathering->mesh == model.mesh && is_same_light(gathering->light, light);
    if (!is_of_this) gathering = std::make_shared<const Gathering>(model, light);
    context.progress.check();
    const radiosity::FinalGather& gather = gathering->gather;
    auto readings = std::make_shared<Readings>();
    readings->points.resize(static_cast<Index>(task.points.size()), gather.n_bands());
    for (std::size_t k = 0; k < task.points.size(); ++k) {
      context.progress.check();
      readings->points.row(static_cast<Index>(k)) = reading(gather, model, task.points[k]);
    }
    if (task.plane) {
      std::optional<radiosity::Vec3> down;
      if (radiosity::find_floor(*model.mesh, task.up).is_found) down = -task.up;
      readings->plane = radiosity::measure(gather, *model.visibility,
                                           make_work_plane(*model.mesh, task.up, *task.plane), down,
                                           context.progress);
    }
    readings->task = std::move(task);
    context.post([this, readings, gathering, version] {
      readings_ = readings;
      gathering_ = gathering;
      measured_ = begun_;
      measured_.task = version;
    });
  });
}

}  // namespace viewer
