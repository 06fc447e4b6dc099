#include "viewer/draw/scene_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "viewer/desk/ray_picture.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

constexpr int kMapColors = 256;
constexpr int kLeastHeight = 100;  // pixels

/// 8-bit sRGB as VTK takes it.
std::array<double, 3> shares(const io::Rgb& color) {
  return {color[0] / 255.0, color[1] / 255.0, color[2] / 255.0};
}

void fill_color_map(vtkLookupTable& table, io::ColorMap map) {
  table.SetNumberOfTableValues(kMapColors);
  table.SetTableRange(0, 1);
  for (int k = 0; k < kMapColors; ++k) {
    const io::Rgb color = io::map_color(static_cast<double>(k) / (kMapColors - 1), map);
    table.SetTableValue(k, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0, 1);
  }
  table.SetUseBelowRangeColor(1);
  const std::array<double, 3> unknown = shares(kUnknownColor);
  table.SetBelowRangeColor(unknown[0], unknown[1], unknown[2], 1);
}

/// Relative to `origin`, since a graphics card has single precision.
vtkSmartPointer<vtkPoints> make_points(std::span<const Vec3> positions, const Vec3& origin) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 position = positions[i] - origin;
    points->SetPoint(static_cast<vtkIdType>(i), position.data());
  }
  return points;
}

vtkSmartPointer<vtkFloatArray> float_array(std::span<const float> values) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

}  // namespace

struct SceneView::Parts {
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPolyData> patches;
  vtkNew<vtkPolyDataMapper> patch_mapper;
  vtkNew<vtkActor> patch_actor;
  vtkNew<vtkPolyData> backs;  // which have no light of their own
  vtkNew<vtkPolyDataMapper> back_mapper;
  vtkNew<vtkActor> back_actor;
  vtkNew<vtkPolyData> edges;
  vtkNew<vtkPolyDataMapper> edge_mapper;
  vtkNew<vtkActor> edge_actor;
  vtkNew<vtkPolyData> lines;
  vtkNew<vtkPolyDataMapper> line_mapper;
  vtkNew<vtkActor> line_actor;
  vtkNew<vtkPolyData> inner;
  vtkNew<vtkPolyDataMapper> inner_mapper;
  vtkNew<vtkActor> inner_actor;
  vtkNew<vtkLookupTable> inner_colors;
  InnerSurface inner_surface;
  vtkNew<vtkLookupTable> color_map;
  io::ColorMap map = io::ColorMap::viridis;
  std::vector<SurfaceLine> all_lines;
  std::shared_ptr<const PatchMesh> mesh;  // whose edges may be shown, or none
  HiddenSurfaces hidden;                  // of which it shows none
  Vec3 origin = Vec3::Zero();             // of VTK's coordinates, m
  radiosity::Camera camera;
  Region region;
  Columns columns;
  int window_width = 0;
  int window_height = 0;
  bool are_edges_stale = true;
  bool are_lines_stale = false;
};

SceneView::SceneView() : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  parts.renderer->SetBackground(shares(kBackgroundColor).data());
  parts.patch_mapper->SetInputData(parts.patches);
  parts.patch_actor->SetMapper(parts.patch_mapper);
  parts.patch_actor->GetProperty()->LightingOff();
  parts.patch_actor->GetProperty()->BackfaceCullingOn();
  parts.back_mapper->SetInputData(parts.backs);
  parts.back_mapper->ScalarVisibilityOff();
  parts.back_actor->SetMapper(parts.back_mapper);
  parts.back_actor->GetProperty()->LightingOff();
  parts.back_actor->GetProperty()->SetColor(shares(kBackColor).data());
  parts.back_actor->GetProperty()->FrontfaceCullingOn();
  parts.back_actor->VisibilityOff();
  fill_color_map(*parts.color_map, parts.map);
  parts.edge_mapper->SetInputData(parts.edges);
  parts.edge_mapper->ScalarVisibilityOff();
  parts.edge_actor->SetMapper(parts.edge_mapper);
  parts.edge_actor->GetProperty()->LightingOff();
  parts.edge_actor->GetProperty()->SetColor(shares(kEdgeColor).data());
  parts.edge_actor->VisibilityOff();
  parts.line_mapper->SetInputData(parts.lines);
  parts.line_mapper->SetScalarModeToUseCellData();
  parts.line_mapper->SetColorModeToDirectScalars();
  parts.line_actor->SetMapper(parts.line_mapper);
  parts.line_actor->GetProperty()->LightingOff();
  parts.inner_mapper->SetInputData(parts.inner);
  parts.inner_mapper->InterpolateScalarsBeforeMappingOn();
  parts.inner_mapper->SetLookupTable(parts.inner_colors);
  parts.inner_mapper->UseLookupTableScalarRangeOn();
  parts.inner_actor->SetMapper(parts.inner_mapper);
  parts.inner_actor->GetProperty()->LightingOff();
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  parts.patch_mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(1, 1);
  parts.back_mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(1, 1);
  parts.renderer->AddActor(parts.patch_actor);
  parts.renderer->AddActor(parts.back_actor);
  parts.renderer->AddActor(parts.inner_actor);
  parts.renderer->AddActor(parts.edge_actor);
  parts.renderer->AddActor(parts.line_actor);
}

