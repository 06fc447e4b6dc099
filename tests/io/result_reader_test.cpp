#include "io/result/result_reader.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "io/result/result_file.h"
#include "io/result/vtk_polydata.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"
#include "tests/support/damaged_files.h"
#include "tests/support/output_folder.h"
#include "tests/support/scratch_files.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;
using radiosity::test::file_bytes;
using radiosity::test::write_bytes;

/// A box, a triangle, and a two-sided sheet, at coordinates that no decimal fraction hits.
PatchMesh odd_box() {
  PatchMesh mesh;
  test::add_box(mesh, Vec3(1. / 3, 0.1, -7), Vec3(1, 2. / 7, 0.3), 2, test::Facing::inwards);
  const auto sheet =
      test::add_grid(mesh, Vec3(0.5, 0.15, -3), Vec3(0.1, 0, 0), Vec3(0, 0.1, 1), 2, 1);
  test::make_two_sided(mesh, sheet);
  mesh.surface_names.emplace_back("a \"north\", <wall> of ü");
  mesh.surface_two_sided.push_back(false);
  mesh.add_patch({0, 1, 12, -1}, sheet + 1, 1000000);
  mesh.family[2] = 4;
  return mesh;
}

Solution make_solution(const PatchMesh& mesh, Index n_bands) {
  Solution solution;
  solution.radiosity.resize(mesh.size(), n_bands);
  for (Index i = 0; i < solution.radiosity.size(); ++i) {
    solution.radiosity(i) = 1 / (3.0 + static_cast<double>(i));
  }
  solution.irradiance = 3 * solution.radiosity;
  solution.exitance = Eigen::MatrixXd::Zero(mesh.size(), n_bands);
  solution.exitance(2, 0) = 1e-300;
  solution.reflectance = Eigen::MatrixXd::Constant(mesh.size(), n_bands, 0.1);
  solution.radiosity_error = 1e-3 * solution.radiosity;
  solution.energy = {.emitted = Eigen::VectorXd::Constant(n_bands, 1. / 3),
                     .absorbed = Eigen::VectorXd::Constant(n_bands, 1. / 7),
                     .escaped = Eigen::VectorXd::Constant(n_bands, 1. / 3 - 1. / 7)};
  solution.method = Method::southwell;
  solution.iterations = 17;
  solution.products = 17.25;
  solution.residual = 1e-9;
  solution.error_bound = std::numeric_limits<double>::infinity();
  solution.transport_error_bound = 1e-3;
  solution.converged = true;
  return solution;
}

void expect_equal(const PatchMesh& read, const PatchMesh& mesh) {
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.corners, mesh.corners);
  EXPECT_EQ(read.surface, mesh.surface);
  EXPECT_EQ(read.polygon, mesh.polygon);
  EXPECT_EQ(read.twin, mesh.twin);
  EXPECT_EQ(read.family, mesh.family);
  EXPECT_EQ(read.area, mesh.area);
  EXPECT_EQ(read.normal, mesh.normal);
  EXPECT_EQ(read.centroid, mesh.centroid);
  EXPECT_EQ(read.surface_names, mesh.surface_names);
  EXPECT_EQ(read.surface_two_sided, mesh.surface_two_sided);
}

class ResultReader : public OutputFolder {
 protected:
  /// The message of the SceneError that reading the file throws.
  static std::string error_of(const std::filesystem::path& path) {
    return test::refusal<SceneError>(path, [](const auto& file) { (void)io::read_result(file); });
  }

  /// A file of a polydata that `change` has changed.
  [[nodiscard]] std::filesystem::path changed(
      const std::function<void(vtkPolyData&)>& change) const {
    const PatchMesh mesh = odd_box();
    const auto polydata = io::make_polydata(mesh, make_solution(mesh, 3));
    change(*polydata);
    io::write_polydata(folder() / "changed.vtp", *polydata);
    return folder() / "changed.vtp";
  }

  /// The same with one value of a cell array changed.
  [[nodiscard]] std::filesystem::path with_value(const char* array, vtkIdType row,
                                                 double value) const {
    return changed([&](vtkPolyData& polydata) {
      polydata.GetCellData()->GetArray(array)->SetComponent(row, 0, value);
    });
  }

