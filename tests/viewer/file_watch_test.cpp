// Files that change on disk while they are open.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/output_folder.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"
#include "viewer/work/file_watch.h"

namespace {

using namespace radiosity::test;
namespace fs = std::filesystem;

class ChangedFiles : public OutputFolder {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    const fs::path path = folder() / name;
    std::ofstream(path) << text;
    return path;
  }

  /// A plate so long, in cm, of a material of another file.
  std::string write_plate(int length) const {
    const std::string x = std::to_string(length);
    return write("plate.obj", "mtllib paint.mtl\nusemtl paint\nv 0 0 0\nv " + x + " 0 0\nv " + x +
                                  " 100 0\nv 0 100 0\nf 1 2 3 4\n");
  }

  static void wait_for(viewer::Desk& desk, const std::function<bool()>& is_done) {
    wait_until(desk.session, [&] {
      viewer::update(desk);
      return is_done();
    });
  }

  static bool is_announced(const viewer::Desk& desk) {
    const auto& messages = desk.session.messages();
    return std::any_of(messages.begin(), messages.end(), [](const viewer::Message& message) {
      return message.is_about_file && !message.is_past;
    });
  }
};

TEST_F(ChangedFiles, AreAnnouncedAndReadAgainFromWhereTheyAreSeen) {
  write("paint.mtl", "newmtl paint\nKd 0.5 0.5 0.5\n");
  const std::string plate = write_plate(100);
  viewer::Desk desk(coarse(), {.unit = "cm"});
  desk.session.open(plate);
  wait_for(desk, [&] { return desk.session.is_open() && desk.session.is_idle(); });
  EXPECT_FALSE(desk.session.changed_file());
  desk.camera.orbit(0.3, 0.2);
  desk.look.smooth = false;
  const radiosity::Vec3 direction = desk.camera.camera().direction;

  write_plate(300);
  wait_for(desk, [&] { return is_announced(desk); });
  EXPECT_EQ(desk.session.changed_file(), plate);
  EXPECT_NEAR(desk.session.model().bounds.sizes().x(), 1, 1e-6);  // not before one wants it
  viewer::reload(desk);
  wait_for(desk, [&] { return desk.session.versions().file == 2; });
  EXPECT_NEAR(desk.session.model().bounds.sizes().x(), 3, 1e-6);
  EXPECT_FALSE(desk.session.changed_file());
  EXPECT_FALSE(is_announced(desk));
  EXPECT_LE((desk.camera.camera().direction - direction).norm(), 1e-9);

  // A file that it refers to is as good as itself.
  const std::string paint = write("paint.mtl", "newmtl paint\nKd 0.25 0.25 0.25\n");
  wait_for(desk, [&] { return is_announced(desk); });
  EXPECT_EQ(desk.session.changed_file(), paint);
}

// What cannot be read leaves all as it is, and is announced again once it is written again.
TEST_F(ChangedFiles, MayBeBrokenForAWhile) {
  write("paint.mtl", "newmtl paint\nKd 0.5 0.5 0.5\n");
  const std::string plate = write_plate(100);
  viewer::Desk desk(coarse());
  desk.session.open(plate);
  wait_for(desk, [&] { return desk.session.is_open() && desk.session.is_idle(); });
  fs::remove(plate);
  write("plate.obj", "v 1 2\n");
  wait_for(desk, [&] { return is_announced(desk); });
  desk.session.clear_messages();
  viewer::reload(desk);
  wait_for(desk, [&] { return !desk.session.messages().empty() && desk.session.is_idle(); });
  EXPECT_TRUE(desk.session.messages().back().is_error);
  EXPECT_EQ(desk.session.versions().file, 1);
  EXPECT_NEAR(desk.session.model().bounds.sizes().x(), 100, 1e-6);
  write_plate(200);
  wait_for(desk, [&] { return is_announced(desk); });
  viewer::reload(desk);
  wait_for(desk, [&] { return desk.session.versions().file == 2; });
  EXPECT_NEAR(desk.session.model().bounds.sizes().x(), 200, 1e-6);
}

TEST_F(ChangedFiles, AreThoseWithAnotherStamp) {
  const fs::path file = write("a.txt", "one");
  const auto before = viewer::file_stamps({file, folder() / "none.txt", file, folder()});
  ASSERT_EQ(before.size(), 1U);
  EXPECT_EQ(before, viewer::file_stamps({file}));
  fs::last_write_time(file, before[0].written + std::chrono::seconds(2));
  EXPECT_NE(before, viewer::file_stamps({file}));
  viewer::Desk desk;
  EXPECT_THROW(viewer::reload(desk), std::exception);
}

}  // namespace
