#include "viewer/desk/painting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/picture/tone_mapping.h"
#include "radiosity/base/parallel.h"
#include "radiosity/scene/patch_material.h"
#include "radiosity/scene/patch_texture.h"
#include "viewer/desk/shown_scale.h"
#include "viewer/work/standing.h"

namespace viewer {
namespace {

using radiosity::Index;

constexpr std::ptrdiff_t kGrain = 1024;  // points
constexpr double kMapEnd = 0.002;
constexpr int kMostTicks = 11;
constexpr double kNumberSpacing = 0.25;  // of the scene's size, along isolines

Painting painted_light(const PaintingTask& task, const Eigen::MatrixXd& radiosity) {
  Painting painting;
  const Eigen::MatrixX3f colors = display_colors(radiosity, task.known.model.bands);
  painting.exposure = task.exposure ? *task.exposure : io::automatic_exposure(colors);
  painting.factor = painting.exposure * std::exp2(task.look.stops);
  painting.values = colors.cast<double>();
  painting.is_smooth = is_smooth(task.look);
  painting.is_light = true;
  const bool is_preview = task.known.light && task.known.light->kind == Light::Kind::preview;
  // What exposes darkness well is no exposure for lamps that are switched on.
  painting.is_spreading = is_preview || (!task.exposure && colors.isZero(0));
  return painting;
}

Painting painted_field(const PaintingTask& task, ShownField field) {
  Painting painting;
  const bool is_difference = task.subtracted != nullptr;
  const io::ColorScale scale =
      is_difference ? difference_scale(task.look, field) : shown_scale(task.look, field.values);
  const std::string note = is_difference ? "" : scale_note(task.look, scale);
  if (!note.empty()) field.title.push_back(note);
  painting.values = field.values;
  painting.is_smooth = is_smooth(task.look);
  const double least = field.values.minCoeff();
  const double greatest = field.values.maxCoeff();
  painting.legend = Legend{.title = std::move(field.title),
                           .unit = std::move(field.unit),
                           .scale = scale,
                           .map = is_difference ? io::ColorMap::diverging : task.look.map,
                           .ticks = legend_ticks(task.look, scale, kMostTicks),
                           .fit = fit_text(task.look),
                           .least = least,
                           .greatest = greatest,
                           .values = std::move(field.values),
                           .has_below = (least < scale.low),
                           .has_above = (greatest > scale.high)};
  return painting;
}

/// What patches with textures reflect, each its mean.
void paint_textures(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                    Eigen::MatrixXd& colors) {
  for (Index i = 0; i < mesh.size(); ++i) {
    const auto& texture = scene.materials[material_of(scene, mesh, i)].texture;
    if (!texture) continue;
    const Eigen::Array3d mean = patch_texture(scene, mesh, i, *texture).mean;
    colors.row(i) = surface_colors(mean.matrix().transpose(), scene.bands).cast<double>().row(0);
  }
}

/// What the patches reflect, brighter where they face upwards, so that one sees their shape.
Painting painted_unlit(const PaintingTask& task) {
  const Model& model = task.known.model;
  const radiosity::PatchMesh& mesh = *model.mesh;
  Painting painting;
  Eigen::MatrixXd& colors = painting.values;
  colors = Eigen::MatrixXd::Constant(mesh.size(), 3, 0.5);
  if (model.scene) {
    const auto n_materials = static_cast<Index>(model.scene->materials.size());
    Eigen::MatrixXd reflectance(n_materials, model.bands.count());
    for (Index m = 0; m < n_materials; ++m) {
      reflectance.row(m) = model.scene->materials[m].reflectance.transpose();
    }
    const Eigen::MatrixXd of_materials = surface_colors(reflectance, model.bands).cast<double>();
    for (Index i = 0; i < mesh.size(); ++i) {
      colors.row(i) = of_materials.row(model.scene->surfaces[mesh.surface[i]].material);
    }
    if (has_textures(*model.scene)) paint_textures(*model.scene, mesh, colors);
    const double brightest = colors.maxCoeff();
    if (brightest > 0) colors *= 0.8 / brightest;
  }
  const radiosity::Vec3 light =
      (up_direction(task.up) + radiosity::Vec3(0.5, 0.3, 0.4)).normalized();
  for (Index i = 0; i < mesh.size(); ++i) {
    colors.row(i) *= 0.55 + 0.45 * mesh.normal[i].dot(light);
  }
  return painting;
}

}  // namespace

Painting make_painting(const PaintingTask& task) {
  if (task.subtracted) {
    if (auto field = shown_difference(task.known, task.subtracted->known, task.look)) {
      return painted_field(task, *std::move(field));
    }
    return painted_unlit(task);
  }
  if (auto field = shown_field(task.known, task.look)) {
    return painted_field(task, *std::move(field));
  }
  // Black would hide where a lamp may be put.
  const bool is_dark = task.look.show == Show::true_color && is_without_lamps(task.known);
  if (const auto radiosity = shown_radiosity(task.known, task.look); radiosity && !is_dark) {
    return painted_light(task, *radiosity);
  }
  return painted_unlit(task);
}

std::vector<IsoLevel> wanted_levels(const Painting& painting, const Look& look) {
  if (!painting.legend || !look.isolines || !painting.is_smooth) return {};
  return iso_levels(*painting.legend);
}

Isolines painted_isolines(const Painting& painting, const BlendedTriangles& field,
                          const std::vector<IsoLevel>& levels, const HiddenSurfaces& hidden,
                          double size) {
  if (levels.empty()) return {};
  return make_isolines(field, levels, painting.legend.value().map, hidden, kNumberSpacing * size);
}

std::vector<io::Rgb> point_colors(const Painting& painting, const Eigen::MatrixXd& values) {
  std::vector<io::Rgb> colors(static_cast<std::size_t>(values.rows()));
  radiosity::parallel_for(
      values.rows(),
      [&](Index i) {
        colors[static_cast<std::size_t>(i)] =
            io::srgb_bytes(values.row(i).cast<float>(), painting.factor);
      },
      kGrain);
  return colors;
}

std::vector<float> map_positions(const Painting& painting, const Eigen::MatrixXd& values) {
  const io::ColorScale& scale = painting.legend.value().scale;
  std::vector<float> positions(static_cast<std::size_t>(values.rows()));
  for (Index i = 0; i < values.rows(); ++i) {
    const double value = values(i, 0);
    // Off the very ends of the map, where rounding would tip values over into the unknown.
    positions[static_cast<std::size_t>(i)] =
        std::isfinite(value)
            ? static_cast<float>(std::clamp(io::position_on(scale, value), kMapEnd, 1 - kMapEnd))
            : -1.F;
  }
  return positions;
}

Eigen::MatrixX3f display_colors(const Eigen::MatrixXd& values, const radiosity::Bands& bands) {
  return io::display_colors(values.cast<float>(), bands.wavelengths);
}

Eigen::MatrixX3f surface_colors(const Eigen::MatrixXd& reflectance, const radiosity::Bands& bands) {
  const Eigen::MatrixXd all = Eigen::MatrixXd::Ones(1, reflectance.cols());
  const Eigen::Array3f white = display_colors(all, bands).row(0).transpose().array();
  Eigen::MatrixX3f colors = display_colors(reflectance, bands);
  if ((white > 0).all()) colors.array().rowwise() /= white.transpose();
  return colors.cwiseMax(0.F).cwiseMin(1.F);
}

}  // namespace viewer