  /// A file in words whose first polygon begins with this point. VTK must not write such a one
  /// itself: from 9.3 on it looks up all points on the way.
  [[nodiscard]] std::filesystem::path with_first_corner(const std::string& point) const {
    const PatchMesh mesh = odd_box();
    const std::filesystem::path path = folder() / "corner.vtp";
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(io::make_polydata(mesh, make_solution(mesh, 3)));
    writer->SetFileName(path.c_str());
    writer->SetDataModeToAscii();
    writer->Write();
    std::string text = file_bytes(path);
    const std::size_t array = text.find("Name=\"connectivity\"", text.find("<Polys>"));
    const std::size_t first = text.find_first_of("0123456789", text.find('>', array));
    text.replace(first, text.find_first_not_of("0123456789", first) - first, point);
    write_bytes(path, text);
    return path;
  }
};

TEST_F(ResultReader, GivesBackWhatWasWritten) {
  const PatchMesh mesh = odd_box();
  const Bands bands[] = {{Bands::Kind::grey, {}},
                         {Bands::Kind::rgb, {}},
                         {Bands::Kind::wavelengths, {500}},
                         {Bands::Kind::wavelengths, {400, 500. + 1. / 3, 600}},
                         {Bands::Kind::wavelengths, {400, 500, 600, 700, 1e4}},
                         {Bands::Kind::solar_infrared, {}},
                         {Bands::Kind::solar_infrared, {}, {3}},
                         {Bands::Kind::thermal, {}, {4, 8. + 1. / 3}},
                         {Bands::Kind::thermal, {}, {2}}};
  for (const Bands& written : bands) {
    const Solution solution = make_solution(mesh, written.count());
    io::ResultOptions options{.bands = written};
    if (written.kind == Bands::Kind::rgb)
      options.camera = radiosity::Camera{.position = {1. / 3, 2, -5}};
    io::write(folder() / "out.vtp", mesh, solution, options);
    const io::StoredResult read = io::read_result(folder() / "out.vtp");
    ASSERT_EQ(read.camera.has_value(), options.camera.has_value());
    EXPECT_TRUE(!read.camera || read.camera->position == options.camera->position);
    expect_equal(read.mesh, mesh);
    EXPECT_EQ(read.bands.kind, written.kind);
    EXPECT_EQ(read.bands.wavelengths, written.wavelengths);
    EXPECT_EQ(read.bands.edges, written.edges);
    EXPECT_EQ(read.solution.radiosity, solution.radiosity);
    EXPECT_EQ(read.solution.irradiance, solution.irradiance);
    EXPECT_EQ(read.solution.exitance, solution.exitance);
    EXPECT_EQ(read.solution.reflectance, solution.reflectance);
    EXPECT_EQ(read.solution.radiosity_error, solution.radiosity_error);
    EXPECT_EQ(read.solution.energy.emitted, solution.energy.emitted);
    EXPECT_EQ(read.solution.energy.absorbed, solution.energy.absorbed);
    EXPECT_EQ(read.solution.energy.escaped, solution.energy.escaped);
    EXPECT_EQ(read.solution.method, solution.method);
    EXPECT_EQ(read.solution.iterations, solution.iterations);
    EXPECT_EQ(read.solution.products, solution.products);
    EXPECT_EQ(read.solution.residual, solution.residual);
    EXPECT_EQ(read.solution.error_bound, solution.error_bound);
    EXPECT_EQ(read.solution.transport_error_bound, solution.transport_error_bound);
    EXPECT_TRUE(read.solution.converged);
    EXPECT_TRUE(read.warnings.empty());
    // What was read makes the same file.
    options.camera = read.camera;
    io::write(folder() / "again.vtp", read.mesh, read.solution, options);
    EXPECT_EQ(file_bytes(folder() / "again.vtp"), file_bytes(folder() / "out.vtp"));
  }
}

/// As files were before they had a version.
void remove_what_is_new(vtkPolyData& polydata) {
  vtkFieldData& fields = *polydata.GetFieldData();
  for (int k = fields.GetNumberOfArrays() - 1; k >= 0; --k) {
    const std::string name = fields.GetArrayName(k);
    if (name != "surface_names") fields.RemoveArray(name.c_str());
  }
  polydata.GetCellData()->RemoveArray("twin");
  polydata.GetCellData()->RemoveArray("family");
}

