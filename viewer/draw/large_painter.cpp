#include "viewer/draw/large_painter.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "radiosity/scene/corner_values.h"
#include "viewer/desk/outlines.h"
#include "viewer/desk/pinning.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;

constexpr Index kCoarseCells = 15'000;  // twice as many triangles
constexpr int kRest = 3;                // times as long as it painted light that is being shot
constexpr int kBestSamples = 2;         // rays of a pixel along either side

/// Whether light is shown that progressive shooting still spreads, with a new picture all the time.
bool is_shooting(const Desk& desk) {
  const Light* light = desk.session.light();
  return light != nullptr && light->kind == Light::Kind::preview && !light->factor_error;
}

/// Each patch's own value at its corners.
Eigen::MatrixXd repeated(const Eigen::MatrixXd& values) {
  Eigen::MatrixXd result(4 * values.rows(), values.cols());
  for (Index i = 0; i < values.rows(); ++i) {
    for (Index k = 0; k < 4; ++k) result.row(4 * i + k) = values.row(i);
  }
  return result;
}

}  // namespace

struct LargePainter::Prepared {
  explicit Prepared(std::shared_ptr<const PatchMesh> patches)
      : mesh(std::move(patches)),
        interpolation(*mesh),
        coarse(*mesh, kCoarseCells),
        size(bounds(*mesh).diagonal().norm()) {}
  std::shared_ptr<const PatchMesh> mesh;
  radiosity::CornerInterpolation interpolation;
  CoarseMesh coarse;
  double size;  // m
};

bool LargePainter::Frame::operator==(const Frame& other) const {
  return camera.position == other.camera.position && camera.direction == other.camera.direction &&
         camera.up == other.camera.up && camera.vertical_fov == other.camera.vertical_fov &&
         width == other.width && height == other.height && hides_backs == other.hides_backs &&
         has_edges == other.has_edges && has_outlines == other.has_outlines &&
         hidden == other.hidden;
}

LargePainter::Frame LargePainter::frame_of(const Desk& desk) {
  return {.camera = picture_camera(desk),
          .width = desk.region.width,
          .height = desk.region.height,
          .hides_backs = desk.look.hide_backs,
          .has_edges = desk.look.edges,
          .has_outlines = desk.look.outlines,
          .hidden = desk.look.hidden};
}

bool LargePainter::update() {
  const bool has_colors = coloring_.deliver();
  const bool has_picture = picturing_.deliver();
  return has_colors || has_picture;
}

bool LargePainter::is_busy() const { return coloring_.is_busy() || picturing_.is_busy(); }

bool LargePainter::is_done(const Desk& desk) const {
  return still_ && is_still_best_ && !is_color_new_ && still_colors_ == colored_ &&
         !coloring_.is_busy() && !started_.is_stale(desk) && frame_ == frame_of(desk);
}

void LargePainter::clear() {
  coloring_.cancel();
  picturing_.cancel();
  mesh_.reset();
  prepared_.reset();
  colored_.reset();
  still_colors_.reset();
  still_.reset();
  shown_.reset();
  is_view_set_ = false;
  is_color_new_ = false;
  are_lines_due_ = false;
  has_outlines_ = false;
}

void LargePainter::paint(Desk& desk, SceneView& view) {
  if (desk.session.model().mesh != mesh_) {
    clear();
    view.set_triangles({}, nullptr);
    prepare(desk);
  }
  desk.is_painting_due = true;
  if (!prepared_) return;
  if (!is_view_set_) {
    take_triangles(desk, view);
    is_view_set_ = true;
    start_colors(desk);
  }
  if (!(hidden_ == desk.look.hidden)) {
    take_triangles(desk, view);
    is_color_new_ = colored_ != nullptr;  // they have none yet
  }
  if (is_color_new_) take_colors(desk, view);
  if (is_due(desk)) start_colors(desk);
  paint_lines(desk, view);
  paint_still(desk);
  if (!still_) shown_ = colored_;
  desk.is_painting_due = !shown_ || shown_->state.is_stale(desk);
}

/// Whether new colours are to be found now.
bool LargePainter::is_due(const Desk& desk) const {
  if (started_.is_other_look(desk)) return true;
  // Other light waits until the last one is painted, else it would never be.
  if (coloring_.is_busy() || !started_.is_stale(desk)) return false;
  const bool is_same_mix = started_.versions.mix == desk.session.versions().mix;
  return !(is_shooting_ && is_shooting(desk) && is_same_mix) || Clock::now() >= rest_until_;
}

void LargePainter::prepare(const Desk& desk) {
  mesh_ = desk.session.model().mesh;
  coloring_.start([this, mesh = mesh_](const Worker::Context& context) {
    auto prepared = std::make_shared<const Prepared>(mesh);
    context.post([this, prepared] { prepared_ = prepared; });
  });
}

