#include "io/mesh/obj_coordinates.h"

#include <limits>

namespace io {
namespace {

constexpr double kNoCoordinate = std::numeric_limits<double>::quiet_NaN();

/// The index from 0 of the coordinates that "7/1/2", "7/1" or "7/-1" names; -1 if it names none.
std::int64_t coordinate_index(std::string_view word, std::size_t n_given) {
  const std::size_t slash = word.find('/');
  if (slash == std::string_view::npos) return -1;
  const std::string_view rest = word.substr(slash + 1);
  const auto number = parse_number<std::int64_t>(rest.substr(0, rest.find('/')));
  if (!number || *number == 0) return -1;
  const std::int64_t index =
      *number > 0 ? *number - 1 : static_cast<std::int64_t>(n_given) + *number;
  return index >= 0 ? index : -1;
}

}  // namespace

void ObjCoordinates::add(Words words) {
  const auto u = parse_number<double>(words.next());
  const std::string_view second = words.next();
  const auto v = second.empty() ? std::optional<double>(0) : parse_number<double>(second);
  given_.emplace_back(u.value_or(kNoCoordinate), v.value_or(kNoCoordinate));
}

void ObjCoordinates::use(std::size_t corner, std::string_view word, const MtlTexture& place) {
  uses_.push_back({corner, coordinate_index(word, given_.size()), place.scale, place.offset});
}

std::vector<Eigen::Vector2d> ObjCoordinates::resolved(std::size_t n_corners) const {
  std::vector<Eigen::Vector2d> result;
  if (uses_.empty()) return result;
  result.assign(n_corners, Eigen::Vector2d::Constant(kNoCoordinate));
  for (const Use& use : uses_) {
    if (use.index < 0 || use.index >= static_cast<std::int64_t>(given_.size())) continue;
    const MtlTexture place{.file = {}, .scale = use.scale, .offset = use.offset};
    result[use.corner] = place.place(given_[static_cast<std::size_t>(use.index)]);
  }
  return result;
}

}  // namespace io
