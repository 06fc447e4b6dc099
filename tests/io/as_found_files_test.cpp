// Files as people have them: with faults that other programs read over.

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "tests/support/sample_files.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::Index;
using radiosity::Scene;
using radiosity::Vec3;

const std::filesystem::path kFolder = std::filesystem::path(RADIOSITY_TEST_DATA) / "files";

/// Area of the patches that the scene gives, m²: it can be solved.
double area(const Scene& scene) {
  const std::vector<double> areas = meshing::make_patches(scene).area;
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

class AsFoundFiles : public ScratchFiles {
 protected:
  /// Read with exactly one warning, which contains `warning`, and refused when reading is strict,
  /// with the same reason.
  void expect_repair(const std::filesystem::path& path, double expected_area,
                     const std::string& warning) const {
    SCOPED_TRACE(path.filename().string());
    const Scene scene = io::read_scene(path);
    EXPECT_NEAR(area(scene), expected_area, 1e-12);
    EXPECT_CONTAINS(joined(scene.warnings), warning);
    EXPECT_CONTAINS(error_of(path, {.strict = true}), warning);
  }
  void expect_repair(const std::string& name, const std::string& content, double expected_area,
                     const std::string& warning) const {
    expect_repair(file(name, content), expected_area, warning);
  }
};

const std::string kBoxVertices =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";
const std::string kBoxFaces = "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
const std::string kBox = kBoxVertices + kBoxFaces;
constexpr const char* kMark = "\xef\xbb\xbf";

TEST_F(AsFoundFiles, ByteOrderMarksAndBlankLinesAreReadOver) {
  for (const char* name : {"bom-v.obj", "bom.stl", "blankline.stl", "comment-backslash.obj"}) {
    SCOPED_TRACE(name);
    const Scene scene = io::read_scene(kFolder / name, {.strict = true});
    EXPECT_NEAR(area(scene), 6, 1e-12);
  }
  const Scene marked = io::read_scene(kFolder / "bom-mtllib.obj");  // its paint.mtl is not there
  EXPECT_NEAR(area(marked), 6, 1e-12);
  const Scene spectra = io::read_scene(kFolder / "spectra-excel.json", {.strict = true});
  EXPECT_EQ(spectra.materials[0].reflectance, Eigen::Vector3d(0.7, 0.8, 0.75));
  const std::string json = kJson;
  (void)file("spectra.csv", kMark + kCsv);
  (void)file("square.off", kMark + kOff);
  EXPECT_GT(read("a.json", kMark + json).n_polygons(), 0);
  EXPECT_EQ(read("a.ply", kMark + kAsciiPly).n_polygons(), 2);
  EXPECT_EQ(read("a.stl", "\r\n \n" + kAsciiStl).n_polygons(), 3);
  EXPECT_EQ(read("a.stl", kMark + ("\n" + kAsciiStl)).n_polygons(), 3);
  (void)file("data.bin", gltf_buffer());
  EXPECT_EQ(read("a.gltf", kMark + gltf_json(R"("uri": "data.bin", )")).n_polygons(), 3);
  EXPECT_CONTAINS(error_of("a.obj", std::string("\xff\xfev\0 \0", 6)), "UTF-16");
}

TEST_F(AsFoundFiles, ACommentEndsWithItsLine) {
  EXPECT_NEAR(area(read("a.obj", "# C:\\\n" + kBox)), 6, 1e-12);
  EXPECT_NEAR(area(read("a.obj", "v 0 0 0 # first \\\n" + kBox.substr(8))), 6, 1e-12);
  EXPECT_NEAR(area(read("a.obj", "v \\\n0 0 \\\n0\n" + kBox.substr(8))), 6, 1e-12);
}

TEST_F(AsFoundFiles, MissingMaterialsAreWarnedOf) {
  expect_repair(kFolder / "mtl-missing.obj", 6, "not-there.mtl\" does not exist");
  expect_repair(kFolder / "usemtl-empty.obj", 6, "");
  expect_repair("a.obj", "usemtl red\n" + kBox, 6, "a.obj:1: unknown material \"red\": no mtllib");
  (void)file("m.mtl", "newmtl blue\nKd 0 0 1\nnewmtl blue\nKd 1 0 0\n");
  const auto path = file("b.obj", "mtllib m.mtl\n" + kBoxVertices + "usemtl red\n" + kBoxFaces +
                                      "usemtl blue\nf 1 4 8\n");
  expect_repair(path, 6 + std::sqrt(0.5), "m.mtl:3: material \"blue\" is already defined");
  const Scene scene = io::read_scene(path);
  EXPECT_CONTAINS(joined(scene.warnings), "b.obj:10: unknown material \"red\"");
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(scene.surfaces[0].name, "red");  // may still be asked for by that name
  EXPECT_EQ(scene.materials[scene.surfaces[1].material].reflectance, Eigen::Vector3d(0, 0, 1));
}

TEST_F(AsFoundFiles, MaterialsOfTheSceneNeedNoneOfTheMesh) {
  const Scene scene = io::read_scene(kFolder / "mtl-missing.json", {.strict = true});
  EXPECT_NEAR(area(scene), 6, 1e-12);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

TEST_F(AsFoundFiles, BadPolygonsAreLeftOutAndNamed) {
  expect_repair(kFolder / "duplicate-face.obj", 2, "1 polygon is the same as another one");
  expect_repair(kFolder / "zero-area.obj", 1, "1 polygon encloses no area");
  expect_repair("a.obj", kBox + "f 1 2 4 3\nf 3 1 2 4\nf 4 3 1 2\n", 6,
                "3 polygons are the same as others and are left out: surface 'a', polygon 6");
  expect_repair("a.obj", kBox + "f 1 2\nf 1\nf\nf 1 2 2\nf 1 1 1\n", 6,
                "5 polygons enclose no area and are left out: surface 'a', polygon 6; surface 'a', "
                "polygon 7; surface 'a', polygon 8; and 2 more");
  expect_repair("a.obj", kBox + "f 1 4 3 2\n", 6,
                "1 polygon has an outline that crosses or touches itself");
  expect_repair("a.obj", kBoxVertices + "f 1 2 4 4 3\n", 1, "1 polygon repeats a corner");
  // Left out by itself, though its outline is also that of another.
  expect_repair("a.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n2 0 1\n3 0 1 1\n", 1,
                "2 polygons enclose no area");
  expect_repair("a.json",
                R"({"bands": "grey", "materials": {"m": {"reflectance": 0.5}}, "surfaces": [
                {"name": "a", "material": "m", "polygons": [[[0, 0, 0], [1, 0, 0], [1, 1, 0]],
                                                            [[0, 0, 0], [1, 0, 0], [2, 0, 0]]]}]})",
                0.5, "1 polygon encloses no area and is left out: surface 'a', polygon 1");
}

