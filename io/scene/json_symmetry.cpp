#include "io/scene/json_symmetry.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "io/scene/scene_keys.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using radiosity::kMostImages;
using radiosity::Symmetry;
using radiosity::Vec3;

constexpr std::size_t kMostMirrors = 3;
constexpr std::size_t kMostTranslations = 2;

/// "x=0", "y = 1.5"
Symmetry::Mirror read_plane(const JsonItem& item, double unit) {
  std::string text = item.text();
  std::erase(text, ' ');
  const std::size_t axis = std::string("xyz").find(text[0]);
  double place = 0;
  const char* end = text.data() + text.size();
  bool is_plane = axis != std::string::npos && text.size() > 2 && text[1] == '=';
  if (is_plane) {
    const auto [rest, error] = std::from_chars(text.data() + 2, end, place);
    is_plane = error == std::errc() && rest == end && std::isfinite(place);
  }
  if (!is_plane) {
    item.fail(fmt::format("found \"{}\", expected a plane such as \"x=0\", or its point and normal",
                          item.text()));
  }
  const auto n = static_cast<Eigen::Index>(axis);
  return {unit * place * Vec3::Unit(n), Vec3::Unit(n)};
}

Symmetry::Mirror read_mirror(const JsonItem& item, double unit) {
  if (item.value().is_string()) return read_plane(item, unit);
  item.check_keys(keys::kMirror);
  return {unit * item.at("point").point(), item.at("normal").direction()};
}

int whole_number(const JsonItem& item, int least) {
  const double number = item.number();
  if (!(number >= least && number <= kMostImages && number == std::floor(number))) {
    item.fail(
        fmt::format("is {}, expected a whole number from {} to {}", number, least, kMostImages));
  }
  return static_cast<int>(number);
}

Symmetry::Rotation read_rotation(const JsonItem& item, double unit) {
  item.check_keys(keys::kSymmetryRotation);
  const auto point = item.find("point");
  return {point ? Vec3(unit * point->point()) : Vec3(Vec3::Zero()), item.at("axis").direction(),
          whole_number(item.at("folds"), 2)};
}

/// Images on each side of translation k.
int read_cut_off(const JsonItem& item, std::size_t k, double length, double unit) {
  if (item.has("cut_off") == item.has("images")) {
    item.fail("expected either \"cut_off\" or \"images\" beside \"translation\"");
  }
  if (const auto images = item.find("images")) {
    if (images->value().is_number()) return whole_number(*images, 1);
    if (images->size() != item.at("translation").size()) {
      images->fail("expected a whole number, or one for each translation");
    }
    return whole_number((*images)[k], 1);
  }
  const JsonItem cut_off = item.at("cut_off");
  const double distance = cut_off.number();
  if (!(distance > 0)) cut_off.fail(fmt::format("is {}, expected more than 0", distance));
  const double images = std::ceil(unit * distance / length);
  if (images > kMostImages) {
    cut_off.fail(fmt::format("is {}, which takes more than {} images", distance, kMostImages));
  }
  return static_cast<int>(images);
}

void read_translations(const JsonItem& item, double unit, Symmetry& symmetry) {
  const JsonItem list = item.at("translation");
  if (list.size() < 1 || list.size() > kMostTranslations) {
    list.fail(fmt::format("has {}, expected one or two translations", list.size()));
  }
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Vec3 step = unit * list[k].point();
    if (!(step.norm() > 0)) list[k].fail("is 0, expected a direction with a length");
    symmetry.translations.push_back({step, read_cut_off(item, k, step.norm(), unit)});
  }
}

}  // namespace

Symmetry read_symmetry(const JsonItem& item, double unit) {
  item.check_keys(keys::kSymmetry);
  Symmetry symmetry;
  if (const auto mirrors = item.find("mirror")) {
    if (mirrors->size() < 1 || mirrors->size() > kMostMirrors) {
      mirrors->fail(fmt::format("has {}, expected one to three mirror planes", mirrors->size()));
    }
    for (std::size_t k = 0; k < mirrors->size(); ++k) {
      symmetry.mirrors.push_back(read_mirror((*mirrors)[k], unit));
    }
  }
  if (const auto rotation = item.find("rotation")) {
    symmetry.rotation = read_rotation(*rotation, unit);
  }
  if (item.has("translation")) {
    read_translations(item, unit, symmetry);
  } else if (item.has("cut_off") || item.has("images")) {
    item.fail("has a cut-off without a \"translation\"");
  }
  if (symmetry.is_none()) item.fail("expected \"mirror\", \"rotation\" or \"translation\"");
  try {
    (void)radiosity::image_motions(symmetry);
  } catch (const radiosity::SceneError& error) {
    item.fail(error.what());
  }
  return symmetry;
}

}  // namespace io
