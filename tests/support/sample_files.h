#pragma once

#include <string>
#include <vector>

#include "tests/support/scratch_files.h"

// Small files of every format for the tests of reading.

inline const std::string kObj =
    "# a square and a triangle\r\n"
    "mtllib materials.mtl\r\n"
    "v 0 0 0\r\n"
    "v 1 0 0 0.5 0.5 0.5\r\n"
    "v 1 1 0\r\n"
    "v 0 0.8660254037844386 0\r\n"
    "vn 0 0 1\r\n"
    "o square\r\n"
    "usemtl white\r\n"
    "f 1/1/1 2//1 \\\r\n"
    "  3/2 -1\r\n"
    "o lamp\r\n"
    "usemtl lamp\r\n"
    "f 1 2 3\r\n";

inline const std::string kMtl =
    "newmtl white\nKd 0.7 0.6 0.5\nKe 0 0 0\nillum 2\nmap_Kd wood.png\n"
    "newmtl lamp\nKd 0.25\nKe 3 2 1\n";

inline const std::string kOff =
    "COFF  # colours\n\n4 2 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0\n0 0.8660254037844386 0\n"
    "4 0 1 2 3 0.5 0.5 0.5\n3 0 1 2\n";

/// A triangle and a quad of the group "hot wall", and a triangle of the surface 8.
inline const std::string kMsh2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 3 \"edge\"\n2 3 \"hot wall\"\n"
    "$EndPhysicalNames\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 1 1 0\n20 0 0 1\n21 1 0 1\n22 1 1 1\n"
    "23 0 1 1\n10 0 0 2\n11 0 1 2\n12 1 1 2\n$EndNodes\n$Elements\n5\n1 15 2 0 1 1\n"
    "2 1 2 3 4 1 2\n3 2 2 3 5 1 2 3\n4 3 2 3 5 20 21 22 23\n5 2 2 0 8 10 11 12\n$EndElements\n";

/// The same in version 4.1.
inline const std::string kMsh41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 3 \"edge\"\n2 3 \"hot wall\"\n"
    "$EndPhysicalNames\n$Entities\n1 1 2 0\n1 0 0 0 0\n4 0 0 0 1 0 0 1 3 0\n"
    "5 0 0 0 1 1 0 1 3 0\n8 0 0 2 1 1 2 0 0\n$EndEntities\n$Nodes\n2 10 1 23\n2 5 0 7\n1\n2\n3\n"
    "20\n21\n22\n23\n0 0 0\n1 0 0\n1 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n2 8 0 3\n10\n11\n12\n"
    "0 0 2\n0 1 2\n1 1 2\n$EndNodes\n$Elements\n5 5 1 5\n0 1 15 1\n1 1\n1 4 1 1\n2 1 2\n2 5 2 1\n"
    "3 1 2 3\n2 5 3 1\n4 20 21 22 23\n2 8 2 1\n5 10 11 12\n$EndElements\n";

