#include "io/mesh/mtl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "io/base/input_checks.h"
#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/mesh/file_scene.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

constexpr std::array<std::string_view, 22> kIgnoredByMtl = {
    "Ka",    "Ks",   "Ns",   "Ni", "d",  "Tr", "Tf", "illum", "sharpness", "bump",  "disp",
    "decal", "refl", "norm", "Pr", "Pm", "Ps", "Pc", "Pcr",   "Km",        "aniso", "anisor"};

constexpr std::array<std::string_view, 6> kPictures = {"bump", "disp", "decal",
                                                       "refl", "norm", "map"};

/// What `map_Kd -s 1 1 1 wood.png` may mean: names have blanks in them, too. Bounded, or a line of
/// many words would make as many names as long as itself.
void add_pictures(const std::filesystem::path& path, Words words, MtlFile& file) {
  constexpr int kMostWords = 32;          // all options together have fewer
  constexpr std::size_t kLongest = 4096;  // that systems open
  for (int k = 0; k < kMostWords && !words.rest().empty(); ++k) {
    if (words.rest().size() <= kLongest) file.pictures.push_back(path.parent_path() / words.rest());
    words.next();
  }
}

bool is_picture(std::string_view keyword) {
  return std::find(kPictures.begin(), kPictures.end(), keyword.substr(0, keyword.find('_'))) !=
         kPictures.end();
}

bool is_ignored(std::string_view keyword) {
  return keyword.starts_with("map_") ||
         std::find(kIgnoredByMtl.begin(), kIgnoredByMtl.end(), keyword) != kIgnoredByMtl.end();
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
void read_key(const LineReader& lines, std::string_view keyword, Words& words,
              radiosity::Material& material) {
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

/// Reads the picture of each material that names one; Kd is then what it is times.
void read_textures(const std::filesystem::path& path, TexturePictures& pictures,
                   const radiosity::Progress& progress, MtlFile& file) {
  RepairCount unread;
  RepairCount changed;
  for (std::size_t k = 0; k < file.materials.size(); ++k) {
    const MtlTexture& given = file.textures[k];
    radiosity::Material& material = file.materials[k];
    if (given.file.empty()) continue;
    const std::string who = fmt::format("material {}", in_quotes(material.name));
    if (given.has_other_options) {
      changed.add(path.string(), who + " has options of map_Kd beside -s, -o and -clamp");
    }
    try {
      const auto picture = find_beside(path, given.file);
      if (!picture) {
        unread.add(path.string(),
                   fmt::format("{}: picture {} does not exist", who, in_quotes(given.file)));
        continue;
      }
      radiosity::Texture texture{
          .image = pictures.read(*picture, progress), .across = given.wrap, .down = given.wrap};
      if (material.reflectance.size() > 0) texture.factor = material.reflectance;
      material.reflectance = texture_mean(texture).mean;
      material.texture = std::move(texture);
    } catch (const radiosity::SceneError& error) {
      unread.add(path.string(), who + ": " + error.what());
    }
  }
  unread.report("Kd alone counts", file.repairs);
  changed.report("they are ignored", file.warnings);
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

MtlFile read_mtl(const std::filesystem::path& path, TexturePictures* pictures,
                 const radiosity::Progress& progress) {
  LineReader lines(path, progress, LineReader::Continuation::backslash);
  MtlFile file;
  std::set<std::string> names;
  bool has_warned = false;
  RepairCount doubled;
  RepairCount nameless;
  RepairCount before_any;
  radiosity::Material left_out;  // takes the keys of a material that does not count
  bool is_left_out = false;
  const auto where = [&] { return fmt::format("{}:{}", path.string(), lines.line_number()); };
  while (lines.next_line()) {
    Words words(lines.line());
    const auto keyword = words.next();
    if (keyword.empty() || keyword[0] == '#') continue;
    if (keyword == "newmtl") {
      lines.recognise();
      const std::string name(words.rest());
      is_left_out = name.empty() || !names.insert(name).second;
      if (name.empty()) {
        nameless.add(where(), "newmtl names no material");
      } else if (is_left_out) {
        doubled.add(where(), fmt::format("material {} is already defined", in_quotes(name)));
      } else {
        file.materials.push_back({.name = name, .reflectance = {}, .emission = {}});
        file.textures.emplace_back();
      }
    } else if (keyword == "Kd" || keyword == "Ke") {
      if (file.materials.empty() && !is_left_out) {
        before_any.add(where(), fmt::format("{} stands before any newmtl", keyword));
      }
      const bool counts = !is_left_out && !file.materials.empty();
      read_key(lines, keyword, words, counts ? file.materials.back() : left_out);
    } else if (is_picture(keyword)) {
      if (keyword == "map_Kd" && !is_left_out && !file.materials.empty()) {
        file.textures.back() = read_mtl_texture(words.rest());
      }
      add_pictures(path, words, file);
    } else if (!is_ignored(keyword) && !std::exchange(has_warned, true)) {
      file.warnings.push_back(
          fmt::format("{}: unknown key {} is ignored", where(), lines.shown(keyword)));
    }
  }
  if (pictures != nullptr) read_textures(path, *pictures, progress, file);
  complete_reflectances(path, file);
  doubled.report("the first definition counts", file.repairs);
  nameless.report("it is left out", file.repairs);
  before_any.report("it is left out", file.repairs);
  return file;
}

}  // namespace io