TEST_F(AsFoundFiles, BackToBackPolygonsAreNoDuplicates) {
  const std::string walls = kBoxVertices + "f 1 2 4 3\nf 3 4 2 1\n";
  const Scene scene = io::read_scene(file("a.obj", walls), {.strict = true});
  EXPECT_NEAR(area(scene), 2, 1e-12);
}

TEST_F(AsFoundFiles, OfEqualPolygonsTheOneThatEmitsStays) {
  (void)file("m.mtl", "newmtl wall\nKd 1 1 1\nnewmtl lamp\nKd 1 1 1\nKe 1 1 1\n");
  const Scene scene = read("a.obj", "mtllib m.mtl\n" + kBoxVertices +
                                        "usemtl wall\nf 1 2 4 3\nusemtl lamp\nf 1 2 4 3\n");
  ASSERT_EQ(scene.n_polygons(), 1);
  EXPECT_EQ(scene.surfaces[scene.polygon_surface[0]].name, "lamp");
}

TEST_F(AsFoundFiles, NonManifoldEdgesAreKept) {
  expect_repair(
      "a.obj", kBox + "v 0 -1 0\nv 1 -1 0\nf 1 9 10 2\n", 7,
      "more than two polygons of one surface meet at 1 edge, and are kept: 3 at the edge");
}

