#include "io/mesh/vs3_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "io/base/line_reader.h"

namespace io {
namespace {

using radiosity::Vec3;

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// Up to the word that begins a comment.
std::string without_comment(std::string_view line) {
  bool starts_word = true;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (starts_word && (line[k] == '!' || line[k] == '/')) return std::string(line.substr(0, k));
    starts_word = std::isspace(static_cast<unsigned char>(line[k])) != 0;
  }
  return std::string(line);
}

class Vs3Parser {
 public:
  Vs3Parser(const std::filesystem::path& path, const radiosity::Progress& progress)
      : lines_(path, progress) {}

  Vs3File run() {
    while (next_line()) {
      const std::string_view word = words_.next();
      switch (std::tolower(static_cast<unsigned char>(word[0]))) {
        case 't':
          file_.title = trimmed(lines_.line().substr(lines_.line().find(word) + word.size()));
          break;
        case 'c':
          read_control();
          break;
        case 'f':
          read_geometry();
          break;
        case 'v':
          read_vertex();
          break;
        case 's':
          read_surface(Vs3Surface::Kind::radiating);
          break;
        case 'n':
          read_surface(Vs3Surface::Kind::null);
          break;
        case 'o':
          read_surface(Vs3Surface::Kind::obstruction);
          break;
        case 'm':
          read_surface(Vs3Surface::Kind::mask);
          break;
        case 'e':
        case '*':
          return finished();
        default:
          lines_.fail(fmt::format("expected one of T, C, F, V, S, M, N, O, E, found {}",
                                  lines_.shown(word)));
      }
    }
    return finished();
  }

 private:
  enum class Geometry { vertices, planes };

  /// To the next line with more than a comment.
  bool next_line() {
    while (lines_.next_line()) {
      line_ = without_comment(lines_.line());
      words_ = Words(line_);
      if (!words_.rest().empty()) return true;
    }
    return false;
  }

  void read_control() {
    std::replace_if(
        line_.begin(), line_.end(), [](char c) { return c == '=' || c == ','; }, ' ');
    words_ = Words(line_);
    words_.next();
    while (!words_.rest().empty()) {
      const std::string name = lower_case(words_.next());
      const double value = lines_.number(words_, "the value of " + printable_name(name));
      if (name == "encl") file_.control.is_enclosure = value != 0;
      if (name == "emit") file_.control.is_script_f = value != 0;
      if (name == "out") {
        if (value != 0 && value != 1) lines_.fail("expected out=0 (text) or out=1 (binary)");
        file_.control.is_binary = value == 1;
      }
      if ((name == "row" || name == "col") && value != 0) {
        warn("all rows and columns are computed, whatever row and col say");
      }
    }
  }

  /// So that messages stay short and in one piece.
  [[nodiscard]] std::string printable_name(const std::string& name) const {
    return lines_.shown(name);
  }

  void warn(const std::string& text) {
    file_.warnings.push_back(fmt::format("line {}: {}", lines_.line_number(), text));
  }

  void read_geometry() {
    const std::string_view word = words_.next();
    const std::string name = lower_case(word);
    if (name != "3" && name != "3a") {
      lines_.fail(fmt::format("expected the geometry 3 or 3a, found {}", lines_.shown(word)));
    }
    if (!file_.surfaces.empty()) lines_.fail("the geometry must be told before the surfaces");
    geometry_ = name == "3" ? Geometry::vertices : Geometry::planes;
    lines_.recognise();
  }

  /// In order, so that one that was left out is noticed.
  void read_number(std::string_view what, std::size_t expected) {
    const std::int64_t number = lines_.integer(words_, fmt::format("the number of a {}", what));
    if (number != static_cast<std::int64_t>(expected)) {
      lines_.fail(fmt::format("{} {} is out of sequence, expected {}", what, number, expected));
    }
  }

  void read_vertex() {
    read_number("vertex", vertices_.size() + 1);
    vertices_.push_back(lines_.point(words_));
  }

  void read_surface(Vs3Surface::Kind kind) {
    if (!geometry_) lines_.fail("a surface before the geometry, expected F 3 or F 3a");
    Vs3Surface surface;
    surface.kind = kind;
    surface.line = lines_.line_number();
    read_number("surface", file_.surfaces.size() + 1);
    const bool radiates = kind != Vs3Surface::Kind::obstruction;
    if (radiates && has_obstructions_) lines_.fail("obstructions (O) must come after all others");
    has_obstructions_ = !radiates;
    if (*geometry_ == Geometry::vertices) {
      read_corners(surface);
      if (radiates) read_properties(surface);
    } else {
      const std::string shape = lower_case(words_.next());
      if (shape != "r" && shape != "t" && shape != "q") {
        lines_.fail("expected the shape R, T or Q, found " + lines_.shown(shape));
      }
      if (radiates) read_properties(surface);
      words_ = Words("");
      read_plane(shape[0], surface);
    }
    file_.surfaces.push_back(std::move(surface));
  }

