#include "io/result/foam_factors.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>

#include "io/base/atomic_file.h"
#include "io/base/line_reader.h"
#include "io/mesh/foam_file.h"

namespace io {
namespace {

using radiosity::Index;

std::string head(const char* type, const std::filesystem::path& path) {
  return fmt::format(
      "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {};\n"
      "    location    \"constant\";\n    object      {};\n}}\n\n",
      type, path.filename().string());
}

/// "0 1 2 ... n-1" in brackets, as often as lists want it.
std::string all_faces(Index n) {
  std::string text = fmt::format("{}(", n);
  for (Index i = 0; i < n; ++i) fmt::format_to(std::back_inserter(text), "{}{}", i ? " " : "", i);
  return text + ')';
}

/// Throws SceneError unless each list of a finalAgglom is 0, 1, 2... as far as its patch has faces.
void check_single_faces(const std::filesystem::path& path, const std::vector<FoamPatch>& patches) {
  FoamTokens tokens(path);
  const bool has_all = tokens.count() == std::ssize(patches);
  tokens.expect("(");
  for (const FoamPatch& patch : patches) {
    const Index n = has_all ? tokens.count() : -1;
    if (n != patch.n) {
      fail(path,
           "is not of this mesh: its lists are not as long as the patches of polyMesh/boundary");
    }
    tokens.expect("(");
    for (Index i = 0; i < n; ++i) {
      if (tokens.number() == static_cast<double>(i)) continue;
      fail(path, "puts faces together; form factors are made between single ones");
    }
    tokens.expect(")");
  }
}

/// Each face of each patch by itself, of those that do not radiate, too.
void write_single_faces(const std::filesystem::path& path) {
  const auto patches = read_foam_patches(path.parent_path() / "polyMesh" / "boundary");
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << head("labelListList", path) << patches.size() << "\n(\n";
    for (const FoamPatch& patch : patches) stream << all_faces(patch.n) << '\n';
    stream << ")\n";
  });
}

/// A list of lists, one on each line; `item` is what each entry that is not 0 is told by.
template <typename Item>
void write_lists(const std::filesystem::path& path, const char* type, const ElementRows& rows,
                 const Item& item) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << head(type, path) << rows.n_elements << "\n(\n";
    std::string line;
    rows.visit([&](Index /*i*/, const Eigen::VectorXd& row) {
      line = fmt::format("{}(", (row.array() != 0).count());
      bool is_first = true;
      for (Index j = 0; j < row.size(); ++j) {
        if (row[j] == 0) continue;
        if (!is_first) line += ' ';
        is_first = false;
        item(j, row[j], line);
      }
      stream << line << ")\n";
    });
    stream << ")\n";
  });
}

}  // namespace

std::vector<std::filesystem::path> foam_companions(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  std::vector<std::filesystem::path> files{folder / "globalFaceFaces", folder / "mapDist"};
  if (!std::filesystem::exists(folder / "finalAgglom")) files.push_back(folder / "finalAgglom");
  return files;
}

void check_foam_case(const std::filesystem::path& path, Index n_elements) {
  const std::filesystem::path folder = path.parent_path();
  if (std::filesystem::exists(folder / "finalAgglom")) {
    check_single_faces(folder / "finalAgglom", read_foam_patches(folder / "polyMesh" / "boundary"));
  }
  Index n_faces = 0;
  for (const FoamPatch& patch : read_radiating_patches(folder / "polyMesh" / "boundary")) {
    n_faces += patch.n;
  }
  if (n_faces == n_elements) return;
  fail(path, fmt::format("the case has {} faces that radiate, the scene {} polygons; expected the "
                         "case's own faces (a .foam file in its folder), none left out",
                         n_faces, n_elements));
}

void write_foam_factors(const std::filesystem::path& path, const ElementRows& rows) {
  check_foam_case(path, rows.n_elements);
  const auto companions = foam_companions(path);
  write_lists(path, "scalarListList", rows, [](Index /*j*/, double factor, std::string& line) {
    fmt::format_to(std::back_inserter(line), "{}", factor);
  });
  write_lists(companions[0], "labelListList", rows, [](Index j, double /*f*/, std::string& line) {
    fmt::format_to(std::back_inserter(line), "{}", j);
  });
  write_stream_atomically(companions[1], [&](std::ofstream& stream) {
    const std::string faces = all_faces(rows.n_elements);
    stream << head("mapDistribute", companions[1]) << rows.n_elements << "\n1(" << faces << ")\n1("
           << faces << ")\n0 0\n\n0()\n0()\n";
  });
  if (companions.size() > 2) write_single_faces(companions[2]);
}

}  // namespace io
