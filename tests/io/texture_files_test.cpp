// Textures of .mtl and glTF: which part of a picture a polygon has, and what pictures may be like.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "io/mesh/uri_text.h"
#include "io/picture/decode_picture.h"
#include "io/picture/image_file.h"
#include "io/picture/texture_pictures.h"
#include "io/scene/mitsuba_writer.h"
#include "io/scene/scene_writer.h"
#include "meshing/adaptive/adaptive.h"
#include "meshing/patches/patches.h"
#include "radiosity/scene/patch_texture.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/scene/scenario.h"
#include "tests/support/scratch_files.h"

namespace {

using Eigen::RowVector3d;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Scene;

/// Linear RGB of a byte of sRGB (IEC 61966-2-1).
double linear(int byte) {
  const double s = byte / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

std::string png(int width, int height, const std::vector<std::uint8_t>& bytes) {
  const auto file = io::encode_png("test.png", {width, height, bytes});
  return {file.begin(), file.end()};
}

/// Red, green, blue and white, from the top left.
const std::vector<std::uint8_t> kFour = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t word = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      word = word << 8U | (k + j < bytes.size() ? static_cast<std::uint8_t>(bytes[k + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += k + j <= bytes.size() ? kDigits[word >> (18 - 6 * j) & 63U] : '=';
    }
  }
  return text;
}

class TextureFiles : public ScratchFiles {
 protected:
  /// A square of 2 m, whose corners have the given lines `vt`; faces with the given corners.
  Scene square(const std::string& coordinates, const std::string& faces = "f 1/1 2/2 3/3 4/4\n",
               const std::string& material = "Kd 1 1 1\nmap_Kd four.png\n") {
    (void)file("four.png", png(2, 2, kFour));
    (void)file("a.mtl", "newmtl m\n" + material);
    return read("a.obj", "mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n" + coordinates +
                             "usemtl m\n" + faces);
  }
  static RowVector3d mean(const Scene& scene, const PatchMesh& mesh) {
    const Eigen::MatrixXd rho = reflectance(scene, mesh);
    RowVector3d sum = RowVector3d::Zero();
    double area = 0;
    for (Index i = 0; i < mesh.size(); ++i) {
      sum += mesh.area[i] * rho.row(i);
      area += mesh.area[i];
    }
    return sum / area;
  }
};

/// Of base64 text as a glTF file has it.
std::string decoded(const std::string& text) { return io::decode_base64(text).value(); }

/// 8 x 8 pixels of grey 188 as JPEG.
const std::string kGreyJpeg =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDg"
    "sLEBYQERMUFRUVDA8XGBYUGBIUFRT/wAALCAAIAAgBAREA/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8"
    "QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJico"
    "KSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqr"
    "KztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/9oACAEBAAA/APqCv//Z";

TEST(Pictures, AreReadWhateverTheirKind) {
  const auto pixel = [](const std::string& text) {
    const io::RgbPicture picture = io::decode_picture(decoded(text), 100);
    return std::vector<int>(picture.bytes.begin(), picture.bytes.begin() + 3);
  };
  // Grey of 188: of 8 bits with little opacity, of 16 bits, and 8 x 8 pixels of it as JPEG.
  const std::vector<int> grey(3, 188);
  EXPECT_EQ(pixel("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR4nGPYww4AAYIAxEKyfx8AAAAA"
                  "SUVORK5CYII="),
            grey);
  EXPECT_EQ(pixel("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAAAAABq7kcWAAAAC0lEQVR4nGPYswcAAjcBefQ+k5kAAAAA"
                  "SUVORK5CYII="),
            grey);
  const auto refusal = [](const std::string& file, std::size_t most = 100) {
    try {
      (void)io::decode_picture(file, most);
      return std::string();
    } catch (const radiosity::SceneError& error) {
      return std::string(error.what());
    }
  };
  if (refusal(decoded(kGreyJpeg)).find("without libjpeg") == std::string::npos) {
    for (const int value : pixel(kGreyJpeg)) EXPECT_NEAR(value, 188, 1);
    EXPECT_CONTAINS(refusal(decoded(kGreyJpeg).substr(0, 320)), "is a damaged JPEG");
    EXPECT_CONTAINS(refusal(decoded(kGreyJpeg).substr(0, 60)), "is a damaged JPEG");
    EXPECT_CONTAINS(refusal(decoded(kGreyJpeg), 10),
                    "has 8 x 8 pixels, more than the 10 that are read");
  }
  // 30,000 x 30,000 pixels in 74 bytes.
  EXPECT_CONTAINS(refusal(decoded("iVBORw0KGgoAAAANSUhEUgAAdTAAAHUwCAIAAADpRW/tAAAAEUlEQVR4nGNgGAWj"
                                  "YBQMdwAAA+gAAbOm00YAAAAASUVORK5CYII="),
                          io::TexturePictures::kMostTexels),
                  "has 30000 x 30000 pixels");
}

// Bytes changed, cut off and put in: a picture, or refused.
TEST(Pictures, SurviveAnyDamage) {
  std::mt19937_64 random(8);
  std::vector<std::uint8_t> noise(3 * 9 * 7);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random() % 256);
  const std::array files = {png(9, 7, noise), decoded(kGreyJpeg)};
  int n_read = 0;
  for (std::size_t k = 0; k < 400; ++k) {
    std::string file = files[k % 2];
    for (std::size_t change = 0; change < 1 + random() % 3; ++change) {
      const std::size_t place = random() % file.size();
      if (random() % 4 == 0) {
        file.resize(place + 1);
      } else {
        file[place] = static_cast<char>(random() % 256);
      }
    }
    try {
      const io::RgbPicture picture = io::decode_picture(file, 10'000);
      ++n_read;
      EXPECT_EQ(picture.bytes.size(), std::size_t{3} * picture.width * picture.height);
    } catch (const radiosity::SceneError& error) {
      EXPECT_NE(std::string(error.what()), "");
    }
  }
  EXPECT_GT(n_read, 0);
}

constexpr const char* kWhole = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

TEST_F(TextureFiles, GiveEachPatchItsPart) {
  const Scene scene = square(kWhole);
  EXPECT_TRUE(scene.warnings.empty());
  // Four patches: v runs upwards in an .obj, so the lower row of the picture lies at y < 1.
  const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 1.0});
  ASSERT_EQ(mesh.size(), 4);
  const Eigen::MatrixXd rho = reflectance(scene, mesh);
  for (Index i = 0; i < 4; ++i) {
    const bool is_right = mesh.centroid[i].x() > 1;
    const bool is_upper = mesh.centroid[i].y() > 1;
    const RowVector3d expected = is_upper
                                     ? (is_right ? RowVector3d(0, 1, 0) : RowVector3d(1, 0, 0))
                                     : (is_right ? RowVector3d(1, 1, 1) : RowVector3d(0, 0, 1));
    EXPECT_LT((rho.row(i) - expected).norm(), 1e-12);
  }
  EXPECT_TRUE(scene.materials[0].reflectance.isApprox(Eigen::Vector3d(0.5, 0.5, 0.5), 1e-12));
  EXPECT_TRUE(texture_deviation(scene, mesh).isZero(1e-7));
  // One patch of all four: each band is 1 on half of it.
  const PatchMesh one = meshing::make_patches(scene);
  EXPECT_NEAR(texture_deviation(scene, one)[0], 0.5, 1e-12);
}