/// The same in binary, of version 2 or 4.1.
inline std::string binary_msh(int version, std::endian order) {
  using Large = std::int64_t;
  std::string text;
  const auto put = [&](auto... values) { ((text += bytes(values, order)), ...); };
  text = std::string("$MeshFormat\n") + (version == 2 ? "2.2" : "4.1") + " 1 8\n";
  put(1);
  text +=
      "\n$EndMeshFormat\n$PhysicalNames\n2\n1 3 \"edge\"\n2 3 \"hot wall\"\n$EndPhysicalNames\n";
  const std::vector<std::array<int, 4>> nodes = {
      {1, 0, 0, 0},  {2, 1, 0, 0},  {3, 1, 1, 0},  {20, 0, 0, 1}, {21, 1, 0, 1},
      {22, 1, 1, 1}, {23, 0, 1, 1}, {10, 0, 0, 2}, {11, 0, 1, 2}, {12, 1, 1, 2}};
  const auto put_place = [&](const std::array<int, 4>& node) {
    put(double(node[1]), double(node[2]), double(node[3]));
  };
  if (version == 2) {
    text += "$Nodes\n10\n";
    for (const auto& node : nodes) {
      put(node[0]);
      put_place(node);
    }
    text += "\n$EndNodes\n$Elements\n5\n";
    put(15, 1, 2, 1, 0, 1, 1);
    put(1, 1, 2, 2, 3, 4, 1, 2);
    put(2, 1, 2, 3, 3, 5, 1, 2, 3);
    put(3, 1, 2, 4, 3, 5, 20, 21, 22, 23);
    put(2, 1, 2, 5, 0, 8, 10, 11, 12);
    return text + "\n$EndElements\n";
  }
  text += "$Entities\n";
  put(Large{1}, Large{1}, Large{2}, Large{0});
  put(1, 0., 0., 0., Large{0});
  put(4, 0., 0., 0., 1., 0., 0., Large{1}, 3, Large{2}, 1, -1);
  put(5, 0., 0., 0., 1., 1., 0., Large{1}, 3, Large{1}, 4);
  put(8, 0., 0., 2., 1., 1., 2., Large{0}, Large{0});
  text += "\n$EndEntities\n$Nodes\n";
  put(Large{2}, Large{10}, Large{1}, Large{23});
  put(2, 5, 1, Large{7});  // with parameters, which are not read
  for (int k = 0; k < 7; ++k) put(Large{nodes[k][0]});
  for (int k = 0; k < 7; ++k) {
    put_place(nodes[k]);
    put(0.5, 0.5);
  }
  put(2, 8, 0, Large{3});
  for (int k = 7; k < 10; ++k) put(Large{nodes[k][0]});
  for (int k = 7; k < 10; ++k) put_place(nodes[k]);
  text += "\n$EndNodes\n$Elements\n";
  put(Large{5}, Large{5}, Large{1}, Large{5});
  put(0, 1, 15, Large{1}, Large{1}, Large{1});
  put(1, 4, 1, Large{1}, Large{2}, Large{1}, Large{2});
  put(2, 5, 2, Large{1}, Large{3}, Large{1}, Large{2}, Large{3});
  put(2, 5, 3, Large{1}, Large{4}, Large{20}, Large{21}, Large{22}, Large{23});
  put(2, 8, 2, Large{1}, Large{5}, Large{10}, Large{11}, Large{12});
  return text + "\n$EndElements\n";
}

/// The same triangles and quad, of surfaces 3 and 8, as VTK XML; and a line.
inline const std::string kVtu = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="10" NumberOfCells="4">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 1 1 0 0 0 1 1 0 1 1 1 1 0 1 1 0 0 2 0 1 2 1 1 2
</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">
0 1 2 0 1 3 4 5 6 7 8 9
</DataArray><DataArray type="Int64" Name="offsets" format="ascii">3 5 9 12</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5 3 9 5</DataArray></Cells>
<CellData><DataArray type="Int32" Name="surface" format="ascii">3 0 3 8</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>
)";

enum class VtkValues { text, binary };

/// The same grid as a legacy VTK file, of version 4.2 or 5.1.
inline std::string legacy_vtk(int version, VtkValues kind) {
  const bool is_binary = kind == VtkValues::binary;
  const auto put = [&](const auto& values) {
    std::string text;
    for (const auto value : values) {
      text += is_binary ? bytes(value, std::endian::big) : std::to_string(value) + ' ';
    }
    return text + '\n';
  };
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1,
                                      1, 1, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 1, 1, 2};
  std::string cells;
  if (version < 5) {
    cells = "CELLS 4 16\n" +
            put(std::vector<std::int32_t>{3, 0, 1, 2, 2, 0, 1, 4, 3, 4, 5, 6, 3, 7, 8, 9});
  } else {
    cells = "CELLS 5 12\nOFFSETS vtktypeint64\n" + put(std::vector<std::int64_t>{0, 3, 5, 9, 12}) +
            "CONNECTIVITY vtktypeint64\n" +
            put(std::vector<std::int64_t>{0, 1, 2, 0, 1, 3, 4, 5, 6, 7, 8, 9});
  }
  return "# vtk DataFile Version " + std::to_string(version) + ".2\na grid\n" +
         (is_binary ? "BINARY" : "ASCII") + "\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n" +
         put(points) + cells + "CELL_TYPES 4\n" + put(std::vector<std::int32_t>{5, 3, 9, 5}) +
         "POINT_DATA 10\nSCALARS height double 1\nLOOKUP_TABLE default\n" +
         put(std::vector<double>(10, 0.5)) +
         "CELL_DATA 4\nFIELD FieldData 2\nheat%20flux 1 4 float\n" +
         put(std::vector<float>(4, 0.25F)) + "METADATA\nINFORMATION 0\n\nsurface 1 4 int\n" +
         put(std::vector<std::int32_t>{3, 0, 3, 8});
}

inline const std::string kPlyHeader =
    "element material 1\nproperty uchar shininess\nproperty list uchar int maps\n"
    "element vertex 4\nproperty float quality\nproperty double x\nproperty double y\n"
    "property double z\n"
    "element face 2\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n";

