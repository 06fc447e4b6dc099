#include "viewer/draw/painter.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/picture/tone_mapping.h"
#include "radiosity/base/parallel.h"
#include "viewer/desk/shown_scale.h"

namespace viewer {
namespace {

using radiosity::Index;

constexpr std::ptrdiff_t kGrain = 1024;  // points
constexpr double kMapEnd = 0.002;

bool is_same(const Look& a, const Look& b) {
  const bool is_same_range =
      a.range.has_value() == b.range.has_value() &&
      (!a.range || (a.range->low == b.range->low && a.range->high == b.range->high &&
                    a.range->logarithmic == b.range->logarithmic));
  return a.show == b.show && a.quantity == b.quantity && a.band == b.band && is_same_range &&
         a.logarithmic == b.logarithmic && a.stops == b.stops && a.smooth == b.smooth &&
         a.step == b.step;
}

bool needs_repaint(const Session::Versions& a, const Session::Versions& b, Show show) {
  const bool is_selection_shown = is_wide(show);  // all of them are about the selected patch
  return a.model != b.model || a.light != b.light ||
         (is_selection_shown && a.selection != b.selection) || a.iteration != b.iteration;
}

std::vector<io::Rgb> exposed(const Eigen::MatrixXd& linear, double exposure) {
  std::vector<io::Rgb> colors(static_cast<std::size_t>(linear.rows()));
  radiosity::parallel_for(
      linear.rows(),
      [&](Index i) {
        colors[static_cast<std::size_t>(i)] = io::srgb_bytes(linear.row(i).cast<float>(), exposure);
      },
      kGrain);
  return colors;
}

}  // namespace

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

void Painter::paint(Desk& desk, SceneView& view) {
  if (desk.session.model().mesh != mesh_) take_patches(desk, view);
  view.set_camera(picture_camera(desk));
  view.set_edges(desk.look.edges);
  view.set_backs_hidden(desk.look.hide_backs);
  if (!points_) return;
  const Session::Versions& versions = desk.session.versions();
  const bool is_current = has_painted_ && is_same(look_, desk.look) && !desk.is_exposure_due &&
                          !needs_repaint(painted_, versions, desk.look.show);
  if (is_current) return;
  paint_colors(desk, view);
  painted_ = versions;
  look_ = desk.look;
  has_painted_ = true;
}

void Painter::take_patches(Desk& desk, SceneView& view) {
  const Model& model = desk.session.model();
  mesh_ = model.mesh;
  points_ = std::make_unique<PatchPoints>(mesh_);
  view.set_patches(mesh_, *points_);
  has_painted_ = false;
  desk.is_exposure_due = true;
}

void Painter::paint_colors(Desk& desk, SceneView& view) {
  desk.legend.reset();
  if (const auto field = shown_field(desk.session, desk.look)) {
    paint_field(desk, view, *field);
  } else if (const auto radiosity = shown_radiosity(desk.session, desk.look)) {
    paint_light(desk, view, *radiosity);
  } else {
    paint_unlit(desk, view);
  }
}

void Painter::paint_light(Desk& desk, SceneView& view, const Eigen::MatrixXd& radiosity) {
  const Eigen::MatrixX3f colors = display_colors(radiosity, desk.session.model().bands);
  // While light is spreading it gets brighter: the exposure follows until it is known, and then
  // stays, so that lamps that are dimmed look dimmed.
  const bool is_spreading = desk.session.light()->kind == Light::Kind::preview;
  if (desk.is_exposure_due || was_spreading_) desk.exposure = io::automatic_exposure(colors);
  desk.is_exposure_due = false;
  was_spreading_ = is_spreading;
  const Eigen::MatrixXd points = points_->values(colors.cast<double>(), is_smooth(desk.look));
  view.set_colors(exposed(points, desk.exposure * std::exp2(desk.look.stops)));
}

void Painter::paint_field(Desk& desk, SceneView& view, const ShownField& field) {
  const io::ColorScale scale = shown_scale(desk.look, field.values);
  const Eigen::MatrixXd values = points_->values(field.values, is_smooth(desk.look));
  std::vector<float> positions(static_cast<std::size_t>(values.rows()));
  for (Index i = 0; i < values.rows(); ++i) {
    const double value = values(i, 0);
    // Off the very ends of the map, where rounding would tip values over into the unknown.
    positions[static_cast<std::size_t>(i)] =
        std::isfinite(value)
            ? static_cast<float>(std::clamp(io::position_on(scale, value), kMapEnd, 1 - kMapEnd))
            : -1.F;
  }
  view.set_map_positions(positions);
  std::vector<std::string> title = field.title;
  const std::string note = scale_note(desk.look, scale);
  if (!note.empty()) title.push_back(note);
  desk.legend = Legend{.title = std::move(title),
                       .unit = field.unit,
                       .scale = scale,
                       .least = field.values.minCoeff(),
                       .greatest = field.values.maxCoeff(),
                       .values = field.values,
                       .has_below = field.values.minCoeff() < scale.low,
                       .has_above = field.values.maxCoeff() > scale.high};
}

/// What the patches reflect, brighter where they face upwards, so that one sees their shape.
void Painter::paint_unlit(const Desk& desk, SceneView& view) {
  const Model& model = desk.session.model();
  Eigen::MatrixXd colors = Eigen::MatrixXd::Constant(mesh_->size(), 3, 0.5);
  if (model.scene) {
    for (Index i = 0; i < mesh_->size(); ++i) {
      const auto& surface = model.scene->surfaces[mesh_->surface[i]];
      const Eigen::MatrixXd reflectance =
          model.scene->materials[surface.material].reflectance.transpose();
      colors.row(i) = surface_colors(reflectance, model.bands).cast<double>();
    }
    const double brightest = colors.maxCoeff();
    if (brightest > 0) colors *= 0.8 / brightest;
  }
  const radiosity::Vec3 light =
      (up_direction(desk.up) + radiosity::Vec3(0.5, 0.3, 0.4)).normalized();
  for (Index i = 0; i < mesh_->size(); ++i) {
    colors.row(i) *= 0.55 + 0.45 * mesh_->normal[i].dot(light);
  }
  view.set_colors(exposed(points_->values(colors, false), 1));
}

}  // namespace viewer