void LargePainter::start_colors(Desk& desk) {
  begun_ = Clock::now();
  is_shooting_ = is_shooting(desk);
  started_ = {
      .versions = desk.session.versions(), .look = desk.look, .subtracted = subtracted_light(desk)};
  PaintingTask task{.known = desk.session.known(),
                    .look = desk.look,
                    .up = desk.up,
                    .subtracted = started_.subtracted};
  // While light is spreading it gets brighter: the exposure follows until it is known.
  const bool is_spreading = colored_ && colored_->painting.is_spreading;
  if (!desk.is_exposure_due && !is_spreading) task.exposure = desk.exposure;
  // They take long, and change with what is hidden only.
  std::shared_ptr<const std::vector<SurfaceLine>> outlines;
  if (colored_ && colored_->state.look.hidden == desk.look.hidden) outlines = colored_->outlines;
  coloring_.start([this, task = std::move(task), state = started_, prepared = prepared_,
                   outlines](const Worker::Context& context) {
    auto colored = std::make_shared<Colored>();
    colored->state = state;
    colored->outlines = outlines;
    Painting& painting = colored->painting;
    painting = make_painting(task);
    context.progress.check();
    const Eigen::MatrixXd corners = painting.is_smooth
                                        ? prepared->interpolation.values(painting.values)
                                        : repeated(painting.values);
    painting.values.resize(0, 0);
    context.progress.check();
    if (painting.legend) {
      colored->corners.positions = map_positions(painting, corners);
      colored->points.positions = prepared->coarse.values(colored->corners.positions);
      colored->corners.map = painting.legend->map;
      colored->corners.levels = wanted_levels(painting, task.look);
      const CoarseMesh& coarse = prepared->coarse;
      colored->isolines = painted_isolines(
          painting,
          {coarse.positions(), coarse.triangles(), coarse.surfaces(), colored->points.positions},
          colored->corners.levels, task.look.hidden, prepared->size);
      if (task.look.outlines && !outlines) {
        colored->outlines = std::make_shared<const std::vector<SurfaceLine>>(
            make_outlines(*prepared->mesh, task.look.hidden));
      }
    } else {
      colored->corners.colors = point_colors(painting, corners);
      colored->points.colors = prepared->coarse.colors(colored->corners.colors);
    }
    context.post([this, colored] {
      colored_ = colored;
      is_color_new_ = true;
    });
  });
}

void LargePainter::take_colors(Desk& desk, SceneView& view) {
  is_color_new_ = false;
  const Painting& painting = colored_->painting;
  started_.is_light = painting.is_light;
  if (painting.is_light) {
    desk.exposure = painting.exposure;
    desk.is_exposure_due = false;
  }
  desk.legend = painting.legend;
  desk.iso_numbers = colored_->isolines.numbers;
  if (painting.legend) {
    view.set_color_map(painting.legend->map);
    view.set_map_positions(colored_->points.positions);
  } else {
    view.set_colors(colored_->points.colors);
  }
  are_lines_due_ = true;
  // Other light may follow the picture that is there; something else may not.
  const bool is_other =
      still_colors_ && (still_colors_->state.look.show != colored_->state.look.show ||
                        still_colors_->state.subtracted != colored_->state.subtracted);
  if (is_other) still_.reset();
}

void LargePainter::take_triangles(const Desk& desk, SceneView& view) {
  hidden_ = desk.look.hidden;
  const CoarseMesh& coarse = prepared_->coarse;
  view.set_triangles(
      {coarse.positions(), coarse.triangles(), coarse.has_back(), coarse.surfaces(), hidden_},
      nullptr);
}

/// While the camera moves, over the coarse mesh.
void LargePainter::paint_lines(const Desk& desk, SceneView& view) {
  const bool wants_outlines = desk.legend && desk.look.outlines;
  if (!are_lines_due_ && has_outlines_ == wants_outlines) return;
  are_lines_due_ = false;
  has_outlines_ = wants_outlines;
  std::vector<SurfaceLine> lines;
  if (colored_) lines = colored_->isolines.lines;
  if (has_outlines_ && colored_ && colored_->outlines) {
    lines.insert(lines.end(), colored_->outlines->begin(), colored_->outlines->end());
  }
  view.set_lines(std::move(lines));
}

void LargePainter::paint_still(const Desk& desk) {
  const Frame frame = frame_of(desk);
  const bool is_moving = !(frame == frame_);
  frame_ = frame;
  if (is_moving) {
    picturing_.cancel();
    still_.reset();
    still_colors_.reset();
    return;
  }
  if (!colored_ || frame.width <= 0 || frame.height <= 0) return;
  // While something is computed, that needs the time more.
  const bool wants_best = desk.session.is_settled();
  const bool is_new = still_colors_ != colored_;
  if (picturing_.is_busy() || (!is_new && (is_still_best_ || !wants_best))) return;
  std::vector<int> passes;
  if (is_new) passes.push_back(1);
  if (wants_best) passes.push_back(kBestSamples);
  still_colors_ = colored_;
  is_still_best_ = false;
  picturing_.start([this, frame, mesh = mesh_, visibility = desk.session.model().visibility,
                    colored = colored_, passes,
                    line_width = std::max(1.0, desk.scale)](const Worker::Context& context) {
    RayPictureOptions options{.width = frame.width,
                              .height = frame.height,
                              .hides_backs = frame.hides_backs,
                              .has_edges = frame.has_edges,
                              .line_width = line_width,
                              .hidden = frame.hidden,
                              .has_outlines = frame.has_outlines && colored->painting.legend,
                              .progress = context.progress};
    for (const int samples : passes) {
      options.samples = samples;
      auto picture = std::make_shared<const io::RgbPicture>(
          ray_picture(*mesh, *visibility, colored->corners, frame.camera, options));
      context.post([this, picture, samples, colored] {
        still_ = picture;
        shown_ = colored;
        const auto now = Clock::now();
        if (rest_until_ < begun_) rest_until_ = now + kRest * (now - begun_);
        is_still_best_ = samples == kBestSamples;
      });
    }
  });
}

}  // namespace viewer
