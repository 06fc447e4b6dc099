#include "io/picture/false_color.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/picture/color_bar.h"
#include "io/picture/text_raster.h"
#include "tests/support/output_folder.h"

namespace {

using io::Rgb;
using io::RgbPicture;
using radiosity::Image;
using radiosity::Index;

constexpr Rgb kWhite = {255, 255, 255};

Rgb pixel(const RgbPicture& picture, int x, int y) {
  const auto first = picture.bytes.begin() + 3 * (y * picture.width + x);
  return {first[0], first[1], first[2]};
}

RgbPicture read_picture(const std::filesystem::path& path) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&header, path.c_str()), 0) << header.message;
  RgbPicture picture = {static_cast<int>(header.width), static_cast<int>(header.height), {}};
  picture.bytes.resize(PNG_IMAGE_SIZE(header));
  EXPECT_NE(png_image_finish_read(&header, nullptr, picture.bytes.data(), 0, nullptr), 0);
  return picture;
}

RgbPicture plain_picture(int width, int height, const Rgb& color) {
  RgbPicture picture = {width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    picture.bytes.insert(picture.bytes.end(), color.begin(), color.end());
  }
  return picture;
}

TEST(TextRaster, DrawsLettersOfOneHeight) {
  const io::TextRaster text = io::rasterize("lux", 16);
  ASSERT_EQ(text.coverage.size(), static_cast<std::size_t>(text.width * text.height));
  EXPECT_EQ(*std::max_element(text.coverage.begin(), text.coverage.end()), 255);
  EXPECT_EQ(io::rasterize("Wqj(|", 16).height, text.height);
  EXPECT_GT(io::rasterize("lux lux", 16).width, 2 * text.width);
  EXPECT_GT(io::rasterize("lux", 32).height, 1.5 * text.height);
}

TEST(TextRaster, RaisesTheTwoOfASquare) {
  const io::TextRaster plain = io::rasterize("m", 20);
  const io::TextRaster squared = io::rasterize("m²", 20);
  EXPECT_EQ(squared.height, plain.height);
  ASSERT_GT(squared.width, plain.width);
  int lowest = 0;  // row of the two's foot
  for (int y = 0; y < squared.height; ++y) {
    for (int x = plain.width; x < squared.width; ++x) {
      if (squared.coverage[y * squared.width + x] > 128) lowest = y;
    }
  }
  EXPECT_GT(lowest, 0);
  EXPECT_LT(lowest, 0.65 * squared.height);  // the line the letters stand on is at 0.77
}

/// Heights of the blocks of ink in these columns, from top to bottom.
std::vector<int> ink_blocks(const RgbPicture& sheet, int first_column) {
  std::vector<int> blocks;
  bool inside = false;
  for (int y = 0; y < sheet.height; ++y) {
    bool ink = false;
    for (int x = first_column; x < sheet.width; ++x) ink |= pixel(sheet, x, y) != kWhite;
    if (ink && !inside) blocks.push_back(0);
    if (ink) ++blocks.back();
    inside = ink;
  }
  return blocks;
}

// Whatever the size: the picture stays as it is, nothing touches the border, and the lines of the
// title and the labels do not run into each other.
TEST(ColorBar, FitsBesideAnyPicture) {
  for (const int height : {128, 200, 256, 512, 768, 2160}) {
    for (const bool logarithmic : {false, true}) {
      SCOPED_TRACE(height);
      const RgbPicture picture = plain_picture(130, height, {9, 8, 7});
      const RgbPicture sheet =
          io::add_color_bar(picture, {.scale = {2e-5, 5e-3, logarithmic},
                                      .title = {"luminous exitance", "W/(m² sr nm)", "mean"},
                                      .has_below = true,
                                      .has_above = true});
      ASSERT_EQ(sheet.height, height);
      for (int y = 0; y < height; ++y) {
        EXPECT_EQ(pixel(sheet, 129, y), (Rgb{9, 8, 7}));
        for (const int x : {130, 131, 132, sheet.width - 3, sheet.width - 1}) {
          ASSERT_EQ(pixel(sheet, x, y), kWhite) << x << ' ' << y;
        }
      }
      for (int x = 130; x < sheet.width; ++x) {
        for (const int y : {0, 1, height - 2, height - 1}) ASSERT_EQ(pixel(sheet, x, y), kWhite);
      }
      const int text_size = std::clamp(height / 32, 11, 28);
      // Right of the bar and its ticks: parts of the title, then labels.
      const int labels = 130 + text_size / 2 + 2 + 2 * text_size + text_size / 3;
      const std::vector<int> blocks = ink_blocks(sheet, labels);
      EXPECT_GE(blocks.size(), 4U);  // two lines of title reach so far, and two labels or more
      for (const int block : blocks)
        EXPECT_LE(block, 1.1 * text_size) << testing::PrintToString(blocks);
      EXPECT_LT(sheet.width - 130, 12 * text_size);
    }
  }
}