inline const std::string kAsciiPly =
    "ply\nformat ascii 1.0\ncomment made by hand\n" + kPlyHeader +
    "7 2 5 6\n0 0 0 0\n0 1 0 0\n0 1 1 0\n0 0 0.8660254037844386 0\n0 4 0 1 2 3\n0 3 0 1 2\n";

inline std::string binary_ply(std::endian order) {
  std::string text = "ply\nformat binary_";
  text += order == std::endian::little ? "little" : "big";
  text += "_endian 1.0\n" + kPlyHeader;
  text += bytes<std::uint8_t>(7) + bytes<std::uint8_t>(2) + bytes(5, order) + bytes(6, order);
  for (const auto& [x, y] :
       {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 0.8660254037844386}}) {
    text += bytes(0.5F, order) + bytes(x, order) + bytes(y, order) + bytes(0.0, order);
  }
  for (const std::vector<int>& face : {std::vector{0, 1, 2, 3}, std::vector{0, 1, 2}}) {
    text += bytes<std::uint8_t>(1) + bytes(static_cast<std::uint8_t>(face.size()));
    for (const int index : face) text += bytes(index, order);
  }
  return text;
}

inline const std::string kAsciiStl =
    "solid left wall\n"
    " facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
    "   vertex 1 0.8660254037844386 0\n  endloop\n endfacet\n"
    " facet normal 0 0 1\n  outer loop\n   vertex -0 0 0\n   vertex 1 0.8660254037844386 0\n"
    "   vertex 0 1 0\n  endloop\n endfacet\n"
    "endsolid left wall\n"
    "solid right\n"
    " facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1 1 2\n"
    "  endloop\n endfacet\n"
    "endsolid\n";

/// Two triangles of a unit square.
inline std::string binary_stl() {
  std::string text(80, ' ');
  text.replace(0, 5, "solid");  // as some programs write, though the file is not ascii
  text += bytes<std::uint32_t>(2);
  for (const auto& triangle : {std::array{0, 0, 1, 0, 1, 1}, std::array{0, 0, 1, 1, 0, 1}}) {
    text += bytes(0.0F) + bytes(0.0F) + bytes(1.0F);
    for (int k = 0; k < 3; ++k) {
      text += bytes(static_cast<float>(triangle[2 * k])) +
              bytes(static_cast<float>(triangle[2 * k + 1])) + bytes(0.0F);
    }
    text += bytes<std::uint16_t>(0);
  }
  return text;
}