TEST_F(ResultReader, OpensFilesWithoutVersion) {
  const io::StoredResult read = io::read_result(changed(remove_what_is_new));
  PatchMesh mesh = odd_box();
  mesh.family.assign(mesh.family.size(), -1);
  expect_equal(read.mesh, mesh);
  EXPECT_EQ(read.bands.kind, Bands::Kind::rgb);
  EXPECT_TRUE(read.warnings.empty());
  const Solution& solution = read.solution;
  double emitted = 0;
  for (Index i = 0; i < mesh.size(); ++i) emitted += mesh.area[i] * solution.exitance(i, 0);
  EXPECT_DOUBLE_EQ(solution.energy.emitted[0], emitted);
  EXPECT_EQ(solution.energy.escaped, solution.energy.emitted - solution.energy.absorbed);
}

TEST_F(ResultReader, TellsThatWavelengthsAreUnknown) {
  const PatchMesh mesh = odd_box();
  io::write(folder() / "out.vtp", mesh, make_solution(mesh, 4));
  const io::StoredResult read = io::read_result(folder() / "out.vtp");
  EXPECT_EQ(read.bands.kind, Bands::Kind::wavelengths);
  EXPECT_EQ(read.bands.wavelengths, (std::vector<double>{1, 2, 3, 4}));
  ASSERT_EQ(read.warnings.size(), 1U);
  EXPECT_CONTAINS(read.warnings[0], "does not tell the wavelengths of its 4 bands");
}

TEST_F(ResultReader, OpensWhatParaViewSavesAgain) {
  const PatchMesh mesh = odd_box();
  const auto polydata = io::make_polydata(mesh, make_solution(mesh, 3));
  const Solution solution = make_solution(mesh, 3);
  for (unsigned k = 0; k < 4 * 3 * 2 * 2; ++k) {
    const unsigned mode = k % 4;
    const auto compressor = static_cast<int>(k / 4 % 3);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(polydata);
    writer->SetDataMode(mode == 0   ? vtkXMLWriter::Ascii
                        : mode == 1 ? vtkXMLWriter::Binary
                                    : vtkXMLWriter::Appended);
    writer->SetEncodeAppendedData(mode == 3);
    writer->SetCompressorType(compressor);  // none, zlib, LZ4
    writer->SetBlockSize(256);              // many blocks, the last one shorter
    if (k / 12 % 2 == 0) writer->SetHeaderTypeToUInt32();
    if (k / 24 == 1) writer->SetByteOrderToBigEndian();
    writer->SetFileName((folder() / "saved.vtp").c_str());
    ASSERT_EQ(writer->Write(), 1);
    SCOPED_TRACE(k);
    const io::StoredResult read = io::read_result(folder() / "saved.vtp");
    const bool is_text = mode == 0;  // VTK writes fewer digits than there are
    EXPECT_EQ(read.mesh.corners, mesh.corners);
    EXPECT_EQ(read.mesh.surface_names, mesh.surface_names);
    EXPECT_LE((read.solution.radiosity - solution.radiosity).cwiseAbs().maxCoeff(),
              is_text ? 1e-9 : 0.0);
    if (!is_text) expect_equal(read.mesh, mesh);
  }
}

// One or two bytes were changed, so that a block, or a size, is not what it was (made for this
// project); VTK's own reader crashes, or asks for 64 GB.
TEST_F(ResultReader, RefusesDamageThatVtkDoesNotSurvive) {
  for (const char* name : {"damaged-blocks.vtp", "damaged-size.vtp"}) {
    EXPECT_CONTAINS(error_of(std::filesystem::path(RADIOSITY_TEST_DATA) / "damaged" / name),
                    "is damaged");
  }
}