TEST_F(TextureFiles, AreTheSameHoweverPatchesAreDivided) {
  // Turned by 30 degrees, shrunk, moved and beyond the picture; and a quad whose coordinates are
  // those of no parallelogram, which is two triangles.
  for (const char* coordinates : {"vt 0.1 -0.3\nvt 1.832 0.7\nvt 0.832 2.432\nvt -0.9 1.432\n",
                                  "vt 0 0\nvt 1.3 0.1\nvt 0.9 0.6\nvt 0.2 1.1\n", kWhole}) {
    for (const char* faces : {"f 1/1 2/2 3/3 4/4\n", "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"}) {
      const Scene scene = square(coordinates, faces);
      const RowVector3d expected = scene.materials[0].reflectance.transpose();
      for (const double edge : {2.9, 0.7, 0.31}) {
        const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = edge});
        EXPECT_LT((mean(scene, mesh) - expected).norm(), 1e-12) << coordinates << faces << edge;
      }
    }
    const Scene quad = square(coordinates);
    const Scene triangles = square(coordinates, "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    EXPECT_TRUE(quad.materials[0].reflectance.isApprox(triangles.materials[0].reflectance, 1e-12));
  }
}

TEST_F(TextureFiles, AreTimesKdScaledMovedAndWrapped) {
  const auto rho = [&](const std::string& material, const std::string& coordinates = kWhole) {
    return Eigen::VectorXd(
        square(coordinates, "f 1/1 2/2 3/3 4/4\n", material).materials[0].reflectance);
  };
  EXPECT_TRUE(rho("Kd 0.8 0.4 0\nmap_Kd four.png\n").isApprox(Eigen::Vector3d(0.4, 0.2, 0)));
  // No Kd: as it is. Options, of which a file's name with blanks is none.
  EXPECT_TRUE(rho("map_Kd -blendu on -mm 0 1 four.png\n").isApprox(Eigen::Vector3d(.5, .5, .5)));
  // The lower right quarter, of the picture's white texel.
  EXPECT_TRUE(rho("map_Kd -s .5 .5 1 -o .5 0 0 four.png\n").isApprox(Eigen::Vector3d(1, 1, 1)));
  // Far to the right of the picture: repeated or its last column, which is green and white.
  const char* right = "vt 1 0\nvt 4 0\nvt 4 1\nvt 1 1\n";
  EXPECT_TRUE(rho("map_Kd four.png\n", right).isApprox(Eigen::Vector3d(.5, .5, .5)));
  EXPECT_TRUE(rho("map_Kd -clamp on four.png\n", right).isApprox(Eigen::Vector3d(.5, 1, .5)));
  (void)file("a b.png", png(1, 1, {188, 0, 255}));
  EXPECT_TRUE(rho("map_Kd a b.png\n").isApprox(Eigen::Vector3d(linear(188), 0, 1)));
}