TEST_F(AsFoundFiles, BytesAfterTheEndAreIgnored) {
  expect_repair(kFolder / "trailing-binary.stl", 6, "92 bytes after the last of 12 facets");
  expect_repair("a.ply", binary_ply(std::endian::little) + "abc", area(read("b.ply", kAsciiPly)),
                "3 bytes after the last element");
  expect_repair("a.ply", kAsciiPly + "abc\n\n", area(read("b.ply", kAsciiPly)), "1 more lines");
  std::string ply = kAsciiPly;
  ply.insert(ply.find("element"), "Created by a program that breaks comments\n");
  expect_repair("a.ply", ply, area(read("b.ply", kAsciiPly)), "unknown header keyword \"Created\"");
  (void)file("data.bin", gltf_buffer() + "more than the file says");
  EXPECT_EQ(read("a.gltf", gltf_json(R"("uri": "data.bin", )")).n_polygons(), 3);
  expect_repair("a.glb", glb() + "abcde", 2.5, "5 bytes after the end");
}

TEST_F(AsFoundFiles, GltfExtensions) {
  EXPECT_NEAR(area(io::read_scene(kFolder / "instancing.gltf", {.strict = true})), 3, 1e-6);
  EXPECT_NEAR(area(io::read_scene(kFolder / "quantized-i16.gltf", {.strict = true})), 4, 1e-6);
  const std::string error = error_of(kFolder / "unknown-required.gltf");
  EXPECT_CONTAINS(error, "requires the extension \"");
  const Scene scene = io::read_scene(kFolder / "emissive-unnamed.gltf");
  ASSERT_EQ(scene.surfaces.size(), 2U);
  const auto& lamp = scene.materials[scene.surfaces[0].material].emission;
  EXPECT_EQ(lamp.value, Eigen::Vector3d::Constant(10));
  EXPECT_EQ(scene.materials[scene.surfaces[1].material].emission.kind,
            radiosity::Emission::Kind::none);
}

TEST_F(AsFoundFiles, GltfIsBounded) {
  EXPECT_CONTAINS(error_of(kFolder / "shared-nodes-2-24.gltf"), "16777216 of meshes");
  EXPECT_CONTAINS(error_of("a.gltf", R"({"asset": {"version": "1.0"}, "buffers": {}})"),
                  "is glTF 1.0, expected 2.0");
  const std::string asset = R"({"asset": {"version": "2.0"}, )";
  EXPECT_CONTAINS(error_of("a.gltf", asset + R"("nodes": )" + std::string(400000, '[')),
                  "more than 500 lists and objects inside each other");
  EXPECT_CONTAINS(error_of("a.json", std::string(400000, '[')), "inside each other");
  EXPECT_CONTAINS(error_of("a.gltf", asset + R"("scenes": [{"nodes": [0]}],
      "nodes": [{"children": [1]}, {"children": [0]}]})"),
                  "its own descendants");

  // A gigabyte that the file only says to have allows no more triangles.
  std::string many = gltf_json(R"("uri": "data.bin", )");
  std::string instances = "[0";
  for (int k = 1; k < 1000; ++k) instances += ", 0";
  many.replace(many.find("[0, 1, 3]"), 9, instances + "]");
  std::string primitives = R"({"attributes": {"POSITION": 0}, "indices": 1, "material": 0})";
  std::string all;
  for (int k = 0; k < 1100; ++k) all += (k > 0 ? ", " : "") + primitives;
  const auto triangle = many.find("{\"attributes\"");
  many.replace(triangle, many.find("]}", triangle) - triangle, all);
  many.replace(many.find("\"byteLength\": 44"), 16, "\"byteLength\": 1000000000");
  EXPECT_CONTAINS(error_of("many.gltf", many),
                  "1100000 triangles in all, expected at most 1000000");

  std::string empty = "{\"attributes\": {}}";
  for (int k = 1; k < 2000; ++k) empty += ", {\"attributes\": {}}";
  EXPECT_CONTAINS(error_of("empty.gltf", asset + R"("scenes": [{"nodes": )" + instances +
                                             R"(]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [)" + empty + "]}]}"),
                  "2000000 instances of primitives");

  // A chain of nodes is no recursion: each moves its child by 1 mm.
  std::string chain;
  constexpr int kLinks = 60000;
  for (int k = 0; k < kLinks; ++k) {
    chain += R"({"translation": [0.001, 0, 0], "children": [)" + std::to_string(k + 1) + "]}, ";
  }
  std::string json = gltf_json(R"("uri": "data.bin", )");
  const auto nodes = json.find("\"nodes\": [{\"name\"");
  json.replace(nodes, json.find("\"meshes\"") - nodes,
               "\"nodes\": [" + chain + R"({"mesh": 0}], )");
  const auto roots = json.find("[0, 1, 3]");
  json.replace(roots, 9, "[0]");
  (void)file("data.bin", gltf_buffer());
  const Scene scene = read("a.gltf", json);
  ASSERT_EQ(scene.n_polygons(), 1);
  EXPECT_NEAR(scene.vertices[0].x(), 60, 1e-6);
}

