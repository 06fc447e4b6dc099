#include "viewer/desk/desk_surfaces.h"

#include <fmt/format.h>

#include <stdexcept>

#include "viewer/desk/outlines.h"

namespace viewer {
namespace {

/// How many there are. Throws std::out_of_range if this is none of them.
std::size_t checked_count(const Desk& desk, std::int32_t surface) {
  const std::size_t n =
      desk.session.is_open() ? desk.session.model().mesh->surface_names.size() : 0;
  if (surface < 0 || static_cast<std::size_t>(surface) >= n) {
    throw std::out_of_range(fmt::format("there is no surface {}; the scene has {}", surface, n));
  }
  return n;
}

}  // namespace

void set_shown(Desk& desk, std::int32_t surface, bool is_shown) {
  const std::size_t n = checked_count(desk, surface);
  HiddenSurfaces& hidden = desk.look.hidden;
  hidden = is_shown ? hidden.without(surface) : hidden.with(surface, n);
}

void isolate(Desk& desk, std::int32_t surface) {
  desk.look.hidden = HiddenSurfaces::all_but(surface, checked_count(desk, surface));
}

void mark_surface(Desk& desk, std::optional<std::int32_t> surface) {
  desk.marked_surface = surface;
  desk.marked_lines.clear();
  if (!surface) return;
  const auto others = HiddenSurfaces::all_but(*surface, checked_count(desk, *surface));
  desk.marked_lines = make_outlines(*desk.session.model().mesh, others);
}

const std::vector<SurfaceTotal>& sorted_totals(Desk& desk) {
  const Session::Versions& now = desk.session.versions();
  const Session::Versions& then = desk.totals_versions;
  if (now.light != then.light || now.model != then.model || now.file != then.file) {
    desk.totals_versions = now;
    desk.totals = surface_totals(desk.session);
  }
  sort(desk.totals, desk.surface_order);
  return desk.totals;
}

}  // namespace viewer