// Saved scenes and Mitsuba's have the mean of each material.
TEST_F(TextureFiles, AreMeansInOtherFiles) {
  const Scene scene = square(kWhole, "f 1/1 2/2 3/3 4/4\n", "Kd .8 .4 .2\nmap_Kd four.png\n");
  const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 1.0});
  io::write_scene(folder() / "saved.json", scene);
  const Scene saved = io::read_scene(folder() / "saved.json");
  EXPECT_TRUE(saved.materials[0].reflectance.isApprox(Eigen::Vector3d(.4, .2, .1), 1e-12));
  EXPECT_FALSE(saved.materials[0].texture);
  io::write_mitsuba(folder() / "m.xml", scene, mesh, {.position = {1, 1, 5}});
  std::ifstream stream(folder() / "m.xml");
  const std::string xml(std::istreambuf_iterator<char>(stream), {});
  const std::size_t place = xml.find("name=\"reflectance\" value=\"");
  ASSERT_NE(place, std::string::npos) << xml;
  EXPECT_NEAR(std::stod(xml.substr(place + 26)), 0.4, 1e-6);
}

TEST_F(TextureFiles, ArePaintedOverByScenarios) {
  const Scene scene = square(kWhole);
  const Scene painted = scene_of(scene, {"paint", {}, {{"m", Eigen::VectorXd::Constant(1, 0.3)}}});
  const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 1.0});
  EXPECT_TRUE(reflectance(painted, mesh).isConstant(0.3));
}

TEST_F(TextureFiles, AreFollowedByAdaptivePatches) {
  const Scene lit = square("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.3 0.3\nvt 3 1\n",
                           "f 1/1 2/2 3/3 4/4\nusemtl lamp\nv 0 0 2\nv 0 2 2\nv 2 2 2\nv 2 0 2\n"
                           "f 5 6 7 8\n",
                           "map_Kd -s 3 3 1 four.png\nnewmtl lamp\nKd .5 .5 .5\nKe 1 1 1\n");
  const meshing::AdaptiveMesh made =
      meshing::make_adaptive_patches(lit, {.tolerance = 0.05, .max_patches = 2000});
  const Eigen::VectorXd deviation = texture_deviation(lit, made.mesh);
  double square_sum = 0;
  for (Index i = 0; i < made.mesh.size(); ++i) {
    square_sum += made.mesh.area[i] * deviation[i] * deviation[i];
  }
  // 0.5 in one patch. The picture's edges lie at sixths of the side, where patches are halved: what
  // is left is in the strips of patches that they cross.
  EXPECT_LT(std::sqrt(square_sum / 4), 0.2);
}

