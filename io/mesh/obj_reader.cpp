#include "io/mesh/obj_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/mesh/mtl_reader.h"
#include "io/mesh/obj_coordinates.h"
#include "io/mesh/surface_index.h"
#include "io/mesh/texture_coordinates.h"

namespace io {
namespace {

using radiosity::Progress;
using radiosity::Scene;

/// Statements without a meaning for us: normals, smoothing, points, lines, display.
constexpr std::array<std::string_view, 14> kIgnoredByObj = {
    "vn",       "vp",       "s",   "l",          "p",         "mg",     "bevel",
    "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "usemap", "maplib"};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, MeshMaterials wanted, const Progress& progress)
      : path_(path),
        wanted_(wanted),
        progress_(progress),
        lines_(path, progress, LineReader::Continuation::backslash),
        surfaces_(scene_, path.stem().string()) {}

  FileScene read() {
    while (lines_.next_line()) {
      Words words(lines_.line());
      read_statement(words.next(), words);
    }
    const auto n_vertices = static_cast<std::int64_t>(scene_.vertices.size());
    if (largest_forward_ > n_vertices) {
      fail(path_.string() + ":" + std::to_string(largest_forward_line_),
           fmt::format("face uses vertex {}, but the file has {}", largest_forward_, n_vertices));
    }
    scene_.texture_coordinates = coordinates_.resolved(scene_.corners.size());
    check_texture_coordinates(path_, scene_, repairs_);
    report_repairs();
    return {std::move(scene_), std::move(repairs_)};
  }

 private:
  void read_statement(std::string_view keyword, Words& words) {
    if (keyword.empty() || keyword[0] == '#') return;
    if (keyword == "v") {
      lines_.recognise();
      scene_.vertices.push_back(lines_.point(words));  // w or a colour may follow
    } else if (keyword == "f") {
      read_face(words);
    } else if (keyword == "vt") {
      if (wanted_ == MeshMaterials::wanted) coordinates_.add(words);
    } else if (keyword == "o") {
      has_object_ = true;
      name_surface(std::string(words.rest()));
    } else if (keyword == "g") {
      if (!has_object_) name_surface(std::string(words.rest()));
    } else if (keyword == "usemtl") {
      use_material(std::string(words.rest()));
    } else if (keyword == "mtllib") {
      read_libraries(words);
    } else if (std::find(kIgnoredByObj.begin(), kIgnoredByObj.end(), keyword) ==
               kIgnoredByObj.end()) {
      warn_unknown(keyword);
    }
  }

  void read_face(Words& words) {
    face_.clear();
    const bool has_texture = material_ >= 0 && scene_.materials[material_].texture;
    for (auto word = words.next(); !word.empty() && word[0] != '#'; word = words.next()) {
      if (has_texture) {
        coordinates_.use(scene_.corners.size() + face_.size(), word, places_[material_]);
      }
      face_.push_back(vertex_index(word));
    }
    if (surface_ < 0) surface_ = surfaces_.find_or_add(object_, material_, unknown_material_);
    scene_.add_polygon(face_, surface_);  // of fewer than three corners too: left out with others
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
    const bool is_known = entry != materials_.end();
    material_ = is_known ? entry->second : -1;
    unknown_material_ = is_known ? "" : name;
    surface_ = -1;
    if (is_known || wanted_ == MeshMaterials::not_needed) return;
    if (name.empty()) {
      nameless_.add(where(), "usemtl names no material");
    } else {
      unknown_.add(where(), fmt::format("unknown material {}: {}", in_quotes(name),
                                        has_library_ ? "no .mtl file read so far defines it"
                                                     : "no mtllib names a file before it"));
    }
  }

  /// `mtllib a.mtl b.mtl`, or one name with blanks in it.
  void read_libraries(Words words) {
    const std::string whole(words.rest());
    if (whole.empty() && wanted_ == MeshMaterials::wanted) {
      missing_.add(where(), "mtllib names no file");
    }
    if (find_beside(path_, whole)) return read_library(whole);
    for (auto word = words.next(); !word.empty(); word = words.next()) {
      read_library(std::string(word));
    }
  }

  void read_library(const std::string& name) {
    if (!libraries_.insert(name).second) return;  // some programs name it before each object
    const auto path = find_beside(path_, name);
    if (path || !name.empty()) scene_.files.push_back(path ? *path : path_.parent_path() / name);
    if (wanted_ == MeshMaterials::not_needed) {
      if (path) add_pictures(*path);
      return;
    }
    if (!path) {
      missing_.add(where(), fmt::format("material file {} does not exist", in_quotes(name)));
      return;
    }
    has_library_ = true;
    MtlFile file = read_mtl(*path, &pictures_, progress_);
    for (std::size_t k = 0; k < file.materials.size(); ++k) {
      radiosity::Material& material = file.materials[k];
      const auto index = static_cast<int>(scene_.materials.size());
      if (materials_.try_emplace(material.name, index).second) {
        scene_.materials.push_back(std::move(material));
        places_.push_back(file.textures[k]);
      } else {
        doubled_.add(where(), fmt::format("material {} of {} is already defined by another file",
                                          in_quotes(material.name), path->string()));
      }
    }
    scene_.warnings.insert(scene_.warnings.end(), file.warnings.begin(), file.warnings.end());
    repairs_.insert(repairs_.end(), file.repairs.begin(), file.repairs.end());
    scene_.files.insert(scene_.files.end(), file.pictures.begin(), file.pictures.end());
  }

  /// Of a material file that is not needed and may be as bad as it likes: no output may be one of
  /// its pictures.
  void add_pictures(const std::filesystem::path& library) {
    try {
      const MtlFile file = read_mtl(library, nullptr, progress_);
      scene_.files.insert(scene_.files.end(), file.pictures.begin(), file.pictures.end());
    } catch (const radiosity::SceneError&) {
      return;
    }
  }

  [[nodiscard]] std::string where() const {
    return fmt::format("{}:{}", path_.string(), lines_.line_number());
  }

  void report_repairs() {
    missing_.report("what it would define is left without a material", repairs_);
    doubled_.report("the first definition counts", repairs_);
    nameless_.report("what follows has none", repairs_);
    // Where the file is missing all its materials are, and one line says so.
    if (missing_.empty()) unknown_.report("what follows has none", repairs_);
  }

  void warn_unknown(std::string_view keyword) {
    if (std::exchange(has_warned_, true)) return;
    scene_.warnings.push_back(
        fmt::format("{}: unknown statement {} is ignored", where(), lines_.shown(keyword)));
  }

  std::filesystem::path path_;
  MeshMaterials wanted_;
  const Progress& progress_;
  LineReader lines_;
  Scene scene_;
  std::vector<std::string> repairs_;
  SurfaceIndex surfaces_;
  std::map<std::string, int> materials_;
  std::vector<MtlTexture> places_;  // per material
  TexturePictures pictures_;
  ObjCoordinates coordinates_;
  std::set<std::string> libraries_;
  RepairCount missing_, doubled_, nameless_, unknown_;
  bool has_library_ = false;
  bool has_object_ = false;
  bool has_warned_ = false;
  std::string object_;
  int material_ = -1;
  std::string unknown_material_;  // its name if it is not there
  std::int32_t surface_ = -1;     // of the next face; -1 = to be looked up
  std::vector<std::int32_t> face_;
  std::int64_t largest_forward_ = 0;  // largest vertex number used before that vertex was given
  long largest_forward_line_ = 0;
};

}  // namespace

FileScene read_obj(const std::filesystem::path& path, MeshMaterials materials,
                   const Progress& progress) {
  return ObjReader(path, materials, progress).read();
}

}  // namespace io
