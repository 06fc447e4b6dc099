#include "io/mesh/off_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/base/input_checks.h"
#include "io/base/line_reader.h"

namespace io {
namespace {

using radiosity::Scene;

struct Counts {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
};

/// Whether `word` is one of the headers with three coordinates per vertex: [ST][C][N]OFF.
bool is_header(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

/// The header word, which may be missing, and the counts on its line or on the next.
Counts read_counts(LineReader& lines) {
  if (!lines.next_content()) lines.fail("file ends before the counts of vertices and faces");
  Words words(lines.line());
  if (const auto first = Words(words).next(); !parse_number<std::int64_t>(first)) {
    if (!is_header(first))
      lines.fail(fmt::format("expected \"OFF\", found {}", lines.shown(first)));
    lines.recognise();
    words.next();
    if (words.rest() == "BINARY") lines.fail("binary OFF is not supported, expected ascii");
    if (words.rest().empty()) {
      if (!lines.next_content()) lines.fail("file ends before the counts of vertices and faces");
      words = Words(lines.line());
    }
  }
  Counts counts;
  counts.vertices = lines.integer(words, "the number of vertices");
  counts.faces = lines.integer(words, "the number of faces");
  lines.recognise();
  if (counts.vertices < 0 || counts.faces < 0) {
    lines.fail(fmt::format("found {} vertices and {} faces, expected no negative number",
                           counts.vertices, counts.faces));
  }
  return counts;
}

void read_vertices(LineReader& lines, std::int64_t n_vertices, Scene& scene) {
  // The shortest line of a vertex, "0 0 0\n", has 6 bytes: no count allocates more than that.
  scene.vertices.reserve(std::min<std::uint64_t>(n_vertices, lines.size() / 6 + 1));
  for (std::int64_t i = 0; i < n_vertices; ++i) {
    if (!lines.next_content()) {
      lines.fail(fmt::format("file ends after {} of {} vertices", i, n_vertices));
    }
    Words words(lines.line());
    scene.vertices.push_back(lines.point(words));
  }
}

void read_faces(LineReader& lines, const Counts& counts, Scene& scene) {
  std::vector<std::int64_t> face;
  std::vector<std::int32_t> corners;
  for (std::int64_t i = 0; i < counts.faces; ++i) {
    if (!lines.next_content()) {
      lines.fail(fmt::format("file ends after {} of {} faces", i, counts.faces));
    }
    Words words(lines.line());
    const std::int64_t n_corners = lines.integer(words, "the number of a face's vertices");
    face.clear();
    if (n_corners < 0) lines.fail(fmt::format("a face has {} vertices", n_corners));
    for (std::int64_t k = 0; k < n_corners; ++k) {
      face.push_back(lines.integer(words, "a vertex index"));
    }
    if (const auto problem = index_problem(face, counts.vertices)) lines.fail(*problem);
    corners.assign(face.begin(), face.end());
    scene.add_polygon(corners, 0);
  }
}

}  // namespace

FileScene read_off(const std::filesystem::path& path, const radiosity::Progress& progress) {
  LineReader lines(path, progress);
  Scene scene;
  scene.surfaces.push_back({.name = path.stem().string(), .material = -1, .two_sided = false});
  const Counts counts = read_counts(lines);
  read_vertices(lines, counts.vertices, scene);
  read_faces(lines, counts, scene);
  FileScene result{std::move(scene), {}};
  // Edges may follow, which some programs write.
  long n_lines = 0;
  while (lines.next_content()) ++n_lines;
  if (n_lines > 0) {
    result.repairs.push_back(
        fmt::format("{}: {} more lines after the last face are ignored", path.string(), n_lines));
  }
  return result;
}

}  // namespace io
