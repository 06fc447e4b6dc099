#include "viewer/desk/surface_marks.h"

#include <algorithm>
#include <utility>

#include "viewer/desk/outlines.h"

namespace viewer {
namespace {

/// Whose outlines take no longer than the window's thread has, at most.
constexpr radiosity::Index kMostAtOnce = 30'000;

}  // namespace

void SurfaceMarks::mark(std::vector<std::int32_t> surfaces) {
  finding_.cancel();
  surfaces_ = std::move(surfaces);
  std::sort(surfaces_.begin(), surfaces_.end());
  lines_.clear();
  mesh_.reset();
}

void SurfaceMarks::outline(Mesh mesh, std::vector<std::int32_t> surfaces) {
  mark(std::move(surfaces));
  if (surfaces_.empty()) return;
  mesh_ = std::move(mesh);
  const auto others = HiddenSurfaces::all_but(surfaces_, mesh_->surface_names.size());
  if (mesh_->size() <= kMostAtOnce) {
    lines_ = make_outlines(*mesh_, others);
    return;
  }
  finding_.start([this, mesh = mesh_, others](const Worker::Context& context) {
    context.post([this, lines = make_outlines(*mesh, others)] { lines_ = lines; });
  });
}

void SurfaceMarks::follow(const Mesh& mesh) {
  if (mesh_ && mesh_ != mesh) outline(mesh, surfaces_);
}

bool SurfaceMarks::contains(std::int32_t surface) const {
  return std::binary_search(surfaces_.begin(), surfaces_.end(), surface);
}

}  // namespace viewer
