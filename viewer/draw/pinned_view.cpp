#include "viewer/draw/pinned_view.h"

#include <utility>
#include <vector>

#include "viewer/desk/isolines.h"
#include "viewer/desk/outlines.h"
#include "viewer/desk/painting.h"
#include "viewer/desk/pinning.h"
#include "viewer/draw/painted_state.h"

namespace viewer {
namespace {

/// The look of now, on the scale that it has found.
Look pinned_look(const Desk& desk) {
  Look look = desk.look;
  if (desk.legend) {
    look.range = desk.legend->scale;
    look.logarithmic = desk.legend->scale.logarithmic;
  }
  return look;
}

/// Those of the scene that is open, if the mesh has the same surfaces.
HiddenSurfaces hidden_of(const Desk& desk, const radiosity::PatchMesh& mesh) {
  const auto& now = desk.session.model().mesh;
  return now && now->surface_names == mesh.surface_names ? desk.look.hidden : HiddenSurfaces();
}

}  // namespace

SceneView* PinnedView::paint(const Desk& desk) {
  if (shown_comparison(desk) != Comparison::wipe) return nullptr;
  const auto& mesh = desk.pinning.light->known.model.mesh;
  const HiddenSurfaces hidden = hidden_of(desk, *mesh);
  if (mesh != mesh_ || !(hidden == hidden_)) {
    mesh_ = mesh;
    hidden_ = hidden;
    points_ = std::make_unique<PatchPoints>(mesh_);
    view_.set_triangles({points_->positions(), points_->triangles(), points_->has_back(),
                         points_->surfaces(), hidden_},
                        mesh_);
    outlines_ = make_outlines(*mesh_, hidden_);
    painted_.reset();
  }
  view_.set_camera(picture_camera(desk));
  view_.set_edges(desk.look.edges);
  view_.set_backs_hidden(desk.look.hide_backs);
  const Look look = pinned_look(desk);
  const bool is_stale = !painted_ || painted_->pinned != desk.pinning.light ||
                        painted_->exposure != desk.exposure || !is_same_look(painted_->look, look);
  if (is_stale) paint_colors(desk, look);
  return &view_;
}

void PinnedView::paint_colors(const Desk& desk, const Look& look) {
  const Known& pinned = desk.pinning.light->known;
  const Known known =
      desk.pinning.has_same_patches ? with_form_factors_of(desk.session.model(), pinned) : pinned;
  const Painting painting =
      make_painting({.known = known, .look = look, .up = desk.up, .exposure = desk.exposure});
  const Eigen::MatrixXd values = points_->values(painting.values, painting.is_smooth);
  std::vector<SurfaceLine> lines;
  if (desk.legend && !painting.legend) {  // not known of it
    view_.set_map_positions(std::vector<float>(points_->positions().size(), -1.F));
  } else if (painting.legend) {
    const std::vector<float> positions = map_positions(painting, values);
    view_.set_color_map(painting.legend->map);
    view_.set_map_positions(positions);
    lines =
        painted_isolines(
            painting, {points_->positions(), points_->triangles(), points_->surfaces(), positions},
            wanted_levels(painting, look), hidden_, bounds(*mesh_).diagonal().norm())
            .lines;
  } else {
    view_.set_colors(point_colors(painting, values));
  }
  if (desk.legend && look.outlines) lines.insert(lines.end(), outlines_.begin(), outlines_.end());
  view_.set_lines(std::move(lines));
  painted_ = {.pinned = desk.pinning.light, .look = look, .exposure = desk.exposure};
}

}  // namespace viewer