SceneView::~SceneView() = default;

vtkRenderer& SceneView::renderer() { return *parts_->renderer; }

void SceneView::set_triangles(const Triangles& triangles, std::shared_ptr<const PatchMesh> edges) {
  Parts& parts = *parts_;
  parts.mesh = std::move(edges);
  parts.hidden = triangles.hidden;
  radiosity::Box3 box;
  for (const Vec3& position : triangles.positions) box.extend(position);
  parts.origin = box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.center());
  parts.edges->Initialize();
  vtkNew<vtkCellArray> fronts;
  vtkNew<vtkCellArray> backs;
  fronts->AllocateEstimate(static_cast<vtkIdType>(triangles.triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.triangles.size(); ++t) {
    if (triangles.hidden.contains(triangles.surfaces[t])) continue;
    const auto& triangle = triangles.triangles[t];
    const std::array<vtkIdType, 3> ids = {triangle[0], triangle[1], triangle[2]};
    fronts->InsertNextCell(3, ids.data());
    if (triangles.has_back[t] != 0) backs->InsertNextCell(3, ids.data());
  }
  parts.patches->Initialize();
  parts.patches->SetPoints(make_points(triangles.positions, parts.origin));
  parts.patches->SetPolys(fronts);
  parts.backs->Initialize();
  parts.backs->SetPoints(parts.patches->GetPoints());
  parts.backs->SetPolys(backs);
  set_map_positions(std::vector<float>(triangles.positions.size(), -1.F));
  set_lines({});
  parts.are_edges_stale = true;
  update_inner_surface();
  update_camera();
}

void SceneView::set_colors(const std::vector<io::Rgb>& colors) {
  Parts& parts = *parts_;
  vtkNew<vtkUnsignedCharArray> array;
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colors.size()));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    std::copy(colors[i].begin(), colors[i].end(), array->GetPointer(3 * static_cast<vtkIdType>(i)));
  }
  parts.patches->GetPointData()->SetScalars(array);
  parts.patch_mapper->SetColorModeToDirectScalars();
  parts.patch_mapper->InterpolateScalarsBeforeMappingOff();
  is_dirty_ = true;
}

void SceneView::set_map_positions(std::span<const float> positions) {
  Parts& parts = *parts_;
  parts.patches->GetPointData()->SetScalars(float_array(positions));
  parts.patch_mapper->SetColorModeToMapScalars();
  // The colour of the value between the points, not a mixture of their colours.
  parts.patch_mapper->InterpolateScalarsBeforeMappingOn();
  parts.patch_mapper->SetLookupTable(parts.color_map);
  parts.patch_mapper->UseLookupTableScalarRangeOn();
  is_dirty_ = true;
}

void SceneView::set_color_map(io::ColorMap map) {
  Parts& parts = *parts_;
  if (parts.map == map) return;
  parts.map = map;
  fill_color_map(*parts.color_map, map);
  is_dirty_ = true;
}

void SceneView::set_line_width(float width) {
  Parts& parts = *parts_;
  if (parts.line_actor->GetProperty()->GetLineWidth() == width) return;
  parts.line_actor->GetProperty()->SetLineWidth(width);
  parts.edge_actor->GetProperty()->SetLineWidth(width);
  is_dirty_ = true;
}

void SceneView::set_lines(std::vector<SurfaceLine> lines) {
  if (lines.empty() && parts_->all_lines.empty()) return;
  parts_->all_lines = std::move(lines);
  parts_->are_lines_stale = true;
  update_lines();
  is_dirty_ = true;
}

void SceneView::set_inner_surface(InnerSurface surface) {
  if (surface.triangles.empty() && parts_->inner_surface.triangles.empty()) return;
  parts_->inner_surface = std::move(surface);
  update_inner_surface();
  parts_->are_lines_stale = true;
  update_lines();
  is_dirty_ = true;
}

void SceneView::set_edges(bool are_shown) {
  if (static_cast<bool>(parts_->edge_actor->GetVisibility()) == are_shown) return;
  parts_->edge_actor->SetVisibility(are_shown ? 1 : 0);
  update_edges();
  is_dirty_ = true;
}

void SceneView::set_backs_hidden(bool are_hidden) {
  if (static_cast<bool>(parts_->back_actor->GetVisibility()) == !are_hidden) return;
  parts_->back_actor->SetVisibility(are_hidden ? 0 : 1);
  parts_->are_edges_stale = true;
  parts_->are_lines_stale = true;
  update_camera();
  is_dirty_ = true;
}

void SceneView::set_camera(const radiosity::Camera& camera) {
  Parts& parts = *parts_;
  const radiosity::Camera& old = parts.camera;
  const bool is_same = old.position == camera.position && old.direction == camera.direction &&
                       old.up == camera.up && old.vertical_fov == camera.vertical_fov;
  if (is_same) return;
  parts.camera = camera;
  parts.are_edges_stale = true;
  parts.are_lines_stale = true;
  update_camera();
  is_dirty_ = true;
}

