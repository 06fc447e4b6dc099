#include "apps/summary/part_summary.h"

#include <fmt/format.h>

#include "apps/summary/text_table.h"

namespace apps {

std::string part_line(const MadePart& part) {
  return line("part", fmt::format("{} of {}: {} records, {:.1f} MB, {:.3g} s", part.part.number + 1,
                                  part.part.n_parts, part.records,
                                  1e-6 * static_cast<double>(part.bytes), part.seconds));
}

}  // namespace apps
