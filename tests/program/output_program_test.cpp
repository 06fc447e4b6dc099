// What the program writes to files and to the terminal, whatever it is given.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;

constexpr const char* kTriangle =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "images": [{"uri": "my%20wood.png"}],
  "buffers": [{"uri": "triangle.bin", "byteLength": 36}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                 "min": [0, 0, 0], "max": [1, 1, 0]}]})";

/// Scenes, and files that they refer to, directly or by way of others.
class Outputs : public Program {
 protected:
  Outputs() {
    write_file("my wood.png", "a picture");
    write_file("a.mtl", "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd -s 1 1 1 my wood.png\n");
    write_file("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3 4\n");
    write_file("a.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    write_file("a.csv", "wavelength_nm,a\n400,0.5\n700,0.5\n");
    write_file("a.gltf", kTriangle);
    const float numbers[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    write_file("triangle.bin", std::string(reinterpret_cast<const char*>(numbers), 36));
    write_file("scene.json", scene("a.obj", "a.csv"));
  }

  static std::string scene(const std::string& mesh, const std::string& spectrum) {
    return R"({"bands": [450, 550], "materials": {"m": {"reflectance": {"csv": ")" + spectrum +
           R"(", "column": "a"}, "exitance": 1}},
      "surfaces": [{"name": "s", "mesh": ")" +
           mesh + R"(", "material": "m"}],
      "camera": {"position": [0.5, 0.5, 3], "direction": [0, 0, -1]}})";
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder() / name).string();
  }
  /// A name that the program takes for an output, in another folder, of a file.
  [[nodiscard]] std::string link_to(const std::string& name, bool is_hard) const {
    const fs::path link = folder() / "printed" / ((is_hard ? "hard-" : "soft-") + name + ".csv");
    if (is_hard) {
      fs::create_hard_link(folder() / name, link);
    } else {
      fs::create_symlink(folder() / name, link);
    }
    return link.string();
  }
};

TEST_F(Outputs, OverwriteNothingThatTheSceneRefersTo) {
  const auto expect_kept = [&](const std::string& scene, const std::string& file,
                               const std::string& output) {
    const std::string before = contents(folder() / file);
    ASSERT_FALSE(before.empty()) << file;
    SCOPED_TRACE(scene + " -o " + output);
    const Outcome outcome = run({"solve", path(scene), "-o", output, "--quiet"});
    expect_error(outcome, 1, "cannot be written: it is");
    EXPECT_EQ(contents(folder() / file), before);
  };
  for (const auto& [scene, file] :
       std::vector<std::pair<std::string, std::string>>{{"scene.json", "scene.json"},
                                                        {"scene.json", "a.obj"},
                                                        {"scene.json", "a.mtl"},
                                                        {"scene.json", "a.csv"},
                                                        {"scene.json", "my wood.png"},
                                                        {"a.obj", "a.mtl"},
                                                        {"a.obj", "a.obj"},
                                                        {"a.gltf", "triangle.bin"},
                                                        {"a.gltf", "my wood.png"}}) {
    for (const bool is_hard : {false, true}) {
      const std::string link = link_to(file, is_hard);
      expect_kept(scene, file, link);
      fs::remove(link);
    }
  }
  expect_kept("scene.json", "a.csv", path("printed/../a.csv"));
  expect_kept("a.ply", "a.ply", path("a.ply"));
  expect_kept("a.gltf", "my wood.png", path("my wood.png"));
  const std::string before = contents(folder() / "a.csv");
  expect_error(run({"form-factors", path("scene.json"), "-o", path("a.csv")}), 1, "it is");
  expect_error(run({"form-factors", path("scene.json"), "--from", "s", "-o", path("a.csv")}), 1,
               "it is");
  expect_error(run({"render", path("scene.json"), "-o", path("my wood.png")}), 1, "it is");
  EXPECT_EQ(contents(folder() / "a.csv"), before);
  // The work file is an output, too.
  write_file("f.h5.partial", contents(folder() / "a.csv"));
  write_file("odd.json", scene("a.obj", "f.h5.partial"));
  expect_error(run({"form-factors", path("odd.json"), "-o", path("f.h5")}), 1, "it is");
  EXPECT_EQ(contents(folder() / "f.h5.partial"), before);
}