void SceneView::set_region(const Region& region, int window_width, int window_height,
                           const Columns& columns) {
  Parts& parts = *parts_;
  const bool is_same = parts.region == region && parts.columns == columns &&
                       parts.window_width == window_width && parts.window_height == window_height;
  if (is_same || window_width <= 0 || window_height <= 0) return;
  parts.region = region;
  parts.columns = columns;
  parts.window_width = window_width;
  parts.window_height = window_height;
  const double w = window_width;
  const double h = window_height;
  // VTK counts from the bottom.
  parts.renderer->SetViewport((region.left + columns.left * region.width) / w,
                              1 - (region.top + region.height) / h,
                              (region.left + columns.right * region.width) / w, 1 - region.top / h);
  // The middle of the picture stays where it is, in or beside the part that is drawn.
  const double middle = (1 - columns.left - columns.right) / (columns.right - columns.left);
  parts.renderer->GetActiveCamera()->SetWindowCenter(-middle, 0);
  is_dirty_ = true;
}

/// Sets VTK's camera, and lets lines be those of the patches that face it: VTK culls faces, but not
/// lines.
void SceneView::update_camera() {
  Parts& parts = *parts_;
  vtkCamera& view = *parts.renderer->GetActiveCamera();
  const Vec3 position = parts.camera.position - parts.origin;
  const Vec3 target = position + parts.camera.direction;
  view.SetPosition(position.data());
  view.SetFocalPoint(target.data());
  view.SetViewUp(parts.camera.up.data());
  view.SetViewAngle(parts.camera.vertical_fov * 180 / radiosity::kPi);
  if (parts.patches->GetNumberOfPoints() > 0) {
    std::array<double, 6> bounds{};
    parts.patches->GetBounds(bounds.data());
    parts.renderer->ResetCameraClippingRange(bounds.data());
  }
  update_edges();
  update_lines();
}

void SceneView::update_inner_surface() {
  Parts& parts = *parts_;
  const InnerSurface& surface = parts.inner_surface;
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : surface.triangles) {
    const std::array<vtkIdType, 3> ids = {triangle[0], triangle[1], triangle[2]};
    cells->InsertNextCell(3, ids.data());
  }
  parts.inner->Initialize();
  parts.inner->SetPoints(make_points(surface.points, parts.origin));
  parts.inner->SetPolys(cells);
  parts.inner->GetPointData()->SetScalars(float_array(surface.positions));
  fill_color_map(*parts.inner_colors, surface.map);
}

void SceneView::update_edges() {
  Parts& parts = *parts_;
  if (!parts.mesh || !parts.are_edges_stale || parts.edge_actor->GetVisibility() == 0) return;
  parts.are_edges_stale = false;
  const PatchMesh& mesh = *parts.mesh;
  const bool hides_backs = parts.back_actor->GetVisibility() == 0;
  if (parts.edges->GetNumberOfPoints() != static_cast<vtkIdType>(mesh.vertices.size())) {
    parts.edges->Initialize();
    parts.edges->SetPoints(make_points(mesh.vertices, parts.origin));
  }
  vtkNew<vtkCellArray> lines;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (parts.hidden.contains(mesh.surface[i])) continue;
    if (hides_backs && mesh.normal[i].dot(parts.camera.position - mesh.centroid[i]) <= 0) continue;
    const int n = mesh.n_corners(i);
    std::array<vtkIdType, 5> loop{};
    for (int k = 0; k <= n; ++k) loop[k] = mesh.corners[i][k % n];
    lines->InsertNextCell(n + 1, loop.data());
  }
  parts.edges->SetLines(lines);
  parts.edges->Modified();
}

void SceneView::update_lines() {
  Parts& parts = *parts_;
  if (!parts.are_lines_stale) return;
  parts.are_lines_stale = false;
  const Backs backs = parts.back_actor->GetVisibility() == 0 ? Backs::hidden : Backs::shown;
  const double pixel =
      2 * std::tan(parts.camera.vertical_fov / 2) / std::max(parts.region.height, kLeastHeight);
  std::vector<Vec3> ends;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  const auto add_line = [&](const SurfaceLine& line) {
    if (!is_drawn(line, parts.camera.position, backs)) return;
    const auto first = static_cast<vtkIdType>(ends.size());
    const std::array<Vec3, 2> raised = raised_ends(line, parts.camera.position, pixel);
    ends.insert(ends.end(), raised.begin(), raised.end());
    const std::array<vtkIdType, 2> ids = {first, first + 1};
    cells->InsertNextCell(2, ids.data());
    colors->InsertNextTypedTuple(line.color.data());
  };
  for (const SurfaceLine& line : parts.all_lines) add_line(line);
  for (const SurfaceLine& line : parts.inner_surface.lines) add_line(line);
  parts.lines->Initialize();
  parts.lines->SetPoints(make_points(ends, parts.origin));
  parts.lines->SetLines(cells);
  parts.lines->GetCellData()->SetScalars(colors);
}

}  // namespace viewer