/// A pipe would let reading wait for ever for somebody who writes to it.
TEST_F(AsFoundFiles, OnlyFilesAreOpened) {
  for (const char* name : {"a.obj", "a.ply", "a.stl", "a.off", "a.gltf", "a.glb", "a.json"}) {
    std::filesystem::remove(folder() / name);
    ASSERT_EQ(mkfifo((folder() / name).c_str(), 0600), 0);
    EXPECT_CONTAINS(error_of(folder() / name), "expected a file");
  }
  ASSERT_EQ(mkfifo((folder() / "pipe").c_str(), 0600), 0);
  EXPECT_CONTAINS(error_of("b.gltf", gltf_json(R"("uri": "pipe", )")), "expected a file");
  EXPECT_CONTAINS(error_of("b.gltf", gltf_json(R"("uri": "/dev/zero", )")), "expected a file");
  EXPECT_CONTAINS(error_of("b.gltf", gltf_json(R"("uri": ".", )")), "is a folder");
  EXPECT_CONTAINS(error_of("b.obj", "mtllib pipe\n" + kBox), "expected a file");
  std::string json = kJson;
  (void)file("square.off", kOff);
  json.replace(json.find("spectra.csv"), 11, "pipe");
  EXPECT_CONTAINS(error_of("b.json", json), "expected a file");
}

/// Looking at an outline takes the square of its corners.
TEST_F(AsFoundFiles, PolygonsOfCountlessCornersAreLeftOut) {
  std::string text = kBox;
  std::string face = "f";
  constexpr int kCorners = 45000;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * radiosity::kPi * k / kCorners;
    text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    face += " " + std::to_string(9 + k);
  }
  expect_repair("a.obj", text + face + "\n", 6,
                "1 polygon has more than 10000 corners and is left out: surface 'a', polygon 6");
}

/// A case of a file beside another with the marks of a text editor.
TEST_F(AsFoundFiles, MaterialFilesMayHaveAMark) {
  std::filesystem::copy_file(kFolder / "bom.mtl", folder() / "paint.mtl");
  std::filesystem::copy_file(kFolder / "bom-mtllib.obj", folder() / "a.obj");
  const Scene scene = io::read_scene(folder() / "a.obj", {.strict = true});
  EXPECT_NEAR(area(scene), 6, 1e-12);
  EXPECT_FALSE(scene.materials.empty());
}

/// Each of its words might begin the name of a picture, and all names that might are kept.
TEST_F(AsFoundFiles, ALineOfManyWordsIsNotMultiplied) {
  std::string line = "map_Kd";
  for (int k = 0; k < 100000; ++k) line += " x";
  (void)file("m.mtl", "newmtl red\nKd 1 0 0\n" + line + "\nmap_Ke -s 1 1 1 a b.png\n");
  const Scene scene = read("a.obj", "mtllib m.mtl\n" + kBox);
  std::size_t n_bytes = 0;
  for (const auto& path : scene.files) n_bytes += path.string().size();
  EXPECT_LT(n_bytes, 1'000'000U);
  EXPECT_NE(std::find(scene.files.begin(), scene.files.end(), folder() / "a b.png"),
            scene.files.end());
}

TEST_F(AsFoundFiles, LongTokensAreCut) {
  const std::string token(100000, 'x');
  EXPECT_LT(error_of("a.obj", "v " + token + " 0 0\n").size(), 300U);
  EXPECT_LT(error_of("a.json", "{\"" + token + "\": 1}").size(), 600U);
  EXPECT_LT(error_of("a.off", token).size(), 300U);
}

}  // namespace
