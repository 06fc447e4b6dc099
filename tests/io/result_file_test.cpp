#include "io/result/result_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <array>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/base/output_check.h"
#include "io/base/temporary_file.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"
#include "tests/support/output_folder.h"

namespace {

using radiosity::Index;
using radiosity::OutputError;
using radiosity::PatchMesh;
using radiosity::Solution;
using radiosity::Vec3;

/// A floor of two quads and a wall of one triangle.
PatchMesh floor_and_wall() {
  PatchMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0},     {2, 0, 1},
                   {1, 0, 1}, {0, 0, 1}, {0, 1. / 3, 0}};
  mesh.surface_names = {"floor", "a \"north\", wall"};
  mesh.surface_two_sided = {false, false};
  mesh.add_patch({0, 5, 4, 1}, 0, 7);
  mesh.add_patch({1, 4, 3, 2}, 0, 8);
  mesh.add_patch({0, 1, 6, -1}, 1, 9);
  return mesh;
}

/// Numbers that decimal fractions do not hit, in three bands.
Solution make_solution(const PatchMesh& mesh) {
  Solution solution;
  solution.radiosity.resize(mesh.size(), 3);
  for (Index i = 0; i < solution.radiosity.size(); ++i) {
    solution.radiosity(i) = 1 / (3.0 + static_cast<double>(i));
  }
  solution.irradiance = 3 * solution.radiosity;
  solution.exitance = Eigen::MatrixXd::Zero(mesh.size(), 3);
  solution.exitance(2, 1) = 1e-300;
  solution.reflectance = Eigen::MatrixXd::Constant(mesh.size(), 3, 0.1);
  solution.radiosity_error = 1e-3 * solution.radiosity;
  return solution;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The records of a CSV file by RFC 4180.
std::vector<std::vector<std::string>> read_csv(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> records(1, {""});
  bool is_quoted = false;
  const std::string text = read_file(path);
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& field = records.back().back();
    if (is_quoted && text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      field += text[++i];
    } else if (text[i] == '"') {
      is_quoted = !is_quoted;
    } else if (!is_quoted && text[i] == ',') {
      records.back().emplace_back();
    } else if (!is_quoted && text[i] == '\n') {
      records.push_back({""});
    } else {
      field += text[i];
    }
  }
  EXPECT_EQ(records.back(), std::vector<std::string>{""}) << "the file must end with a newline";
  records.pop_back();
  return records;
}

/// The message of the OutputError that `action` throws.
template <typename Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const OutputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

class ResultFileTest : public OutputFolder {};
class AtomicFileTest : public OutputFolder {};

TEST_F(ResultFileTest, CsvReadsBackAsTheSameNumbers) {
  const PatchMesh mesh = floor_and_wall();
  const Solution solution = make_solution(mesh);
  io::write(folder() / "out.csv", mesh, solution);
  const std::string start =
      "patch,surface,polygon,x,y,z,area,B_0,B_1,B_2,H_0,H_1,H_2,error_0,error_1,error_2,"
      "net_0,net_1,net_2\n"
      "0,floor,7,";
  EXPECT_EQ(read_file(folder() / "out.csv").substr(0, start.size()), start);
  const auto records = read_csv(folder() / "out.csv");
  ASSERT_EQ(records.size(), 4U);
  for (Index i = 0; i < mesh.size(); ++i) {
    const std::vector<std::string>& record = records[i + 1];
    ASSERT_EQ(record.size(), 19U);
    EXPECT_EQ(record[0], std::to_string(i));
    EXPECT_EQ(record[1], mesh.surface_names[mesh.surface[i]]);
    EXPECT_EQ(record[2], std::to_string(mesh.polygon[i]));
    std::vector<double> expected(mesh.centroid[i].begin(), mesh.centroid[i].end());
    expected.push_back(mesh.area[i]);
    for (const auto* values :
         {&solution.radiosity, &solution.irradiance, &solution.radiosity_error}) {
      for (Index band = 0; band < 3; ++band) expected.push_back((*values)(i, band));
    }
    for (Index band = 0; band < 3; ++band) {
      expected.push_back(solution.radiosity(i, band) - solution.irradiance(i, band));
    }
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(std::stod(record[3 + k]), expected[k]) << "patch " << i << ", column " << 3 + k;
    }
  }
}

