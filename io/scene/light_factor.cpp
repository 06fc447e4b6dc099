#include "io/scene/light_factor.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace io {

double read_light_factor(const JsonItem& item) {
  if (item.value().is_string()) {
    const std::string word = item.text();
    if (word == "on") return 1;
    if (word == "off") return 0;
    item.fail(fmt::format("found '{}', expected \"on\", \"off\" or a number", word));
  }
  const double factor = item.number();
  if (!(factor >= 0 && std::isfinite(factor))) {
    item.fail(fmt::format("found {}, expected a factor of at least 0", factor));
  }
  return factor;
}

}  // namespace io