/// A triangle in three nodes: moved by x = 10, mirrored in x, and without a material.
inline std::string gltf_json(const std::string& buffer) {
  return R"({"asset": {"version": "2.0"},
"extensionsUsed": ["KHR_materials_emissive_strength"],
"scene": 0, "scenes": [{"nodes": [0, 1, 3]}],
"nodes": [{"name": "moved", "mesh": 0, "translation": [10, 0, 0]},
          {"name": "parent", "scale": [-1, 1, 1], "children": [2]},
          {"name": "mirrored", "mesh": 0},
          {"name": "moved", "mesh": 1}],
"meshes": [{"name": "triangle", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
            "material": 0}]},
           {"name": "plain", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
"materials": [{"name": "glow", "doubleSided": true, "emissiveFactor": [1, 0.5, 0.25],
  "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}},
  "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.75, 1]}}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
               "min": [0, 0, 0], "max": [1, 1, 0]},
              {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
"buffers": [{)" +
         buffer + R"("byteLength": 44}]})";
}

inline std::string gltf_buffer() {
  std::string data;
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) data += bytes(x);
  for (const int index : {0, 1, 2, 0}) data += bytes(static_cast<std::uint16_t>(index));
  return data;
}

inline std::string glb() {
  std::string json = gltf_json("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string data = gltf_buffer();
  const auto size = static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size());
  return "glTF" + bytes<std::uint32_t>(2) + bytes(size) +
         bytes(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
         bytes(static_cast<std::uint32_t>(data.size())) + std::string("BIN\0", 4) + data;
}

inline const std::string kCsv =
    "# measured\nwavelength_nm, white, red\n400, 0.5, 0.1\n500, 0.7, 0.2\n600, 0.8, 0.6\n";

inline const std::string kJson = R"({
  "unit": "mm",
  "bands": [400, 450, 600],
  "materials": {
    "white": {"reflectance": {"csv": "spectra.csv", "column": "white"}},
    "lamp": {"reflectance": 0.5, "emission": {"radiance": [1, 2, 3]}}
  },
  "surfaces": [
    {"name": "floor", "material": "white", "polygons": [[[0, 0, 0], [2, 0, 0], [2, 3, 0]]]},
    {"name": "lamp", "material": "lamp", "two_sided": true,
     "vertices": [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], "polygons": [[0, 1, 2, 3]]},
    {"name": "mesh", "material": "white", "mesh": "square.off", "unit": "m",
     "transform": {"scale": 2, "translate": [0, 0, 500]}}
  ],
  "camera": {"position": [0, 0, 100], "look_at": [0, 0, 0], "vertical_fov_deg": 90},
  "closed": false
}
)";

/// An opened box: a floor with a part and a hole, a wall in two combined halves, an obstruction.
inline const std::string kVs3 =
    "T a room / with a window\r\nC encl=0, emit=1 eps 1e-4 out=0\nF 3 ! vertices\n! a comment\n"
    "V 1 0 0 0\nV 2 4 0 0\nV 3 4 3 0\nV 4 0 3 0\nV 5 1 1 0\nV 6 2 1 0\nV 7 2 2 0\nV 8 1 2 0\n"
    "V 9 3 1 0\nV 10 3.5 1 0\nV 11 3.5 2 0\nV 12 3 2 0\nV 13 0 0 2\nV 14 4 0 2\nV 15 2 0 0\n"
    "V 16 2 0 2\nV 17 1 1 1\nV 18 2 1 1\nV 19 2 2 1\n"
    "S 1 1 2 3 4 0 0 0.9 floor\nS 2 5 6 7 8 1 0 0.5 part\nN 3 12 11 10 9 1 0 0.5 hole\n"
    "s 4 1 13 16 15 0 0 0.7 wall\nS 5 15 16 14 2 0 4 0.7 half\nO 6 17 18 19 0\nEnd of data\n"
    "what follows is no part of it\n";

/// A wall with a window, and its like in JSON.
inline const std::string kIdf =
    "GlobalGeometryRules, UpperLeftCorner, Counterclockwise, Relative; ! rules\n"
    "Zone, Office, 30, 1, 2, 3;\nMaterial, Plaster, Smooth, .02, .6, 1200, 1000, 0.8;\n"
    "Construction, Wall, Brick, Plaster;\nBuildingSurface:Detailed, Front, Wall, Wall, Office, ,\n"
    "Outdoors, , SunExposed, WindExposed, 0.5, 4, 0,0,3, 0,0,0, 4,0,0, 4,0,3;\n"
    "FenestrationSurface:Detailed, W, Window, Glass, Front, , 0.5, , 1, 4,\n"
    "1,0,2, 1,0,1, 2,0,1, 2,0,2;\n";
inline const std::string kEpJson = R"({"GlobalGeometryRules": {"r": {"vertex_entry_direction":
  "Counterclockwise", "coordinate_system": "World"}}, "Zone": {"Office": {"x_origin": 1}},
  "Material": {"Plaster": {"thermal_absorptance": 0.8}},
  "Construction": {"Wall": {"outside_layer": "Plaster"}},
  "BuildingSurface:Detailed": {"Front": {"construction_name": "Wall", "zone_name": "Office",
  "vertices": [{"vertex_x_coordinate": 0, "vertex_y_coordinate": 0, "vertex_z_coordinate": 3},
  {"vertex_x_coordinate": 0, "vertex_y_coordinate": 0, "vertex_z_coordinate": 0},
  {"vertex_x_coordinate": 4, "vertex_y_coordinate": 0, "vertex_z_coordinate": 0}]}}})";

/// The boundary of a case of OpenFOAM: a square and a triangle that radiate.
inline const std::string kFoamBoundary =
    "FoamFile { version 2.0; format ascii; class polyBoundaryMesh; object boundary; }\n"
    "2 ( wall { type wall; inGroups 2(viewFactorWall wall); nFaces 2; startFace 0; }\n"
    "inlet { type patch; nFaces 1; startFace 2; } )\n";
inline const std::string kFoamFaces =
    "/* head */ FoamFile { format ascii; class faceList; }\n3(4(0 1 2 3) 3(0 1 4) // one\n3(1 2 "
    "4))\n";
inline const std::string kFoamPoints =
    "FoamFile { format ascii; class vectorField; }\n5 ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 "
    "1e0))\n";

/// Two squares of a box and a triangle, as planes.
inline const std::string kVs3a =
    "F 3a\nS 1 R 0 0 0.90 south\n 3. 0. 0. 0 90  3. 3.\nS 2 Q 0 0 0.90 ceiling\n 3. 0. 3. 0 180\n"
    " 2. 0.  3. 0.  3. 1.  2. 1.\nO 3 T\n 0 0 0 180 0  0 0 1 0\n 1 1\n*\n";