vtkSmartPointer<vtkPolyData> read_vtp(const std::filesystem::path& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST_F(ResultFileTest, VtpHoldsThePatchesInOrder) {
  const PatchMesh mesh = floor_and_wall();
  io::write(folder() / "out.vtp", mesh, make_solution(mesh));
  const auto polydata = read_vtp(folder() / "out.vtp");
  ASSERT_EQ(polydata->GetNumberOfPolys(), 3);
  ASSERT_EQ(polydata->GetNumberOfCells(), 3);
  for (Index i = 0; i < mesh.size(); ++i) {
    vtkIdType n_corners = 0;
    const vtkIdType* corners = nullptr;
    polydata->GetCellPoints(i, n_corners, corners);
    ASSERT_EQ(n_corners, mesh.n_corners(i));
    for (int k = 0; k < n_corners; ++k) {
      const Vec3 point(polydata->GetPoint(corners[k]));
      EXPECT_EQ(point, mesh.corner(i, k)) << "patch " << i << ", corner " << k;
    }
  }
}

TEST_F(ResultFileTest, VtpHoldsTheArraysOfTheSolution) {
  const PatchMesh mesh = floor_and_wall();
  const Solution solution = make_solution(mesh);
  io::write(folder() / "out.VTP", mesh, solution);
  const auto polydata = read_vtp(folder() / "out.VTP");
  vtkCellData& cells = *polydata->GetCellData();
  const std::map<std::string, Eigen::MatrixXd> doubles = {
      {"radiosity", solution.radiosity},
      {"irradiance", solution.irradiance},
      {"exitance", solution.exitance},
      {"reflectance", solution.reflectance},
      {"radiosity_error", solution.radiosity_error},
      {"net_flux", solution.radiosity - solution.irradiance},
      {"area", Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size())}};
  for (const auto& [name, values] : doubles) {
    vtkDataArray* array = cells.GetArray(name.c_str());
    ASSERT_NE(array, nullptr) << name;
    EXPECT_EQ(array->GetDataType(), VTK_DOUBLE) << name;
    ASSERT_EQ(array->GetNumberOfComponents(), values.cols()) << name;
    for (Index i = 0; i < values.rows(); ++i) {
      for (int band = 0; band < values.cols(); ++band) {
        EXPECT_EQ(array->GetComponent(i, band), values(i, band)) << name;
      }
    }
  }
  for (const auto& [name, values] : {std::pair("surface", mesh.surface),
                                     {"polygon", mesh.polygon},
                                     {"twin", mesh.twin},
                                     {"family", mesh.family}}) {
    vtkDataArray* array = cells.GetArray(name);
    ASSERT_NE(array, nullptr) << name;
    EXPECT_EQ(array->GetDataType(), VTK_INT) << name;
    for (Index i = 0; i < mesh.size(); ++i) EXPECT_EQ(array->GetComponent(i, 0), values[i]);
  }
  EXPECT_EQ(cells.GetNumberOfArrays(), 11);
  const auto* names =
      vtkStringArray::SafeDownCast(polydata->GetFieldData()->GetAbstractArray("surface_names"));
  ASSERT_NE(names, nullptr);
  ASSERT_EQ(names->GetNumberOfValues(), 2);
  EXPECT_EQ(const_cast<vtkStringArray*>(names)->GetValue(1), mesh.surface_names[1]);
}

struct PlyVertex {
  std::array<float, 3> position;
  std::array<std::uint8_t, 3> color;
};

struct Ply {
  std::vector<PlyVertex> vertices;
  std::vector<std::vector<std::int32_t>> faces;
};

template <typename T>
T take(std::istream& stream) {
  T value;
  stream.read(reinterpret_cast<char*>(&value), sizeof(T));
  return value;
}

