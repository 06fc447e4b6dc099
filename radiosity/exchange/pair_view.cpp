#include "radiosity/exchange/pair_view.h"

#include <algorithm>

namespace radiosity {

PairView::PairView(const SampledPair& pair) {
  constexpr double kNear = 2;
  const double area_i = vector_area(pair.polygon_i.points()).norm();
  const double area_j = vector_area(pair.polygon_j.points()).norm();
  from_i = area_i <= area_j;
  source = from_i ? &pair.polygon_i : &pair.polygon_j;
  target = from_i ? &pair.polygon_j : &pair.polygon_i;
  source_normal = from_i ? pair.plane_i.normal : pair.plane_j.normal;
  source_area = std::min(area_i, area_j);
  const Disc disc_source = bounding_disc(source->points());
  const Disc disc_target = bounding_disc(target->points());
  distance = (disc_source.center - disc_target.center).norm();
  is_near = distance < kNear * (disc_source.radius + disc_target.radius);
}

}  // namespace radiosity