TEST_F(Outputs, AreNotTheSameFile) {
  expect_error(run({"solve", path("scene.json"), "-o", result("r.csv"), "-o",
                    (fs::path(result("r.csv")).parent_path() / "." / "r.csv").string()}),
               1, "it is the same file as the output");
  EXPECT_TRUE(results().empty());
}

TEST_F(Outputs, ThatCannotBeWrittenAreToldBeforeTheWork) {
  // A scene that would be refused once it is read: so it was not.
  const std::string bad = write_file("bad.obj", "v 1 2\n");
  fs::create_directory(result("folder.csv"));
  std::ofstream(result("kept.csv")) << "kept";
  fs::permissions(result("kept.csv"), fs::perms(0444));
  ASSERT_EQ(::symlink("loop.csv", result("loop.csv").c_str()), 0);
  for (const auto& [output, words] : std::vector<std::pair<std::string, std::string>>{
           {result("missing/r.csv"), "there is no folder"},
           {result("kept.csv/r.csv"), "is not a folder"},
           {result("folder.csv"), "it is a folder"},
           {result("kept.csv"), "it is write-protected"},
           {result("loop.csv"), "Too many levels of symbolic links"},
           {result(std::string(300, 'x') + ".csv"), "File name too long"},
           {"/proc/r.csv", "cannot create a file in folder"}}) {
    SCOPED_TRACE(output);
    expect_error(run({"solve", bad, "-o", result("first.csv"), "-o", output}), 1, words);
  }
  EXPECT_EQ(contents(result("kept.csv")), "kept");
  EXPECT_FALSE(fs::exists(result("first.csv")));
}

/// Whether there are bytes that steer a terminal: C0 but for line ends, DEL, C1 raw or in UTF-8, or
/// marks that turn the direction of writing.
bool steers_terminal(const std::string& text) {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n') || byte == 0x7F) return true;
  }
  return text.find("\xc2\x9b") != std::string::npos || text.find(" \x9b") != std::string::npos ||
         text.find("\xe2\x80\xae") != std::string::npos;
}

TEST_F(Outputs, NothingInAFileSteersTheTerminal) {
  const std::string evil =
      "\x1b[31m\x07 \x9b"
      "31m\xc2\x9b"
      "31m\x7f\xe2\x80\xae"
      "evil";
  write_file("evil.mtl", "newmtl " + evil + "\nKd 0.5 0.5 0.5\nKe 1 1 1\n" + evil + " 1\n");
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const std::string good =
      write_file("evil.obj", "mtllib evil.mtl\n" + square + "o " + evil + "\nusemtl " + evil +
                                 "\nf 1 2 3 4\n" + evil + "\n");
  const std::string bad = write_file("bad.obj", square + "f 1 2 " + evil + "\n");
  const std::string unknown = write_file("unknown.obj", square + "usemtl " + evil + "\n");
  const std::string named = write_file(
      "\x1b]0;t\x07"
      "a\xc2\x9b.obj",
      "v 1 2\n");
  const std::string json = write_file("key.json",
                                      "{\""
                                      "\xc2\x9b\xe2\x80\xae"
                                      "k\": 1}");
  for (const Arguments& arguments : std::vector<Arguments>{
           {"inspect", good},
           {"inspect", good, "--json"},
           {"solve", good, "--as-is", "-o", result("r.csv")},
           {"solve", good, "--as-is", "--json"},
           {"form-factors", good, "--as-is", "--by", "surface", "-o", result("f.csv")},
           {"form-factors", good, "--as-is", "--from", evil},
           {"inspect", bad},
           {"inspect", unknown},
           {"inspect", named},
           {"inspect", json},
           {"solve", "gone\x1b[2J.obj"},
           {"solve", good, "-o", "\x1b[2J.csv\x9b.xyz"},
           {"\x1b[2J"}}) {
    const Outcome outcome = run(arguments);
    SCOPED_TRACE(arguments.front() + ' ' + outcome.out + outcome.err);
    EXPECT_FALSE(steers_terminal(outcome.out));
    EXPECT_FALSE(steers_terminal(outcome.err));
    EXPECT_FALSE(outcome.out.empty() && outcome.err.empty());
  }
}