/// Reads the kind of PLY that io::write makes.
Ply read_ply(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::size_t n_vertices = 0;
  std::size_t n_faces = 0;
  std::string line;
  while (std::getline(stream, line) && line != "end_header") {
    std::istringstream words(line);
    std::string keyword;
    std::string element;
    std::size_t count = 0;
    words >> keyword >> element >> count;
    if (keyword == "element") (element == "vertex" ? n_vertices : n_faces) = count;
  }
  Ply ply;
  for (std::size_t i = 0; i < n_vertices; ++i) {
    PlyVertex vertex;
    for (float& x : vertex.position) x = take<float>(stream);
    for (std::uint8_t& c : vertex.color) c = take<std::uint8_t>(stream);
    ply.vertices.push_back(vertex);
  }
  for (std::size_t i = 0; i < n_faces; ++i) {
    std::vector<std::int32_t> face(take<std::uint8_t>(stream));
    for (std::int32_t& vertex : face) vertex = take<std::int32_t>(stream);
    ply.faces.push_back(face);
  }
  EXPECT_TRUE(stream.good());
  EXPECT_EQ(stream.peek(), std::char_traits<char>::eof());
  return ply;
}

TEST_F(ResultFileTest, PlyHoldsThePatchesWithSmoothColors) {
  const PatchMesh mesh = floor_and_wall();
  Solution solution = make_solution(mesh);
  solution.exitance.setZero();
  solution.radiosity.row(0) << 1, 1, 1;
  solution.radiosity.row(1) << 2, 2, 2;
  solution.radiosity.row(2) << 0, 0, 1;
  io::write(folder() / "out.ply", mesh, solution);
  const Ply ply = read_ply(folder() / "out.ply");
  ASSERT_EQ(ply.faces.size(), 3U);
  for (Index i = 0; i < mesh.size(); ++i) {
    ASSERT_EQ(ply.faces[i].size(), mesh.n_corners(i));
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const PlyVertex& vertex = ply.vertices[ply.faces[i][k]];
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(vertex.position[axis], static_cast<float>(mesh.corner(i, k)[axis]));
      }
    }
  }
  // The floor's quads share the two vertices between them; the wall's triangle shares none.
  EXPECT_EQ(ply.vertices.size(), 6U + 3U);
  const auto& dark = ply.vertices[ply.faces[0][0]].color;
  const auto& middle = ply.vertices[ply.faces[0][2]].color;
  const auto& bright = ply.vertices[ply.faces[1][2]].color;
  EXPECT_LT(dark[0], middle[0]);
  EXPECT_LT(middle[0], bright[0]);
  EXPECT_EQ(middle[0], middle[2]);
  const auto& wall = ply.vertices[ply.faces[2][0]].color;
  EXPECT_EQ(wall[0], 0);
  EXPECT_GT(wall[2], 0);
}

TEST_F(ResultFileTest, UnknownExtensionIsAnError) {
  const PatchMesh mesh = floor_and_wall();
  const std::string message =
      error_of([&] { io::write(folder() / "out.xyz", mesh, make_solution(mesh)); });
  EXPECT_NE(message.find("out.xyz: cannot write a result as '.xyz'"), std::string::npos) << message;
  EXPECT_TRUE(file_names().empty());
}

TEST_F(ResultFileTest, MissingFolderIsAnError) {
  const PatchMesh mesh = floor_and_wall();
  for (const char* name : {"out.csv", "out.vtp", "out.ply", "out.glb"}) {
    const auto path = folder() / "missing" / name;
    const std::string message = error_of([&] { io::write(path, mesh, make_solution(mesh)); });
    EXPECT_EQ(message.find(path.string()), 0U) << message;
    EXPECT_NE(message.find("there is no folder"), std::string::npos) << message;
  }
  EXPECT_TRUE(file_names().empty());
}

// Wherever the disk ends, there is an error, and neither half a file nor a temporary one.
TEST_F(ResultFileTest, FullDiskLeavesTheOldFile) {
  PatchMesh mesh = floor_and_wall();
  for (int i = 0; i < 500; ++i) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const int corner : {0, 5, 4})
      mesh.vertices.push_back(mesh.vertices[corner] + Vec3(0, i, 0));
    mesh.add_patch({first, first + 1, first + 2, -1}, 0, i);
  }
  const Solution solution = make_solution(mesh);
  for (const char* name : {"out.csv", "out.vtp", "out.ply"}) {
    const auto path = folder() / name;
    io::write(path, mesh, solution);
    const std::string whole = read_file(path);
    for (const std::size_t space : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
      std::ofstream(path) << "old";
      const std::string message = error_of([&] {
        const SmallDisk disk(space);
        io::write(path, mesh, solution);
      });
      EXPECT_EQ(message, path.string() + ": cannot write: File too large") << space;
      EXPECT_EQ(read_file(path), "old") << name << ' ' << space;
    }
    const SmallDisk disk(whole.size());
    io::write(path, mesh, solution);
    EXPECT_EQ(read_file(path).size(), whole.size());
  }
  EXPECT_EQ(file_names(), (std::set<std::string>{"out.csv", "out.ply", "out.vtp"}));
}

