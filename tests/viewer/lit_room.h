#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity::test {

/// A room with an opening in its ceiling, a lamp that is a patch and two luminaires of a file, one
/// hanging, one aimed; turned and moved as a whole.
struct LitRoom {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 origin = Vec3::Zero();
  Vec3 size = Vec3(4, 3, 2.5);
  double reflectance = 0.5;
  bool has_daylight = false;
  int sky_type = 5;                                ///< uniform, which is quick
  double dimming = 1;                              ///< of the first luminaire
  nlohmann::json more = nlohmann::json::object();  ///< other keys of the scene

  [[nodiscard]] Vec3 at(double x, double y, double z) const {
    return origin + turn * Vec3(x * size.x(), y * size.y(), z * size.z());
  }
  [[nodiscard]] Vec3 up() const { return turn.col(2); }
  [[nodiscard]] Vec3 first() const { return at(0.3, 0.4, 0.9); }
  [[nodiscard]] Vec3 second() const { return at(0.7, 0.5, 0.8); }

  /// Writes it with its photometric file, 800 cd straight down; returns the scene's path.
  [[nodiscard]] std::filesystem::path write(const std::filesystem::path& folder) const;
};

inline nlohmann::json numbers(const Vec3& x) { return {x[0], x[1], x[2]}; }

inline std::filesystem::path LitRoom::write(const std::filesystem::path& folder) const {
  using nlohmann::json;
  std::ofstream(folder / "spot.ies") << "IESNA:LM-63-2002\nTILT=NONE\n"
                                        "1 -1 1 5 1 1 2 0.3 0.6 0\n1 1 10\n"
                                        "0 22.5 45 67.5 90\n0\n800 700 500 250 0\n";
  const auto quad = [&](std::vector<Vec3> corners) {
    json polygon = json::array();
    for (const Vec3& c : corners) polygon.push_back(numbers(at(c[0], c[1], c[2])));
    return polygon;
  };
  const json walls = {quad({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}),
                      quad({{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}),
                      quad({{1, 1, 0}, {1, 1, 1}, {0, 1, 1}, {0, 1, 0}}),
                      quad({{0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {0, 0, 0}})};
  json scene = {
      {"bands", "rgb"},
      {"materials",
       {{"paint", {{"reflectance", reflectance}}},
        {"glow", {{"reflectance", 0.3}, {"radiance", {6, 5, 4}}}}}},
      {"surfaces",
       {{{"name", "floor"},
         {"material", "paint"},
         {"polygons", {quad({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})}}},
        {{"name", "ceiling"},
         {"material", "paint"},
         {"polygons", {quad({{0, 0, 1}, {0, 1, 1}, {0.8, 1, 1}, {0.8, 0, 1}})}}},
        {{"name", "walls"}, {"material", "paint"}, {"polygons", walls}},
        {{"name", "lamp"},
         {"material", "glow"},
         {"polygons",
          {quad({{0.1, 0.7, 0.95}, {0.1, 0.9, 0.95}, {0.3, 0.9, 0.95}, {0.3, 0.7, 0.95}})}}}}},
      {"luminaires",
       {{{"name", "pendant"},
         {"file", "spot.ies"},
         {"position", numbers(first())},
         {"direction", numbers(-up())},
         {"up", numbers(up())},
         {"points", {1, 1}},
         {"dimming", dimming}},
        {{"name", "spot"},
         {"file", "spot.ies"},
         {"position", numbers(second())},
         {"aim", numbers(at(0.2, 0.3, 0))},
         {"up", numbers(up())},
         {"lumens", 900}}}}};
  if (has_daylight) {
    scene["sun"] = {{"direction", numbers((turn * Vec3(-0.3, 0.2, -1)).normalized())},
                    {"irradiance", 300}};
    scene["sky"] = {{"type", sky_type},
                    {"up", numbers(up())},
                    {"horizontal_illuminance", 8000},
                    {"ground_reflectance", 0.3}};
  }
  scene.update(more);
  std::ofstream(folder / "room.json") << scene;
  return folder / "room.json";
}

/// Such rooms of other sizes, turned and moved otherwise.
inline std::vector<LitRoom> lit_rooms() {
  const Eigen::Matrix3d turned =
      (Eigen::AngleAxisd(0.7, Vec3::UnitZ()) * Eigen::AngleAxisd(0.4, Vec3::UnitX()))
          .toRotationMatrix();
  std::vector<LitRoom> rooms(3);
  rooms[1].has_daylight = true;
  rooms[1].dimming = 0.4;
  rooms[2].has_daylight = true;
  rooms[2].turn = turned;
  rooms[2].origin = Vec3(-20, 7, 3);
  rooms[2].size = Vec3(7, 9, 3);
  return rooms;
}

}  // namespace radiosity::test