// All numbers that stand in the tags, and some that do not fit what follows.
TEST_F(ResultReader, RefusesNumbersThatDoNotFit) {
  const PatchMesh mesh = odd_box();
  io::write(folder() / "out.vtp", mesh, make_solution(mesh, 3));
  const std::string whole = file_bytes(folder() / "out.vtp");
  int n_changed = 0;
  for (const char* key : {"NumberOfPoints", "NumberOfPolys", "NumberOfStrips", "NumberOfTuples",
                          "NumberOfComponents", "offset", "NumberOfVerts", "NumberOfLines"}) {
    const std::string start = std::string(" ") + key + "=\"";
    for (auto place = whole.find(start); place != std::string::npos;
         place = whole.find(start, place + 1)) {
      const std::size_t first = place + start.size();
      const std::size_t end = whole.find('"', first);
      for (const char* value : {"-1", "7", "2147483647", "18446744073709551615", "1e9", "x", ""}) {
        if (whole.substr(first, end - first) == value) continue;
        write_bytes(folder() / "changed.vtp", whole.substr(0, first) + value + whole.substr(end));
        const std::string message = test::outcome<SceneError>(
            folder() / "changed.vtp", [](const auto& file) { (void)io::read_result(file); });
        // Texts may be in any number; what was of one row may have one text more.
        n_changed += message.empty() ? 0 : 1;
      }
    }
  }
  EXPECT_GT(n_changed, 200);
  write_bytes(
      folder() / "deep.vtp", "<VTKFile type=\"PolyData\">" + [] {
        std::string tags;
        for (int i = 0; i < 400000; ++i) tags += "<a>";
        return tags;
      }() + "</VTKFile>");
  EXPECT_CONTAINS(error_of(folder() / "deep.vtp"), "is damaged: its XML is not well formed");
}

TEST_F(ResultReader, ExplainsWhatIsNoResult) {
  EXPECT_CONTAINS(error_of(folder() / "gone.vtp"), "no such file");
  EXPECT_CONTAINS(error_of(folder()), "is a folder");
  write_bytes(folder() / "a.vtp", "");
  EXPECT_CONTAINS(error_of(folder() / "a.vtp"), "is empty");
  write_bytes(folder() / "a.vtp", "v 0 0 0\nv 1 0 0\n");
  EXPECT_CONTAINS(error_of(folder() / "a.vtp"), "is not a .vtp file");
  write_bytes(folder() / "a.vtp", "<VTKFile type=\"ImageData\"></VTKFile>\n");
  EXPECT_CONTAINS(error_of(folder() / "a.vtp"), "of another kind, expected PolyData");
  write_bytes(folder() / "a.vtp", "<VTKFile type=\"PolyData\"><Piece</VTKFile>\n");
  EXPECT_CONTAINS(error_of(folder() / "a.vtp"), "is damaged: its XML is not well formed");
  write_bytes(folder() / "a.vtp",
              "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData></PolyData></VTKFile>\n");
  (void)error_of(folder() / "a.vtp");
  const auto foreign = changed([](vtkPolyData& polydata) {
    polydata.GetCellData()->RemoveArray("radiosity");
    polydata.GetCellData()->RemoveArray("polygon");
    polydata.GetFieldData()->RemoveArray("surface_names");
  });
  EXPECT_CONTAINS(error_of(foreign),
                  "is no result of this program: it lacks cell array \"radiosity\", cell array "
                  "\"polygon\", field data \"surface_names\"");
}

template <typename Array, typename Value>
void set_field(vtkPolyData& polydata, const char* name, std::vector<Value> values) {
  vtkNew<Array> array;
  array->SetName(name);
  for (const Value value : values) array->InsertNextValue(value);
  polydata.GetFieldData()->AddArray(array);
}

TEST_F(ResultReader, ExplainsValuesThatMakeNoSense) {
  EXPECT_CONTAINS(error_of(changed([](vtkPolyData& polydata) {
                    set_field<vtkIntArray, int>(polydata, "radiosity_version", {7});
                  })),
                  "was written by a newer version of this program (format 7, this one reads 1)");
  EXPECT_CONTAINS(error_of(changed([](vtkPolyData& polydata) {
                    set_field<vtkIntArray, int>(polydata, "surface_two_sided", {1});
                  })),
                  "\"surface_two_sided\" has 1 values, but there are 8 surfaces");
  EXPECT_CONTAINS(error_of(changed([](vtkPolyData& polydata) {
                    set_field<vtkDoubleArray, double>(polydata, "energy_emitted", {1});
                  })),
                  "\"energy_emitted\" has 1 values, but there are 3 bands");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_CONTAINS(error_of(with_value("radiosity", 3, nan)),
                  "\"radiosity\" has a value that is not finite at patch 3");
  EXPECT_CONTAINS(error_of(with_value("surface", 0, 8)),
                  "\"surface\" has 8 at 0, expected a whole number from 0 to 7");
  EXPECT_CONTAINS(error_of(with_value("polygon", 1, -1)), "\"polygon\" has -1 at 1");
  EXPECT_CONTAINS(error_of(with_value("twin", 1, 1e6)), "\"twin\" has 1000000 at 1");
  EXPECT_CONTAINS(error_of(with_value("twin", 1, 1)), "patch 1 has the back 1");
  EXPECT_CONTAINS(error_of(with_value("family", 1, -2)), "\"family\" has -2 at 1");
  EXPECT_CONTAINS(error_of(changed([&](vtkPolyData& polydata) {
                    polydata.GetPoints()->GetData()->SetComponent(4, 2, nan);
                  })),
                  "point 4 is not finite");
  EXPECT_CONTAINS(error_of(with_first_corner("5000")),
                  "polygon 0 uses point 5000, but the file has");
  EXPECT_CONTAINS(error_of(with_first_corner("-1")), "polygon 0 uses point -1");
}