TEST_F(AtomicFileTest, ReplacesTheFileWhole) {
  const auto path = folder() / "file";
  std::ofstream(path) << "old";
  io::write_atomically(path, [&](const std::filesystem::path& temporary) {
    EXPECT_EQ(temporary.parent_path(), folder());
    EXPECT_NE(temporary, path);
    std::ofstream(temporary) << "new";
    EXPECT_EQ(read_file(path), "old");
  });
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(file_names(), std::set<std::string>{"file"});
}

TEST_F(AtomicFileTest, LeavesTheOldFileWhenTheWriterThrows) {
  const auto path = folder() / "file";
  std::ofstream(path) << "old";
  const auto fail = [](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "half";
    throw std::logic_error("stop");
  };
  EXPECT_THROW(io::write_atomically(path, fail), std::logic_error);
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(file_names(), std::set<std::string>{"file"});
}

TEST_F(AtomicFileTest, TakesNamesWithoutFolder) {
  const WorkingFolder inside(folder());
  io::write_atomically("plain",
                       [](const std::filesystem::path& name) { std::ofstream(name) << "x"; });
  EXPECT_EQ(read_file(folder() / "plain"), "x");
  EXPECT_EQ(file_names(), std::set<std::string>{"plain"});
}

TEST_F(AtomicFileTest, TakesTheLongestNames) {
  const auto path = folder() / std::string(255, 'n');
  io::write_stream_atomically(path, [](std::ofstream& stream) { stream << "x"; });
  EXPECT_EQ(read_file(path), "x");
}

TEST_F(AtomicFileTest, KeepsLinksAndReplacesWhatTheyPointTo) {
  std::filesystem::create_directory(folder() / "elsewhere");
  std::ofstream(folder() / "elsewhere" / "file") << "old";
  std::filesystem::create_symlink("elsewhere/file", folder() / "link");
  io::write_stream_atomically(folder() / "link", [](std::ofstream& stream) { stream << "new"; });
  EXPECT_TRUE(std::filesystem::is_symlink(folder() / "link"));
  EXPECT_EQ(read_file(folder() / "elsewhere" / "file"), "new");
}

TEST_F(AtomicFileTest, KeepsThePermissionsAndTheProtection) {
  const auto path = folder() / "file";
  std::ofstream(path) << "old";
  std::filesystem::permissions(path, std::filesystem::perms(0640));
  io::write_stream_atomically(path, [](std::ofstream& stream) { stream << "new"; });
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms(0640));
  std::filesystem::permissions(path, std::filesystem::perms(0444));
  const auto write = [&] {
    io::write_stream_atomically(path, [](std::ofstream& stream) { stream << "newer"; });
  };
  EXPECT_NE(error_of(write).find("write-protected"), std::string::npos);
  EXPECT_EQ(read_file(path), "new");
}

/// A process that makes a temporary file in `folder` and then lives on (until it is killed) or has
/// been killed by the time this returns.
pid_t writer(const std::filesystem::path& folder, bool is_killed) {
  std::array<int, 2> pipe{};
  EXPECT_EQ(::pipe(pipe.data()), 0);
  const pid_t process = ::fork();
  if (process == 0) {
    const io::TemporaryFile file(folder, folder / "target");
    std::ofstream(file.path()) << "half";
    [[maybe_unused]] const auto n = ::write(pipe[1], "x", 1);
    for (;;) ::pause();
  }
  char ready = 0;
  EXPECT_EQ(::read(pipe[0], &ready, 1), 1);
  ::close(pipe[0]);
  ::close(pipe[1]);
  if (is_killed) {
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
  }
  return process;
}

