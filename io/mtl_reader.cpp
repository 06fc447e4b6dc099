#include "io/mtl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "io/input_checks.h"
#include "io/line_reader.h"

namespace io {
namespace {

constexpr std::array<std::string_view, 22> kIgnored = {
    "Ka",    "Ks",   "Ns",   "Ni", "d",  "Tr", "Tf", "illum", "sharpness", "bump",  "disp",
    "decal", "refl", "norm", "Pr", "Pm", "Ps", "Pc", "Pcr",   "Km",        "aniso", "anisor"};

constexpr std::array<std::string_view, 6> kPictures = {"bump", "disp", "decal",
                                                       "refl", "norm", "map"};

/// What `map_Kd -s 1 1 1 wood.png` may mean: names have blanks in them, too.
void add_pictures(const std::filesystem::path& path, Words words, MtlFile& file) {
  for (auto rest = words.rest(); !rest.empty(); rest = words.rest()) {
    file.pictures.push_back(path.parent_path() / rest);
    words.next();
  }
}

bool is_picture(std::string_view keyword) {
  return std::find(kPictures.begin(), kPictures.end(), keyword.substr(0, keyword.find('_'))) !=
         kPictures.end();
}

bool is_ignored(std::string_view keyword) {
  return keyword.starts_with("map_") ||
         std::find(kIgnored.begin(), kIgnored.end(), keyword) != kIgnored.end();
}

/// `Kd r g b`, or `Kd r` for equal bands.
Eigen::VectorXd read_rgb(const LineReader& lines, Words& words, std::string_view keyword) {
  const double red = lines.number(words, keyword);
  if (words.rest().empty()) return Eigen::VectorXd::Constant(3, red);
  const double green = lines.number(words, keyword);
  const double blue = lines.number(words, keyword);
  return Eigen::Vector3d(red, green, blue);
}

/// Reads the value of `Kd` or `Ke` into the material.
void read_key(const LineReader& lines, std::string_view keyword, Words& words, MtlFile& file) {
  if (file.materials.empty()) lines.fail(fmt::format("{} stands before any newmtl", keyword));
  auto& material = file.materials.back();
  const Eigen::VectorXd value = read_rgb(lines, words, keyword);
  if (keyword == "Kd") {
    if (const auto problem = reflectance_problem(value)) lines.fail(*problem);
    material.reflectance = value;
  } else {
    if (const auto problem = emission_problem("radiance Ke", value)) lines.fail(*problem);
    material.emission = {};
    if (!value.isZero(0)) material.emission = {radiosity::Emission::Kind::radiance, value};
  }
}

void complete_reflectances(const std::filesystem::path& path, MtlFile& file) {
  for (auto& material : file.materials) {
    if (material.reflectance.size() > 0) continue;
    material.reflectance = Eigen::VectorXd::Constant(3, kDefaultReflectance);
    file.warnings.push_back(fmt::format("{}: material \"{}\" has no Kd; its reflectance is {}",
                                        path.string(), material.name, kDefaultReflectance));
  }
}

}  // namespace

MtlFile read_mtl(const std::filesystem::path& path, const radiosity::Progress& progress) {
  LineReader lines(path, progress, LineReader::Continuation::backslash);
  MtlFile file;
  std::set<std::string> names;
  bool has_warned = false;
  while (lines.next_line()) {
    Words words(lines.line());
    const auto keyword = words.next();
    if (keyword.empty() || keyword[0] == '#') continue;
    if (keyword == "newmtl") {
      lines.recognise();
      const std::string name(words.rest());
      if (name.empty()) lines.fail("newmtl without a name");
      if (!names.insert(name).second) {
        lines.fail(fmt::format("material \"{}\" is already defined", name));
      }
      file.materials.push_back({.name = name, .reflectance = {}, .emission = {}});
    } else if (keyword == "Kd" || keyword == "Ke") {
      read_key(lines, keyword, words, file);
    } else if (is_picture(keyword)) {
      add_pictures(path, words, file);
    } else if (!is_ignored(keyword) && !std::exchange(has_warned, true)) {
      file.warnings.push_back(fmt::format("{}:{}: unknown key {} is ignored", path.string(),
                                          lines.line_number(), lines.shown(keyword)));
    }
  }
  complete_reflectances(path, file);
  return file;
}

}  // namespace io
