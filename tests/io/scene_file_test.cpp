#include "io/scene/scene_file.h"

#include <cmath>

#include "tests/support/sample_files.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::Bands;
using radiosity::Emission;
using radiosity::Index;
using radiosity::Scene;
using radiosity::Vec3;

/// The double next to sin 60° in decimal: single precision would change its digits.
constexpr double kSin60 = 0.8660254037844386;

std::vector<Vec3> polygon(const Scene& scene, Index i) {
  std::vector<Vec3> points;
  for (const auto index : scene.polygon(i)) points.push_back(scene.vertices[index]);
  return points;
}

/// The square and the triangle that the samples of OBJ, OFF and PLY all hold.
void expect_sample(const Scene& scene) {
  ASSERT_EQ(scene.n_polygons(), 2);
  EXPECT_EQ(scene.vertices.size(), 4U);
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, kSin60, 0}};
  EXPECT_EQ(polygon(scene, 0), square);
  EXPECT_EQ(polygon(scene, 1), std::vector(square.begin(), square.begin() + 3));
}

class SceneFile : public ScratchFiles {};

TEST_F(SceneFile, ReadsObjWithMaterials) {
  (void)file("materials.mtl", kMtl);
  const Scene scene = read("room.obj", kObj);
  expect_sample(scene);
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(scene.surfaces[0].name, "square");
  EXPECT_EQ(scene.surfaces[1].name, "lamp");
  EXPECT_EQ(scene.bands.kind, Bands::Kind::rgb);
  const auto& white = scene.materials[scene.surfaces[0].material];
  EXPECT_EQ(white.reflectance, Eigen::Vector3d(0.7, 0.6, 0.5));
  EXPECT_EQ(white.emission.kind, Emission::Kind::none);
  const auto& lamp = scene.materials[scene.surfaces[1].material];
  EXPECT_EQ(lamp.reflectance, Eigen::Vector3d::Constant(0.25));
  EXPECT_EQ(lamp.emission.kind, Emission::Kind::radiance);
  EXPECT_EQ(lamp.emission.value, Eigen::Vector3d(3, 2, 1));
  ASSERT_EQ(scene.warnings.size(), 1U);  // of the one thing that is missing
  EXPECT_CONTAINS(scene.warnings[0], "picture \"wood.png\" does not exist");
}

TEST_F(SceneFile, ReadsOffAndPly) {
  for (const Scene& scene : {read("a.off", kOff), read("a.ply", kAsciiPly),
                             read("b.PLY", binary_ply(std::endian::little)),
                             read("c.ply", binary_ply(std::endian::big))}) {
    SCOPED_TRACE(scene.source);
    expect_sample(scene);
    EXPECT_EQ(scene.surfaces.size(), 1U);
    EXPECT_EQ(scene.bands.kind, Bands::Kind::grey);
    EXPECT_EQ(scene.materials.front().reflectance, Eigen::VectorXd::Constant(1, 0.5));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_CONTAINS(scene.warnings.front(), "no material; its reflectance is 0.5");
  }
  EXPECT_EQ(read("stem.off", kOff).surfaces.front().name, "stem");
  const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(read("a.off", "OFF 3 1 0\n" + triangle).n_polygons(), 1);
  EXPECT_EQ(read("a.off", "# no header\n3 1\n" + triangle).n_polygons(), 1);
}