  void read_corners(Vs3Surface& surface) {
    const auto n_vertices = static_cast<std::int64_t>(vertices_.size());
    for (int k = 0; k < 4; ++k) {
      const std::int64_t vertex = lines_.integer(words_, "a vertex");
      if (vertex == 0 && k == 3) break;
      if (vertex < 1 || vertex > n_vertices) {
        lines_.fail(
            fmt::format("the surface uses vertex {}, but there are {}", vertex, n_vertices));
      }
      surface.corners.push_back(vertices_[static_cast<std::size_t>(vertex - 1)]);
    }
  }

  void read_properties(Vs3Surface& surface) {
    surface.base = static_cast<int>(read_index("base"));
    const std::int64_t combined = read_index("combined");
    if (combined >= static_cast<std::int64_t>(file_.surfaces.size())) {
      lines_.fail(fmt::format("combined with surface {}, expected an earlier one", combined + 1));
    }
    surface.combined_with = static_cast<int>(combined);
    surface.emissivity = lines_.number(words_, "the emissivity");
    if (surface.emissivity < 0 || surface.emissivity > 1) {
      lines_.fail(fmt::format("emissivity {} is outside [0, 1]", surface.emissivity));
    }
    surface.name = words_.next();
    check_combination(surface);
  }

  /// Of another surface, from 0, or -1 for none.
  std::int64_t read_index(std::string_view what) {
    constexpr std::int64_t kMost = 1'000'000'000;
    const std::int64_t number = lines_.integer(words_, fmt::format("the {} surface", what));
    if (number < 0 || number > kMost) {
      lines_.fail(fmt::format("there is no {} surface {}", what, number));
    }
    return number - 1;
  }

  void check_combination(const Vs3Surface& surface) const {
    if (surface.combined_with < 0) return;
    const Vs3Surface& other = file_.surfaces[static_cast<std::size_t>(surface.combined_with)];
    if (covers_base(surface) || covers_base(other)) {
      lines_.fail("a masking surface (M) or null surface (N) cannot be combined");
    }
    if (other.combined_with >= 0) {
      lines_.fail(fmt::format("combined with surface {}, which is itself combined with {}",
                              surface.combined_with + 1, other.combined_with + 1));
    }
  }

  /// A number of a plane, which may stand on a further line.
  double plane_number(std::string_view what) {
    if (words_.rest().empty() && !next_line()) {
      lines_.fail(fmt::format("file ends where {} is expected", what));
    }
    return lines_.number(words_, what);
  }

  /// Corners in a plane that is told by a point, by the azimuth of its normal (0 = y, 90 = x,
  /// clockwise) and by its tilt (0 = it looks up); x runs to the left as seen from its back.
  void read_plane(char shape, Vs3Surface& surface) {
    const double x = plane_number("coordinate x");
    const double y = plane_number("coordinate y");
    const double z = plane_number("coordinate z");
    const double azimuth = plane_number("the azimuth") * std::numbers::pi / 180;
    const double tilt = plane_number("the tilt") * std::numbers::pi / 180;
    const auto exact = [](double value) { return std::abs(value) < 1e-15 ? 0 : value; };
    const double c = exact(std::cos(azimuth));
    const double s = exact(std::sin(azimuth));
    const Vec3 across(-c, s, 0);
    const Vec3 upwards(-s * exact(std::cos(tilt)), -c * exact(std::cos(tilt)),
                       exact(std::sin(tilt)));
    std::vector<std::array<double, 2>> flat;
    if (shape == 'r') {
      const double width = plane_number("the width");
      const double height = plane_number("the height");
      flat = {{0, height}, {0, 0}, {width, 0}, {width, height}};
    } else {
      for (int k = 0; k < (shape == 't' ? 3 : 4); ++k) {
        const double u = plane_number("a coordinate");
        flat.push_back({u, plane_number("a coordinate")});
      }
    }
    for (const auto& [u, v] : flat) {
      surface.corners.emplace_back(Vec3(x, y, z) + u * across + v * upwards);
    }
  }

  Vs3File finished() {
    if (!geometry_) lines_.fail("file ends without the geometry F 3 or F 3a");
    if (file_.surfaces.empty()) lines_.fail("file ends without surfaces");
    return std::move(file_);
  }

  LineReader lines_;
  std::string line_;
  Words words_{""};
  std::optional<Geometry> geometry_;
  bool has_obstructions_ = false;
  std::vector<Vec3> vertices_;
  Vs3File file_;
};

}  // namespace

Vs3File read_vs3_records(const std::filesystem::path& path, const radiosity::Progress& progress) {
  return Vs3Parser(path, progress).run();
}

}  // namespace io
