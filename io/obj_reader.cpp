#include "io/obj_reader.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <set>
#include <utility>

#include "io/line_reader.h"
#include "io/mtl_reader.h"
#include "io/surface_index.h"

namespace io {
namespace {

using radiosity::Progress;
using radiosity::Scene;

/// Statements without a meaning for us: texture, normals, smoothing, points, lines, display.
constexpr std::array<std::string_view, 15> kIgnored = {
    "vt",       "vn",       "vp",  "s",          "l",         "p",      "mg",    "bevel",
    "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "usemap", "maplib"};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const Progress& progress)
      : path_(path),
        progress_(progress),
        lines_(path, progress, LineReader::Continuation::backslash),
        surfaces_(scene_, path.stem().string()) {}

  Scene read() {
    while (lines_.next_line()) {
      Words words(lines_.line());
      read_statement(words.next(), words);
    }
    const auto n_vertices = static_cast<std::int64_t>(scene_.vertices.size());
    if (largest_forward_ > n_vertices) {
      fail(path_.string() + ":" + std::to_string(largest_forward_line_),
           fmt::format("face uses vertex {}, but the file has {}", largest_forward_, n_vertices));
    }
    return std::move(scene_);
  }

 private:
  void read_statement(std::string_view keyword, Words& words) {
    if (keyword.empty() || keyword[0] == '#') return;
    if (keyword == "v") {
      lines_.recognise();
      scene_.vertices.push_back(lines_.point(words));  // w or a colour may follow
    } else if (keyword == "f") {
      read_face(words);
    } else if (keyword == "o") {
      has_object_ = true;
      name_surface(std::string(words.rest()));
    } else if (keyword == "g") {
      if (!has_object_) name_surface(std::string(words.rest()));
    } else if (keyword == "usemtl") {
      use_material(std::string(words.rest()));
    } else if (keyword == "mtllib") {
      read_libraries(words);
    } else if (std::find(kIgnored.begin(), kIgnored.end(), keyword) == kIgnored.end()) {
      warn_unknown(keyword);
    }
  }

  void read_face(Words& words) {
    face_.clear();
    for (auto word = words.next(); !word.empty() && word[0] != '#'; word = words.next()) {
      face_.push_back(vertex_index(word));
    }
    if (face_.size() < 3) {
      lines_.fail(fmt::format("face has {} vertices, expected at least 3", face_.size()));
    }
    if (surface_ < 0) surface_ = surfaces_.find_or_add(object_, material_);
    scene_.add_polygon(face_, surface_);
  }

  /// The index from 0 of a face's corner "7", "7/1", "7//2", "7/1/2" or "-3".
  std::int32_t vertex_index(std::string_view word) {
    const auto number = parse_number<std::int64_t>(word.substr(0, word.find('/')));
    if (!number) lines_.fail(fmt::format("expected a vertex number, found {}", lines_.shown(word)));
    const auto n_vertices = static_cast<std::int64_t>(scene_.vertices.size());
    if (*number == 0) lines_.fail("face uses vertex 0, but vertices are counted from 1");
    if (*number < -n_vertices) {
      lines_.fail(fmt::format("face uses vertex {}, but only {} precede it", *number, n_vertices));
    }
    if (*number < 0) return static_cast<std::int32_t>(n_vertices + *number);
    // A face may stand before its vertices: whether they come is known at the end of the file.
    if (*number > n_vertices && *number > largest_forward_) {
      largest_forward_ = *number;
      largest_forward_line_ = lines_.line_number();
    }
    return static_cast<std::int32_t>(*number - 1);
  }

  void name_surface(std::string name) {
    object_ = std::move(name);
    surface_ = -1;
  }

  void use_material(const std::string& name) {
    const auto entry = materials_.find(name);
    if (entry == materials_.end()) {
      lines_.fail(has_library_ ? fmt::format("unknown material \"{}\": no .mtl file read so far "
                                             "defines it",
                                             name)
                               : fmt::format("unknown material \"{}\": no mtllib names a file "
                                             "before it",
                                             name));
    }
    material_ = entry->second;
    surface_ = -1;
  }

  /// `mtllib a.mtl b.mtl`, or one name with blanks in it.
  void read_libraries(Words words) {
    const std::string whole(words.rest());
    if (whole.empty()) lines_.fail("mtllib names no file");
    if (std::filesystem::exists(path_.parent_path() / whole)) return read_library(whole);
    for (auto word = words.next(); !word.empty(); word = words.next()) {
      read_library(std::string(word));
    }
  }

  void read_library(const std::string& name) {
    const auto path = path_.parent_path() / name;
    has_library_ = true;
    scene_.files.push_back(path);
    if (!libraries_.insert(path).second) return;  // some programs name it before each object
    if (!std::filesystem::exists(path)) {
      lines_.fail(fmt::format("material file {} does not exist", path.string()));
    }
    MtlFile file = read_mtl(path, progress_);
    for (auto& material : file.materials) {
      const auto index = static_cast<int>(scene_.materials.size());
      if (!materials_.try_emplace(material.name, index).second) {
        lines_.fail(fmt::format("material \"{}\" of {} is already defined by another file",
                                material.name, path.string()));
      }
      scene_.materials.push_back(std::move(material));
    }
    scene_.warnings.insert(scene_.warnings.end(), file.warnings.begin(), file.warnings.end());
    scene_.files.insert(scene_.files.end(), file.pictures.begin(), file.pictures.end());
  }

  void warn_unknown(std::string_view keyword) {
    if (std::exchange(has_warned_, true)) return;
    scene_.warnings.push_back(fmt::format("{}:{}: unknown statement {} is ignored",
                                          path_.string(), lines_.line_number(),
                                          lines_.shown(keyword)));
  }

  std::filesystem::path path_;
  const Progress& progress_;
  LineReader lines_;
  Scene scene_;
  SurfaceIndex surfaces_;
  std::map<std::string, int> materials_;
  std::set<std::filesystem::path> libraries_;
  bool has_library_ = false;
  bool has_object_ = false;
  bool has_warned_ = false;
  std::string object_;
  int material_ = -1;
  std::int32_t surface_ = -1;  // of the next face; -1 = to be looked up
  std::vector<std::int32_t> face_;
  std::int64_t largest_forward_ = 0;  // largest vertex number used before that vertex was given
  long largest_forward_line_ = 0;
};

}  // namespace

Scene read_obj(const std::filesystem::path& path, const Progress& progress) {
  return ObjReader(path, progress).read();
}

}  // namespace io