TEST_F(SceneFile, ReadsStlAndMergesVertices) {
  const Scene ascii = read("a.stl", kAsciiStl);
  ASSERT_EQ(ascii.n_polygons(), 3);
  EXPECT_EQ(ascii.vertices.size(), 5U);  // of 9; -0 is 0
  EXPECT_EQ(polygon(ascii, 0)[2], Vec3(1, kSin60, 0));
  ASSERT_EQ(ascii.surfaces.size(), 2U);
  EXPECT_EQ(ascii.surfaces[0].name, "left wall");
  EXPECT_EQ(ascii.surfaces[1].name, "right");
  EXPECT_EQ(ascii.polygon_surface, (std::vector<std::int32_t>{0, 0, 1}));

  const Scene binary = read("b.stl", binary_stl());
  ASSERT_EQ(binary.n_polygons(), 2);
  EXPECT_EQ(binary.vertices.size(), 4U);
  EXPECT_EQ(polygon(binary, 1), (std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(binary.surfaces.front().name, "b");
}

TEST_F(SceneFile, MergesManyVertices) {
  // 40 x 40 squares of two triangles: 41 x 41 vertices, enough to grow the table of vertices.
  std::string text = "solid grid\n";
  const auto vertex = [&](int x, int y) {
    text += "vertex " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
  };
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 40; ++y) {
      for (const int dx : {0, 1}) {
        text += "facet normal 0 0 1\nouter loop\n";
        vertex(x, y);
        vertex(x + 1, y + dx);
        vertex(x + 1 - dx, y + 1);
        text += "endloop\nendfacet\n";
      }
    }
  }
  const Scene scene = read("grid.stl", text + "endsolid grid\n");
  EXPECT_EQ(scene.n_polygons(), 3200);
  EXPECT_EQ(scene.vertices.size(), 41U * 41U);
  EXPECT_EQ(polygon(scene, 3199)[1], Vec3(40, 40, 0));
}

void expect_gltf(const Scene& scene) {
  ASSERT_EQ(scene.n_polygons(), 3);
  EXPECT_EQ(polygon(scene, 0), (std::vector<Vec3>{{10, 0, 0}, {11, 0, 0}, {10, 1, 0}}));
  // Mirrored in x, the triangle still faces +z: its corners turn the other way round.
  EXPECT_EQ(polygon(scene, 1), (std::vector<Vec3>{{0, 1, 0}, {-1, 0, 0}, {0, 0, 0}}));
  ASSERT_EQ(scene.surfaces.size(), 3U);
  EXPECT_EQ(scene.surfaces[0].name, "moved");
  EXPECT_EQ(scene.surfaces[1].name, "mirrored");
  EXPECT_EQ(scene.surfaces[2].name, "moved-2");
  EXPECT_TRUE(scene.surfaces[0].two_sided);
  EXPECT_FALSE(scene.surfaces[2].two_sided);
  const auto& glow = scene.materials[scene.surfaces[0].material];
  EXPECT_EQ(glow.reflectance, Eigen::Vector3d(0.5, 0.25, 0.75));
  EXPECT_EQ(glow.emission.value, Eigen::Vector3d(8, 4, 2));
  const auto& plain = scene.materials[scene.surfaces[2].material];
  EXPECT_EQ(plain.reflectance, Eigen::Vector3d::Constant(0.5));
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_CONTAINS(scene.warnings.front(), "surface moved-2 has no material");
}

TEST_F(SceneFile, ReadsGltf) {
  (void)file("data.bin", gltf_buffer());
  expect_gltf(read("a.gltf", gltf_json(R"("uri": "data.bin", )")));
  expect_gltf(read("a.glb", glb()));
  EXPECT_CONTAINS(error_of("b.gltf", gltf_json(R"("uri": "gone.bin", )")), "b.gltf: ");
  EXPECT_CONTAINS(error_of("c.glb", "no glTF"), "c.glb: ");
}