// What a killed run has left goes; what a running one writes, what is not a file and what has
// another name stays.
TEST_F(AtomicFileTest, RemovesWhatKilledRunsLeft) {
  (void)writer(folder(), true);
  const pid_t running = writer(folder(), false);
  const std::string kept = ".radiosity-" + std::to_string(running) + "-0.tmp";
  std::filesystem::create_directory(folder() / ".radiosity-1-0.tmp");
  ASSERT_EQ(::mkfifo((folder() / ".radiosity-1-1.tmp").c_str(), 0600), 0);
  std::ofstream(folder() / "victim") << "x";
  std::filesystem::create_symlink("victim", folder() / ".radiosity-1-2.tmp");
  std::ofstream(folder() / ".radiosity-x-0.tmp") << "x";
  std::ofstream(folder() / ".radiosity-1-3.tmp.bak") << "x";
  std::ofstream(folder() / ".radiosity-99999999-7.tmp") << "stale";
  std::set<std::string> others = {kept,
                                  ".radiosity-1-0.tmp",
                                  ".radiosity-1-1.tmp",
                                  ".radiosity-1-2.tmp",
                                  ".radiosity-x-0.tmp",
                                  ".radiosity-1-3.tmp.bak",
                                  "victim"};
  ASSERT_EQ(file_names().size(), others.size() + 2);
  io::write_stream_atomically(folder() / "out", [](std::ofstream& stream) { stream << "x"; });
  others.insert("out");
  EXPECT_EQ(file_names(), others);
  ::kill(running, SIGKILL);
  ::waitpid(running, nullptr, 0);
  io::check_writable(folder() / "other");
  others.erase(kept);
  EXPECT_EQ(file_names(), others);
}

// Four processes write to one folder at once: none takes another's file for a stale one.
TEST_F(AtomicFileTest, ManyWritersDoNotDisturbEachOther) {
  std::vector<pid_t> writers;
  for (int p = 0; p < 4; ++p) {
    writers.push_back(::fork());
    if (writers.back() != 0) continue;
    try {
      for (int i = 0; i < 50; ++i) {
        io::write_stream_atomically(folder() / std::to_string(p),
                                    [&](std::ofstream& stream) { stream << i; });
      }
    } catch (const std::exception&) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  for (const pid_t process : writers) {
    int status = 0;
    ::waitpid(process, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(file_names(), (std::set<std::string>{"0", "1", "2", "3"}));
  EXPECT_EQ(read_file(folder() / "2"), "49");
}

TEST_F(AtomicFileTest, KnowsSameFilesByAnyName) {
  std::filesystem::create_directory(folder() / "sub");
  std::ofstream(folder() / "a") << "x";
  std::ofstream(folder() / "b") << "x";
  std::filesystem::create_symlink("a", folder() / "soft");
  std::filesystem::create_hard_link(folder() / "a", folder() / "hard");
  std::filesystem::create_symlink("gone", folder() / "dangling");
  std::filesystem::create_directory_symlink("sub", folder() / "way");
  const auto same = [&](const char* a, const char* b) {
    return io::is_same_file(folder() / a, folder() / b);
  };
  EXPECT_TRUE(same("a", "a") && same("a", "./sub/../a") && same("a", "soft") && same("a", "hard"));
  EXPECT_TRUE(same("soft", "hard"));
  EXPECT_TRUE(same("dangling", "gone") && same("sub/new", "way/new") && same("new", "./new"));
  EXPECT_FALSE(same("a", "b") || same("a", "new"));
  EXPECT_FALSE(same("new", "sub/new") || same("new", "newer"));
  EXPECT_FALSE(same("missing/new", "missing/new"));
}

TEST_F(AtomicFileTest, RefusesFoldersAndDevices) {
  const auto never = [](const std::filesystem::path&) { FAIL() << "must not be called"; };
  std::filesystem::create_directory(folder() / "sub");
  std::filesystem::create_symlink("/dev/full", folder() / "device");
  const auto message = [&](const std::filesystem::path& path) {
    return error_of([&] { io::write_atomically(path, never); });
  };
  EXPECT_NE(message(folder() / "sub").find("is a folder"), std::string::npos);
  EXPECT_NE(message(folder() / "sub" / "").find("expected the name of a file"), std::string::npos);
  EXPECT_NE(message(folder() / "device").find("not a regular file"), std::string::npos);
  EXPECT_EQ(file_names(), (std::set<std::string>{"device", "sub"}));
}

}  // namespace
