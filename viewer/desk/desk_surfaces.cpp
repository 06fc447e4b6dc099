#include "viewer/desk/desk_surfaces.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "viewer/desk/couplings.h"

namespace viewer {
namespace {

bool is_large(const Desk& desk) { return desk.session.model().mesh->size() > kManyPatches; }

/// How many there are. Throws std::out_of_range if one of these is none of them.
std::size_t checked_count(const Desk& desk, std::span<const std::int32_t> surfaces) {
  const std::size_t n =
      desk.session.is_open() ? desk.session.model().mesh->surface_names.size() : 0;
  for (const std::int32_t surface : surfaces) {
    if (surface < 0 || static_cast<std::size_t>(surface) >= n) {
      throw std::out_of_range(fmt::format("there is no surface {}; the scene has {}", surface, n));
    }
  }
  return n;
}

}  // namespace

void set_shown(Desk& desk, std::span<const std::int32_t> surfaces, bool is_shown) {
  desk.look.hidden = desk.look.hidden.with(surfaces, checked_count(desk, surfaces), !is_shown);
}

void isolate(Desk& desk, std::span<const std::int32_t> surfaces) {
  desk.look.hidden = HiddenSurfaces::all_but(surfaces, checked_count(desk, surfaces));
}

void mark_surfaces(Desk& desk, std::span<const std::int32_t> surfaces) {
  checked_count(desk, surfaces);
  desk.marks.outline(desk.session.model().mesh, {surfaces.begin(), surfaces.end()});
}

std::optional<std::int32_t> meant_surface(const Desk& desk) {
  if (!desk.session.model().scene) return std::nullopt;
  const std::vector<std::int32_t>& marked = desk.marks.surfaces();
  if (marked.size() == 1) return marked.front();
  return asked_surface(desk.session);
}

const std::vector<SurfaceTotal>& sorted_totals(Desk& desk) {
  const Session::Versions& now = desk.session.versions();
  const Session::Versions& then = desk.totals_versions;
  if (now.light != then.light || now.model != then.model || now.file != then.file) {
    // Of other surfaces they would mislead.
    if (now.file != then.file) desk.totals.clear();
    if (!desk.session.is_open() || !is_large(desk)) {
      desk.summer.cancel();
      desk.totals = surface_totals(desk.session);
      desk.totals_versions = now;
    } else if (!desk.summer.is_busy()) {
      desk.summer.start([&desk, now, known = desk.session.known()](const Worker::Context& context) {
        context.post([&desk, now, totals = surface_totals(known)] {
          desk.totals = totals;
          set_temperatures(desk.totals, desk.session);
          desk.totals_versions = now;
        });
      });
    }
  }
  sort(desk.totals, desk.surface_order);
  return desk.totals;
}

}  // namespace viewer