TEST_F(SceneFile, SurfaceIsObjectAndMaterial) {
  (void)file("materials.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const std::string start = "mtllib materials.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const Scene objects = read("a.obj", start +
                                          "o wall\nusemtl red\nf 1 2 3\no light\nf 1 2 4\n"
                                          "o wall\nusemtl red\ng ignored\nf 3 2 1\n"
                                          "usemtl blue\nf 1 3 4\n");
  ASSERT_EQ(objects.surfaces.size(), 3U);
  EXPECT_EQ(objects.surfaces[0].name, "wall");
  EXPECT_EQ(objects.surfaces[1].name, "light");
  EXPECT_EQ(objects.surfaces[2].name, "wall:blue");
  EXPECT_EQ(objects.polygon_surface, (std::vector<std::int32_t>{0, 1, 0, 2}));
  EXPECT_EQ(polygon(objects, 2)[0], Vec3(0, 1, 0));

  const Scene groups = read("b.obj", start + "g one two\nf 1 2 3\ng three\nf 1 2 4\n");
  EXPECT_EQ(groups.surfaces[0].name, "one two");
  EXPECT_EQ(groups.surfaces[1].name, "three");
  const Scene materials = read("c.obj", start + "f 1 2 3\nusemtl blue\nf 1 2 4\n");
  EXPECT_EQ(materials.surfaces[0].name, "c");
  EXPECT_EQ(materials.surfaces[1].name, "blue");
}

TEST_F(SceneFile, KeepsCornellBoxInFileOrder) {
  const auto path = std::filesystem::path(RADIOSITY_TEST_DATA) / "cornell-box/patches-8x8.obj";
  const Scene scene = io::read_scene(path, {.unit = "mm", .progress = {}});
  EXPECT_EQ(scene.n_polygons(), 480);
  std::vector<std::string> names;
  for (const auto& surface : scene.surfaces) names.push_back(surface.name);
  EXPECT_EQ(names.size(), 16U);
  EXPECT_EQ(std::count(names.begin(), names.end(), "ceiling"), 1);
  // The light lies between parts of the ceiling; both are met again.
  const auto ceiling = std::find(names.begin(), names.end(), "ceiling") - names.begin();
  const auto light = std::find(names.begin(), names.end(), "light") - names.begin();
  std::vector<Index> starts;
  for (Index i = 1; i < scene.n_polygons(); ++i) {
    if (scene.polygon_surface[i] != scene.polygon_surface[i - 1]) starts.push_back(i);
  }
  EXPECT_EQ(starts.size(), 18U);
  EXPECT_EQ(scene.polygon_surface[starts[3]], ceiling);
  EXPECT_EQ(scene.polygon_surface[starts[4]], light);
  EXPECT_EQ(scene.polygon_surface[starts[5]], ceiling);
  EXPECT_DOUBLE_EQ(polygon(scene, 0)[2].x(), 0.48335);
}

TEST_F(SceneFile, KeepsConcavePolygons) {
  const Scene scene = read("l.obj",
                           "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n"
                           "f 1 2 3 4 5 6\nf 1 2 3 3\n");
  EXPECT_EQ(scene.polygon(0).size(), 6U);
  EXPECT_EQ(scene.polygon(1).size(), 4U);  // a repeated vertex is for meshing to judge
}

TEST_F(SceneFile, ConvertsUnits) {
  for (const auto& [unit, metres] : {std::pair("mm", 1e-3),
                                     {"cm", 1e-2},
                                     {"in", 0.0254},
                                     {"ft", 0.3048},
                                     {"km", 1e3},
                                     {"um", 1e-6},
                                     {"m", 1.0}}) {
    const Scene scene = io::read_scene(file("a.off", kOff), {.unit = unit, .progress = {}});
    EXPECT_EQ(scene.vertices[3].y(), kSin60 * metres) << unit;
  }
  EXPECT_CONTAINS(error_of(file("a.off", kOff), {.unit = "yd", .progress = {}}),
                  "unknown unit \"yd\", expected one of m, mm, cm");
}

TEST_F(SceneFile, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 70000; ++i) text += "f 1 2 3\n";
  const io::ReadOptions options{.unit = {}, .progress = {.report = {}, .stop = stop.get_token()}};
  EXPECT_THROW((void)io::read_scene(file("a.obj", text), options), radiosity::Interrupted);
}

struct BadFile {
  const char* name;
  std::string content;
  const char* message;
};