// SceneFile looks at all formats.
TEST_F(Outputs, MessagesDoNotRepeatFilesThatAreNoScene) {
  const std::string secret = "root:S3CRET$6$:19000:0:99999:7:::\n";
  write_file("passwd", secret);
  for (const std::string& scene : {write_file("secret.obj", secret),
                                   write_file("s.json", Outputs::scene("a.obj", "passwd"))}) {
    const Outcome outcome = run({"inspect", scene});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ((outcome.out + outcome.err).find("S3CRET"), std::string::npos) << outcome.err;
  }
}

// With --resume a file that is complete is left alone, but not if its values have changed.
TEST_F(Outputs, DamagedFormFactorsAreNotTakenForComplete) {
  const std::string file = result("f.h5");
  const Arguments command = {"form-factors", write_cube(0.5, 1), "--as-is", "-o", file, "--resume"};
  ASSERT_EQ(run(command).exit_code, 0);
  const std::string whole = contents(file);
  EXPECT_NE(run(command).err.find("is complete already"), std::string::npos);
  std::string damaged = whole;
  damaged[damaged.size() / 2] ^= 1;
  std::ofstream(file, std::ios::binary) << damaged;
  const Outcome outcome = run(command);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err.find("is complete already"), std::string::npos);
  EXPECT_TRUE(contents(file) == whole);
}

TEST_F(Outputs, NamesAreNoFormulasInSpreadsheets) {
  const std::string file =
      write_file("formula.obj",
                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no =HYPERLINK(\"x\",\"y\")\nf 1 2 3 4\n"
                 "o @a\nf 4 3 2 1\n");
  const Outcome outcome =
      run({"form-factors", file, "--as-is", "-o", result("f.csv"), "--by", "surface"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string csv = contents(result("f.csv"));
  EXPECT_NE(csv.find(R"csv("'=HYPERLINK(""x"",""y"")")csv"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n'@a,"), std::string::npos) << csv;
  // On the terminal names are as they are.
  EXPECT_NE(outcome.out.find("=HYPERLINK"), std::string::npos);
  EXPECT_EQ(outcome.out.find("'=HYPERLINK"), std::string::npos);
}

TEST_F(Outputs, ScenesAreWrittenInOtherFormats) {
  const std::string scene = write_cube(0.5, 2);
  const Outcome outcome =
      run({"inspect", scene, "-o", result("b.json"), "-o", result("b.xml"), "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<std::string> expected = {"b.0.ply", "b.json", "b.xml"};
  EXPECT_EQ(results(), expected);
  // The same scene, and as Mitsuba has it the same surfaces.
  const auto area = [&](const std::string& file) {
    const std::string text = run({"inspect", file, "--quiet"}).out;
    const std::size_t start = text.find("\narea");
    return start == std::string::npos ? text
                                      : text.substr(start, text.find('\n', start + 1) - start);
  };
  EXPECT_EQ(area(result("b.json")), area(scene));
  EXPECT_EQ(area(result("b.0.ply")), area(scene));
  const std::string xml = contents(result("b.xml"));
  EXPECT_NE(xml.find(R"(<rgb name="radiance" value="2, 2, 2"/>)"), std::string::npos) << xml;
  EXPECT_NE(xml.find(R"(<rgb name="reflectance" value="0.5, 0.5, 0.5"/>)"), std::string::npos);
  EXPECT_NE(xml.find(R"(<string name="filename" value="b.0.ply"/>)"), std::string::npos);
}

TEST_F(Outputs, MeshesBesideAnXmlReplaceNoInput) {
  write_file("c.0.ply", contents(folder() / "a.ply"));
  write_file("c.json", R"({"materials": {"m": {"reflectance": 0.5, "radiance": 1}},
    "surfaces": [{"name": "s", "material": "m", "mesh": "c.0.ply"}]})");
  const std::string before = contents(folder() / "c.0.ply");
  expect_error(run({"inspect", path("c.json"), "-o", path("c.xml"), "--quiet"}), 1, "c.0.ply");
  EXPECT_EQ(contents(folder() / "c.0.ply"), before);
  EXPECT_FALSE(fs::exists(folder() / "c.xml"));
}

}  // namespace