TEST_F(ResultReader, ExplainsCellsAndArraysThatDoNotFit) {
  EXPECT_CONTAINS(error_of(changed([](vtkPolyData& polydata) {
                    vtkNew<vtkCellArray> lines;
                    lines->InsertNextCell({0, 1});
                    polydata.SetLines(lines);
                    vtkCellData& cells = *polydata.GetCellData();
                    for (int k = 0; k < cells.GetNumberOfArrays(); ++k) {
                      cells.GetArray(k)->InsertNextTuple(cells.GetArray(k)->GetNumberOfTuples() - 1,
                                                         cells.GetArray(k));
                    }
                  })),
                  "has vertices, lines or strips beside its polygons");
  EXPECT_CONTAINS(error_of(changed([](vtkPolyData& polydata) {
                    vtkNew<vtkCellArray> polygons;
                    for (vtkIdType i = 0; i < polydata.GetNumberOfCells(); ++i) {
                      polygons->InsertNextCell({0, 1, 2, 3, 4});
                    }
                    polydata.SetPolys(polygons);
                  })),
                  "polygon 0 has 5 corners, expected 3 or 4");
  EXPECT_CONTAINS(error_of(changed([](vtkPolyData& polydata) {
                    vtkNew<vtkDoubleArray> array;
                    array->SetName("irradiance");
                    array->SetNumberOfComponents(2);
                    array->SetNumberOfTuples(polydata.GetNumberOfCells());
                    array->FillValue(0);
                    polydata.GetCellData()->AddArray(array);
                  })),
                  "\"irradiance\" has 2 columns, but \"radiosity\" has 3");
  EXPECT_CONTAINS(error_of(changed([](vtkPolyData& polydata) {
                    auto& points = *polydata.GetPoints();
                    for (vtkIdType i = 0; i < points.GetNumberOfPoints(); ++i) {
                      points.SetPoint(i, 0, 0, 0);
                    }
                  })),
                  "patch 0 has the area 0 m²");
}

/// Cut off anywhere, a file is refused in one line and nothing is printed.
TEST_F(ResultReader, RefusesFilesThatWereCutOff) {
  const PatchMesh mesh = odd_box();
  io::write(folder() / "out.vtp", mesh, make_solution(mesh, 3));
  const std::string whole = file_bytes(folder() / "out.vtp");
  [[maybe_unused]] const test::LeaksAllowed allowed;
  testing::internal::CaptureStderr();
  for (std::size_t size = 0; size + 2 < whole.size(); size += 1 + size / 50) {
    write_bytes(folder() / "cut.vtp", whole.substr(0, size));
    (void)error_of(folder() / "cut.vtp");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// With a byte changed anywhere, a file opens or is refused in one line.
TEST_F(ResultReader, SurvivesChangedBytes) {
  const PatchMesh mesh = odd_box();
  io::write(folder() / "out.vtp", mesh, make_solution(mesh, 3));
  const std::string whole = file_bytes(folder() / "out.vtp");
  std::mt19937_64 random(1);
  [[maybe_unused]] const test::LeaksAllowed allowed;
  testing::internal::CaptureStderr();
  int n_refused = 0;
  for (int i = 0; i < 1000; ++i) {
    write_bytes(folder() / "flip.vtp", test::with_flip(whole, 0, whole.size(), random));
    n_refused += test::outcome<SceneError>(
                     folder() / "flip.vtp",
                     [](const auto& file) {
                       (void)io::read_result(file);
                     }).empty()
                     ? 0
                     : 1;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(n_refused, 500);
}

}  // namespace
