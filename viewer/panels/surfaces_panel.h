#pragma once

#include <cstdint>
#include <vector>

#include "viewer/desk/desk.h"
#include "viewer/desk/surface_groups.h"

namespace viewer {

/// The list of surfaces, or the tree of materials or lamps with theirs.
class SurfacesPanel {
 public:
  void draw(Desk& desk);

 private:
  void draw_table(Desk& desk);
  void draw_group(Desk& desk, const SurfaceGroup& group, const std::vector<SurfaceTotal>& totals);
  void draw_row(Desk& desk, const SurfaceTotal& total, bool is_inner);

  std::vector<std::int32_t> marked_;  // when it was drawn last
  bool is_mark_new_ = false;
};

}  // namespace viewer