TEST_F(TextureFiles, TellWhatIsMissing) {
  const auto warning = [&](const Scene& scene) {
    return scene.warnings.empty() ? "" : scene.warnings.front();
  };
  const Scene absent = square(kWhole, "f 1/1 2/2 3/3 4/4\n", "Kd .3 .3 .3\nmap_Kd none.png\n");
  EXPECT_CONTAINS(warning(absent), "a.mtl: material \"m\": picture \"none.png\" does not exist");
  EXPECT_EQ(absent.materials[0].reflectance[0], 0.3);
  EXPECT_CONTAINS(error_of(folder() / "a.obj", {.strict = true}), "refused, for reading is strict");
  (void)file("cut.png", png(2, 2, kFour).substr(0, 50));
  EXPECT_CONTAINS(warning(square(kWhole, "f 1/1 2/2 3/3 4/4\n", "Kd .3 .3 .3\nmap_Kd cut.png\n")),
                  "cut.png: is a damaged PNG");
  (void)file("text.png", "no picture");
  EXPECT_CONTAINS(warning(square(kWhole, "f 1/1 2/2 3/3 4/4\n", "Kd .3 .3 .3\nmap_Kd text.png\n")),
                  "text.png: is neither PNG nor JPEG");
  // Without coordinates, with such as are not there, no numbers, or too wide: the picture's mean.
  for (const char* faces : {"f 1 2 3 4\n", "f 1/7 2/8 3/9 4/1\n", "f 1//1 2//1 3//1 4//1\n"}) {
    const Scene scene = square(kWhole, faces);
    EXPECT_CONTAINS(warning(scene), "polygon 0, of material \"m\", has no texture coordinates");
    EXPECT_TRUE(scene.materials[0].reflectance.isApprox(Eigen::Vector3d(.5, .5, .5)));
  }
  EXPECT_CONTAINS(warning(square("vt nan 0\nvt x 0\nvt 1 1\nvt 0 1\n")), "has no texture coord");
  EXPECT_CONTAINS(warning(square("vt 0 0\nvt 1e9 0\nvt 1 1\nvt 0 1\n")), "over 4e+09 texels");
  EXPECT_CONTAINS(warning(square(kWhole, "f 1/1 2/2 3/3 4/4\n", "map_Kd -mm .5 .5 four.png\n")),
                  "options of map_Kd");
}

TEST_F(TextureFiles, OfMeshesInScenesStayWithTheirPolygons) {
  (void)square(kWhole);
  // Beside polygons without coordinates before and behind; mirrored, the left is the right.
  const Scene scene = read("s.json", R"({"materials": {"white": {"reflectance": 0.8}}, "surfaces": [
    {"name": "a", "material": "white", "polygons": [[[5,0,0],[6,0,0],[6,1,0]]]},
    {"name": "b", "mesh": "a.obj", "transform": {"scale": [-1, 1, 1]}},
    {"name": "c", "material": "white", "polygons": [[[7,0,0],[8,0,0],[8,1,0]]]}]})");
  const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 1.0});
  const Eigen::MatrixXd rho = reflectance(scene, mesh);
  int n_red = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] != 1) {
      EXPECT_TRUE(rho.row(i).isConstant(0.8));
    } else if ((rho.row(i) - RowVector3d(1, 0, 0)).norm() < 1e-9) {
      ++n_red;
      EXPECT_GT(mesh.centroid[i].x(), -1);  // upper left before, upper right now
      EXPECT_GT(mesh.centroid[i].y(), 1);
    }
  }
  EXPECT_EQ(n_red, 1);
}