TEST_F(SceneFile, ExplainsBadObj) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  (void)file("m.mtl", "newmtl red\nKd 1 0 0\n");
  (void)file("bad.mtl", "newmtl red\nKd 1.2 0 0\n");
  (void)file("dark.mtl", "newmtl red\nKd 1 0 0\nKe 1 -1 0\n");
  const std::vector<BadFile> bad = {
      {"a.obj", points + "f 1 2 97\n", "a.obj:4: face uses vertex 97, but the file has 3"},
      {"a.obj", points + "f 1 2 99999999999\n", "vertex 99999999999, but the file has 3"},
      {"a.obj", points + "f 1 2 0\n", "a.obj:4: face uses vertex 0"},
      {"a.obj", points + "f 1 2 -4\n", "vertex -4, but only 3 precede it"},
      {"a.obj", points + "f 1 2\n", "a.obj: 1 polygon encloses no area"},
      {"a.obj", points + "f 1 2 x\n", "expected a vertex number, found \"x\""},
      {"a.obj", "v 0 nan 0\n", "a.obj:1: coordinate y is not finite: \"nan\""},
      {"a.obj", "v 0 0 -inf\n", "coordinate z is not finite: \"-inf\""},
      {"a.obj", "v 0 0\n", "a.obj:1: line ends where coordinate z is expected"},
      {"a.obj", "v 0 0 0,5\n", "expected a number for coordinate z, found \"0,5\""},
      {"a.obj", "mtllib bad.mtl\n", "bad.mtl:2: reflectance 1.2 is outside [0, 1]"},
      {"a.obj", "mtllib dark.mtl\n", "dark.mtl:3: radiance Ke is -1, expected"},
      {"a.obj", points, "a.obj: has no polygons"},
      {"a.obj", "", "a.obj: is empty"},
      {"a.xyz", points, "a.xyz: unknown extension \".xyz\", expected .obj, .off, .ply"},
  };
  for (const auto& [name, content, message] : bad)
    EXPECT_CONTAINS(error_of(name, content), message);
  EXPECT_CONTAINS(error_of(folder() / "gone.obj"), "gone.obj: no such file");
  std::filesystem::create_directory(folder() / "folder.obj");
  EXPECT_CONTAINS(error_of(folder() / "folder.obj"), "folder.obj: is a folder");
}

TEST_F(SceneFile, ExplainsBadOffAndStl) {
  const std::string facet = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  std::string not_finite = binary_stl();
  not_finite.replace(84 + 50 + 12, 4, bytes(std::nanf("")));
  const std::vector<BadFile> bad = {
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
       "a.off:6: face uses vertex 3, but there are 3"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "file ends after 2 of 3 vertices"},
      {"a.off", "OFF\n2000000000000 1 0\n0 0 0\n", "file ends after 1 of 2000000000000 vertices"},
      {"a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "file ends after 1 of 2 faces"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "1 polygon encloses no area"},
      {"a.off", "OFF\n-3 1 0\n", "a.off:2: found -3 vertices"},
      {"a.off", "4OFF\n3 1 0\n", "a.off:1: expected \"OFF\", found a word of 4 bytes"},
      {"a.off", "OFF\n0 0 0\n", "a.off: has no polygons"},
      {"a.stl", binary_stl().substr(0, 150), "is truncated: found 150 bytes, expected 184"},
      {"a.stl", "no stl", "found 6 bytes, expected \"solid\""},
      {"a.stl", not_finite, "triangle 1: coordinate is not finite"},
      {"a.stl", facet + "endloop\n", "a.stl:6: expected \"vertex\", found \"endloop\""},
      {"a.stl", facet, "file ends before \"vertex\""},
      {"a.stl", "solid\nendsolid\n", "a.stl: has no polygons"},
  };
  for (const auto& [name, content, message] : bad)
    EXPECT_CONTAINS(error_of(name, content), message);
}

// A scene may name any file that the user may read; what is told of it must not give it away.
TEST_F(SceneFile, MessagesDoNotRepeatFilesThatAreNoScene) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  (void)file("a.obj", square);
  for (const std::string secret :
       {"root:S3CRET$6$:19000:0:99999:7:::\n", "S3CRET\n", "12 S3CRET\n", "\"S3CRET\"\n",
        "S3CRET,1\n2,3\n", "[\"S3CRET\"]\n", "S3CRET = {\n"}) {
    std::vector<std::filesystem::path> scenes;
    for (const char* extension : {"obj", "ply", "stl", "off", "gltf", "glb", "json"}) {
      scenes.push_back(file(std::string("secret.") + extension, secret));
    }
    (void)file("passwd", secret);
    scenes.push_back(file("m.obj", "mtllib passwd\n" + square));
    scenes.push_back(file("s.json", R"({"bands": [450], "materials": {"m": {"reflectance":
          {"csv": "passwd", "column": "a"}}}, "surfaces": [{"name": "s", "mesh": "a.obj",
          "material": "m"}]})"));
    for (const auto& path : scenes) {
      std::string told = path.string();
      try {
        for (const std::string& warning : io::read_scene(path).warnings) told += warning;
      } catch (const radiosity::SceneError& error) {
        told += error.what();
      }
      EXPECT_EQ(told.find("S3CRET"), std::string::npos) << told;
      EXPECT_LT(told.size(), 600U);
    }
  }
}

