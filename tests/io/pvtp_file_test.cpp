#include "io/result/pvtp_file.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPPolyDataReader.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "io/result/vtk_polydata.h"
#include "radiosity/base/error.h"
#include "tests/support/output_folder.h"

namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Solution;

using PvtpFile = OutputFolder;

constexpr std::uint64_t kPieceSeed = 20261201;

/// A ribbon of quads, after each of which a triangle stands.
PatchMesh ribbon(int n_quads) {
  PatchMesh mesh;
  mesh.surface_names = {"ribbon", "a \"standing\" <one>"};
  mesh.surface_two_sided = {false, true};
  for (int k = 0; k <= n_quads; ++k) {
    mesh.vertices.emplace_back(k / 3., 0, 0);
    mesh.vertices.emplace_back(k / 3., 0, 1 / 7.);
  }
  for (int k = 0; k < n_quads; ++k) {
    mesh.add_patch({2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2}, 0, k);
    mesh.vertices.emplace_back(k / 3., 1, 0.1);
    const auto top = static_cast<std::int32_t>(mesh.vertices.size() - 1);
    mesh.add_patch({2 * k, 2 * k + 1, top, -1}, 1, n_quads + k);
  }
  return mesh;
}

Solution random_solution(Index n, Index n_bands) {
  std::mt19937_64 random(kPieceSeed);
  std::uniform_real_distribution<double> number(0, 1);
  const auto any = [&] {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(n, n_bands, [&] { return number(random); }));
  };
  Solution solution;
  solution.radiosity = any();
  solution.irradiance = any();
  solution.exitance = any();
  solution.reflectance = any();
  solution.radiosity_error = any();
  return solution;
}

std::vector<radiosity::Vec3> corners(vtkPolyData& polydata, vtkIdType cell) {
  vtkNew<vtkIdList> ids;
  polydata.GetCellPoints(cell, ids);
  std::vector<radiosity::Vec3> result;
  for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) {
    result.emplace_back(radiosity::Vec3::Map(polydata.GetPoint(ids->GetId(k))));
  }
  return result;
}

TEST_F(PvtpFile, PiecesAreTheWhole) {
  const std::filesystem::path path = folder() / "a & b.pvtp";
  const PatchMesh mesh = ribbon(4);
  for (const Index n_bands : {1, 3}) {
    const Solution solution = random_solution(mesh.size(), n_bands);
    const auto whole = io::make_polydata(mesh, solution);
    for (const int n_parts : {1, 2, 3, 7, 8, 11}) {
      for (int part = n_parts - 1; part >= 0; --part) {
        io::write_piece(path, {part, n_parts}, mesh, solution);
      }
      io::write_piece_index(path, n_parts, mesh, solution);
      vtkNew<vtkXMLPPolyDataReader> reader;
      reader->SetFileName(path.c_str());
      reader->Update();
      vtkPolyData& read = *reader->GetOutput();
      SCOPED_TRACE(std::to_string(n_parts) + " pieces");
      ASSERT_EQ(read.GetNumberOfCells(), mesh.size());
      ASSERT_EQ(read.GetCellData()->GetNumberOfArrays(), whole->GetCellData()->GetNumberOfArrays());
      for (vtkIdType i = 0; i < mesh.size(); ++i) EXPECT_EQ(corners(read, i), corners(*whole, i));
      for (int a = 0; a < whole->GetCellData()->GetNumberOfArrays(); ++a) {
        vtkDataArray& expected = *whole->GetCellData()->GetArray(a);
        vtkDataArray* const found = read.GetCellData()->GetArray(expected.GetName());
        ASSERT_NE(found, nullptr) << expected.GetName();
        EXPECT_EQ(found->GetDataType(), expected.GetDataType());
        ASSERT_EQ(found->GetNumberOfComponents(), expected.GetNumberOfComponents());
        ASSERT_EQ(found->GetNumberOfTuples(), expected.GetNumberOfTuples());
        for (vtkIdType i = 0; i < mesh.size(); ++i) {
          for (int c = 0; c < expected.GetNumberOfComponents(); ++c) {
            EXPECT_EQ(found->GetComponent(i, c), expected.GetComponent(i, c)) << expected.GetName();
          }
        }
      }
    }
  }
}

TEST_F(PvtpFile, TellsWhatCannotBeWritten) {
  const std::filesystem::path path = folder() / "nowhere" / "result.pvtp";
  const PatchMesh mesh = ribbon(2);
  const Solution solution = random_solution(mesh.size(), 1);
  EXPECT_THROW(io::write_piece(path, {0, 1}, mesh, solution), radiosity::OutputError);
  EXPECT_THROW(io::write_piece_index(path, 1, mesh, solution), radiosity::OutputError);
}

}  // namespace
