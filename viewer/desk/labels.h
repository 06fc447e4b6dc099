#pragma once

#include <initializer_list>
#include <optional>
#include <vector>

#include "viewer/desk/picture_plan.h"

namespace viewer {

/// Room for short texts at places of the picture: none lies over another, nor over what is planned
/// there.
class Labels {
 public:
  Labels(const PicturePlan& plan, const Region& region) : plan_(plan), region_(region) {}

  /// The first of these boxes that is free, and is no more then; absent if none is.
  std::optional<Box> take(std::initializer_list<Box> places);
  /// The same, or the first one though it is not free: of what has to be told.
  Box take_any(std::initializer_list<Box> places);

 private:
  PicturePlan plan_;
  Region region_;
  std::vector<Box> taken_;
};

}  // namespace viewer