TEST_F(SceneFile, ExplainsBadPly) {
  const auto ply = [](const std::string& format, const std::string& vertex,
                      const std::string& face) {
    return "ply\nformat " + format + " 1.0\nelement vertex 3\n" + vertex +
           "property float y\nproperty float z\nelement face " + face + "end_header\n";
  };
  const std::string x = "property float x\n";
  const std::string face = "1\nproperty list uchar int vertex_index\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string binary = ply("binary_little_endian", x, face);
  std::string triangle;
  for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) triangle += bytes(value);
  const std::string count = bytes<std::uint8_t>(3);
  const std::vector<BadFile> bad = {
      {"a.ply", ply("ascii", x, face) + points + "3 0 1 7\n",
       "a.ply:13: face uses vertex 7, but there are 3"},
      {"a.ply", ply("ascii", x, face) + points + "2 0 1      \n", "1 polygon encloses no area"},
      {"a.ply", ply("ascii", x, face) + "0 0 0\n1 0 0\n0 1.0000000000000 0\n",
       "file ends after 0 of 1 elements \"face\""},
      {"a.ply", ply("ascii", x, face) + "0 0 inf\n" + points,
       "a.ply:10: a coordinate is not finite"},
      {"a.ply", ply("ascii", "", face) + points, "vertices need one x, one y and one z"},
      {"a.ply", ply("ascii", x, "1\nproperty list uchar float vertex_index\n") + points,
       "\"vertex_index\" must have an integer type"},
      {"a.ply", ply("ebcdic", x, face), "a.ply:2: unknown format \"ebcdic\""},
      {"a.ply", binary + triangle.substr(4), "is truncated: found"},
      {"a.ply", binary + triangle + count + bytes(0) + bytes(1), "is truncated: found"},
      {"a.ply", binary + triangle + count + bytes(0) + bytes(1) + bytes(3),
       "a.ply: face 0: face uses vertex 3"},
      {"a.ply",
       ply("binary_little_endian", x, "4000000000\nproperty list int int vertex_index\n") +
           triangle,
       "is truncated: found"},
      {"a.ply", "ply\nformat ascii 1.0\n", "file ends before \"end_header\""},
      {"a.ply", "polygons\n", "a.ply:1: expected \"ply\" on the first line"},
      {"a.ply", ply("ascii", x, "0\nproperty list uchar int vertex_index\n") + points,
       "a.ply: has no polygons"},
  };
  for (const auto& [name, content, message] : bad)
    EXPECT_CONTAINS(error_of(name, content), message);
}

/// Cut off after any byte, a file is either read or refused with a SceneError.
TEST_F(SceneFile, SurvivesTruncationAtEveryByte) {
  (void)file("materials.mtl", kMtl);
  (void)file("data.bin", gltf_buffer());
  (void)file("square.off", kOff);
  (void)file("spectra.csv", kCsv);
  const std::vector<std::pair<std::string, std::string>> samples = {
      {"cut.obj", kObj},
      {"cut.off", kOff},
      {"cut.stl", kAsciiStl},
      {"cut.stl", binary_stl()},
      {"cut.ply", kAsciiPly},
      {"cut.ply", binary_ply(std::endian::little)},
      {"cut.ply", binary_ply(std::endian::big)},
      {"cut.gltf", gltf_json(R"("uri": "data.bin", )")},
      {"cut.glb", glb()},
      {"cut.json", kJson},
  };
  for (const auto& [name, content] : samples) {
    EXPECT_EQ(error_of(name, content), "");
    for (std::size_t n = 0; n < content.size(); ++n) {
      const std::string error = error_of(name, content.substr(0, n));
      if (!error.empty()) EXPECT_CONTAINS(error, "cut.");
    }
  }
  const auto obj = file("whole.obj", kObj);
  const auto json = file("whole.json", kJson);
  for (std::size_t n = 0; n < kMtl.size(); ++n) {
    (void)file("materials.mtl", kMtl.substr(0, n));
    (void)error_of(obj);
  }
  for (std::size_t n = 0; n < kCsv.size(); ++n) {
    (void)file("spectra.csv", kCsv.substr(0, n));
    (void)error_of(json);
  }
}

}  // namespace
