#pragma once

#include <memory>
#include <optional>
#include <string>

#include "viewer/desk/desk.h"
#include "viewer/desk/plane_picture.h"
#include "viewer/draw/scene_view.h"

namespace viewer {

/// Keeps the drawing of the work plane in step with the desk.
class PlanePainter {
 public:
  /// Brings `view`, which shows the patches as they are now, and the desk's legend up to date;
  /// cheap if nothing has changed.
  void paint(Desk& desk, SceneView& view);

 private:
  /// What the picture was made of.
  struct Painted {
    std::shared_ptr<const void> source;
    Look look;
    std::string note;
  };
  std::optional<Painted> painted_;
  Legend legend_;
  std::vector<IsoNumber> numbers_;
};

}  // namespace viewer