/// A square with one material, whose texture has what is given.
nlohmann::json gltf_square(const std::string& picture) {
  std::string binary;
  for (const float x : {0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 2.F, 2.F, 0.F, 0.F, 2.F, 0.F})
    binary += bytes(x);
  for (const float u : {0.F, 1.F, 1.F, 1.F, 1.F, 0.F, 0.F, 0.F}) binary += bytes(u);  // v runs down
  for (const int i : {0, 1, 2, 0, 2, 3}) binary += static_cast<char>(i);
  binary += "..";
  const std::size_t n = binary.size();
  binary += picture;
  const auto view = [](std::size_t offset, std::size_t length) {
    return nlohmann::json{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
  };
  return {{"asset", {{"version", "2.0"}}},
          {"buffers",
           {{{"byteLength", binary.size()},
             {"uri", "data:application/octet-stream;base64," + base64(binary)}}}},
          {"bufferViews", {view(0, 48), view(48, 32), view(80, 6), view(n, picture.size())}},
          {"accessors",
           {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
            {{"bufferView", 1}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
            {{"bufferView", 2}, {"componentType", 5121}, {"count", 6}, {"type", "SCALAR"}}}},
          {"images", {{{"bufferView", 3}, {"mimeType", "image/png"}}}},
          {"samplers", {{{"wrapS", 10497}}}},
          {"textures", {{{"source", 0}, {"sampler", 0}}}},
          {"materials", {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}}},
          {"meshes",
           {{{"primitives",
              {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}},
                {"indices", 2},
                {"material", 0}}}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"scenes", {{{"nodes", {0}}}}},
          {"scene", 0}};
}

TEST_F(TextureFiles, OfGltfStandAnywhere) {
  const std::string picture = png(2, 2, kFour);
  const auto rho = [&](const nlohmann::json& json) {
    const Scene scene = read("a.gltf", json.dump());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 1.0});
    const Eigen::MatrixXd all = reflectance(scene, mesh);
    // What lies at the lower left.
    RowVector3d sum = RowVector3d::Zero();
    double area = 0;
    for (Index i = 0; i < mesh.size(); ++i) {
      if (mesh.centroid[i].x() > 1 || mesh.centroid[i].y() > 1) continue;
      sum += mesh.area[i] * all.row(i);
      area += mesh.area[i];
    }
    return RowVector3d(sum / area);
  };
  nlohmann::json json = gltf_square(picture);
  EXPECT_LT((rho(json) - RowVector3d(0, 0, 1)).norm(), 1e-9);
  json["images"][0] = {{"uri", "data:image/png;base64," + base64(picture)}};
  EXPECT_LT((rho(json) - RowVector3d(0, 0, 1)).norm(), 1e-9);
  (void)file("four colours.png", picture);
  json["images"][0] = {{"uri", "four%20colours.png"}};
  EXPECT_LT((rho(json) - RowVector3d(0, 0, 1)).norm(), 1e-9);
  nlohmann::json& pbr = json["materials"][0]["pbrMetallicRoughness"];
  pbr["baseColorFactor"] = {1, 1, 0.5, 1};
  EXPECT_LT((rho(json) - RowVector3d(0, 0, 0.5)).norm(), 1e-9);
  pbr.erase("baseColorFactor");
  // The example of KHR_texture_transform: the lower left quarter, turned.
  nlohmann::json& moved = pbr["baseColorTexture"]["extensions"]["KHR_texture_transform"];
  moved = {{"offset", {0, 1}}, {"rotation", radiosity::kPi / 2}, {"scale", {0.5, 0.5}}};
  EXPECT_LT((rho(json) - RowVector3d(0, 0, 1)).norm(), 1e-6);
  // One picture to the right: repeated, its last column, mirrored.
  moved = {{"offset", {1, 0}}};
  EXPECT_LT((rho(json) - RowVector3d(0, 0, 1)).norm(), 1e-9);
  json["samplers"][0]["wrapS"] = 33071;
  EXPECT_LT((rho(json) - RowVector3d(1, 1, 1)).norm(), 1e-9);
  json["samplers"][0]["wrapS"] = 33648;
  EXPECT_LT((rho(json) - RowVector3d(1, 1, 1)).norm(), 1e-9);
}

TEST_F(TextureFiles, OfGltfThatCannotBeReadAreToldOf) {
  const auto warned = [&](const auto& change) {
    nlohmann::json json = gltf_square(png(2, 2, kFour));
    change(json);
    const Scene scene = read("a.gltf", json.dump());
    EXPECT_EQ(scene.materials[0].reflectance[0], 1);
    return scene.warnings.empty() ? std::string() : scene.warnings.front();
  };
  EXPECT_CONTAINS(warned([](auto& j) { j["images"][0] = {{"uri", "none.png"}}; }), "none.png");
  EXPECT_CONTAINS(warned([](auto& j) { j["images"][0]["bufferView"] = 0; }),
                  "images[0]: is neither PNG nor JPEG");
  EXPECT_CONTAINS(warned([](auto& j) { j["samplers"][0]["wrapS"] = 7; }), "is none of 10497");
  EXPECT_CONTAINS(warned([](auto& j) { j["textures"][0]["source"] = 9; }),
                  "but there are 1 images");
  EXPECT_CONTAINS(warned([](auto& j) { j["textures"][0].erase("source"); }), "source");
}

}  // namespace
