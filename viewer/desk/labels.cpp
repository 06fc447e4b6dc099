#include "viewer/desk/labels.h"

#include <algorithm>
#include <cassert>

namespace viewer {

std::optional<Box> Labels::take(std::initializer_list<Box> places) {
  for (const Box& place : places) {
    const bool is_free = is_clear(plan_, region_, place) &&
                         std::none_of(taken_.begin(), taken_.end(),
                                      [&](const Box& other) { return other.overlaps(place); });
    if (!is_free) continue;
    taken_.push_back(place);
    return place;
  }
  return std::nullopt;
}

Box Labels::take_any(std::initializer_list<Box> places) {
  assert(places.size() > 0);
  if (const auto free = take(places)) return *free;
  taken_.push_back(*places.begin());
  return *places.begin();
}

}  // namespace viewer