TEST(ColorBar, DoesNotMindTinyPictures) {
  for (const int height : {1, 5, 40}) {
    const RgbPicture sheet =
        io::add_color_bar(plain_picture(3, height, {0, 0, 0}), {.scale = {}, .title = {"a", "b"}});
    EXPECT_EQ(sheet.bytes.size(), static_cast<std::size_t>(3 * sheet.width * height));
  }
}

TEST(TickLabels, AreShort) {
  EXPECT_EQ(io::tick_label(0), "0");
  EXPECT_EQ(io::tick_label(-0.0), "0");
  EXPECT_EQ(io::tick_label(3 * 0.1), "0.3");
  EXPECT_EQ(io::tick_label(1500), "1500");
  EXPECT_EQ(io::tick_label(2e6), "2e6");
  EXPECT_EQ(io::tick_label(5e-7), "5e-7");
  EXPECT_EQ(io::tick_label(-20), "-20");
}

class FalseColorTest : public OutputFolder {
 protected:
  /// Values 0, 1, 2 ... with every fourth pixel half covered, and the last one not at all.
  static Image ramp(int width, int height) {
    Image image = {.width = width, .height = height, .values = {}, .alpha = {}};
    image.values.resize(Index{width} * height, 1);
    for (Index i = 0; i < image.values.rows(); ++i) {
      image.alpha.push_back(i % 4 == 3 ? 0.5F : 1.0F);
      image.values(i, 0) = image.alpha.back() * static_cast<float>(i);
    }
    image.alpha.back() = 0;
    image.values(image.values.rows() - 1, 0) = 0;
    return image;
  }
};

TEST_F(FalseColorTest, PngShowsEachValueByItsColor) {
  const Image image = ramp(20, 150);
  const io::ColorScale scale = {.low = 500, .high = 2500, .logarithmic = false};
  io::write_false_color(folder() / "a.png", image, {.title = {"ramp"}, .scale = scale});
  const RgbPicture png = read_picture(folder() / "a.png");
  ASSERT_EQ(png.height, 150);
  ASSERT_GT(png.width, 40);
  for (int i = 0; i < 2999; ++i) {
    const Rgb expected = io::map_color((i - 500) / 2000.0);
    const Rgb found = pixel(png, i % 20, i / 20);
    for (std::size_t c = 0; c < 3; ++c) {
      const double blended = i % 4 == 3 ? 0.5 * expected[c] + 0.5 * 200 : expected[c];
      EXPECT_NEAR(found[c], blended, 1) << i;
    }
  }
  EXPECT_EQ(pixel(png, 19, 149), (Rgb{200, 200, 200}));
}

TEST_F(FalseColorTest, ScaleFitsWhatIsSeen) {
  const io::ColorScale scale = io::write_false_color(folder() / "a.png", ramp(20, 150));
  EXPECT_EQ(scale.low, 0);
  EXPECT_EQ(scale.high, 3000);
  const io::ColorScale log =
      io::write_false_color(folder() / "a.png", ramp(20, 150), {.logarithmic = true});
  EXPECT_EQ(log.low, 1);
  EXPECT_EQ(log.high, 5000);
}

TEST_F(FalseColorTest, ExrHoldsTheValues) {
  const Image image = ramp(20, 15);
  io::write_false_color(folder() / "a.exr", image, {.channel = "illuminance"});
  Imf::InputFile file((folder() / "a.exr").c_str());
  ASSERT_NE(file.header().channels().findChannel("illuminance"), nullptr);
  std::vector<float> values(300);
  Imf::FrameBuffer frame;
  frame.insert("illuminance", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                         sizeof(float), 20 * sizeof(float)));
  file.setFrameBuffer(frame);
  file.readPixels(0, 14);
  EXPECT_TRUE(std::equal(values.begin(), values.end(), image.values.data()));
}

}  // namespace
