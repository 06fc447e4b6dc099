#include "radiosity/assembly/tile_part.h"

#include <cstddef>

namespace radiosity {
namespace {

/// The first strip of a part: that whose middle lies beyond the part's share of the rows.
Index first_strip(const Strips& strips, std::size_t part, std::size_t n_parts) {
  const double begin = static_cast<double>(strips.n_rows()) * static_cast<double>(part) /
                       static_cast<double>(n_parts);
  Index strip = 0;
  while (strip < strips.size() &&
         static_cast<double>(strips.begin(strip)) + 0.5 * static_cast<double>(strips.rows(strip)) <
             begin) {
    ++strip;
  }
  return strip;
}

}  // namespace

Index owning_strip(Index row_strip, Index column_strip, Index n_strips) {
  const Index steps = column_strip - row_strip;  // from the one on to the other
  const Index back = n_strips - steps;
  // Where both are as far, the strips take turns.
  const bool is_of_row = steps == back ? row_strip % 2 == 0 : steps < back;
  return is_of_row ? row_strip : column_strip;
}

TilePart::TilePart(const Strips& strips, WorkPart part)
    : n_strips_(strips.size()),
      first_(first_strip(strips, part.number, part.n_parts)),
      last_(part.number + 1 == part.n_parts ? strips.size()
                                            : first_strip(strips, part.number + 1, part.n_parts)) {}

bool TilePart::owns(Index row_strip, Index column_strip) const {
  const Index owner = owning_strip(row_strip, column_strip, n_strips_);
  return first_ <= owner && owner < last_;
}

void TilePartSink::start(const TileLayout& layout) {
  tiles_.emplace(layout.strips, part_);
  sink_.start(layout);
}

}  // namespace radiosity
