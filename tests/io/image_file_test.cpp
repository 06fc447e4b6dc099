#include "io/picture/image_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "io/picture/tone_mapping.h"
#include "radiosity/base/error.h"
#include "tests/support/output_folder.h"

namespace {

using radiosity::Image;
using radiosity::Index;

class ImageFileTest : public OutputFolder {};

/// A picture whose values all differ.
Image make_image(int width, int height, Index n_bands) {
  Image image;
  image.width = width;
  image.height = height;
  image.values.resize(Index{width} * height, n_bands);
  for (Index i = 0; i < image.values.size(); ++i) {
    image.values(i) = static_cast<float>(i) / static_cast<float>(image.values.size());
  }
  image.alpha.assign(image.values.rows(), 1);
  return image;
}

struct Png {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

Png read_png(const std::filesystem::path& path) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&header, path.c_str()), 0) << header.message;
  EXPECT_EQ(header.format, PNG_FORMAT_RGB) << "8 bits, three channels";
  Png png = {static_cast<int>(header.width), static_cast<int>(header.height),
             std::vector<std::uint8_t>(PNG_IMAGE_SIZE(header))};
  EXPECT_NE(png_image_finish_read(&header, nullptr, png.rgb.data(), 0, nullptr), 0);
  return png;
}

/// The channels of an OpenEXR file as columns, in the given order.
Eigen::MatrixXf read_exr(const std::filesystem::path& path, const std::vector<std::string>& names,
                         int width, int height) {
  Imf::InputFile file(path.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  EXPECT_EQ(window.max.x - window.min.x + 1, width);
  EXPECT_EQ(window.max.y - window.min.y + 1, height);
  std::set<std::string> found;
  for (auto channel = file.header().channels().begin(); channel != file.header().channels().end();
       ++channel) {
    EXPECT_EQ(channel.channel().type, Imf::FLOAT);
    found.insert(channel.name());
  }
  EXPECT_EQ(found, std::set<std::string>(names.begin(), names.end()));

  Eigen::MatrixXf values(Index{width} * height, static_cast<Index>(names.size()));
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < names.size(); ++c) {
    auto* pixels = reinterpret_cast<char*>(values.col(static_cast<Index>(c)).data());
    frame.insert(names[c], Imf::Slice(Imf::FLOAT, pixels, sizeof(float),
                                      sizeof(float) * static_cast<std::size_t>(width)));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return values;
}

/// sRGB of a linear value, written out again from IEC 61966-2-1.
double encode_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

TEST_F(ImageFileTest, PngHoldsTheSrgbOfEachPixel) {
  const Image image = make_image(7, 5, 3);
  constexpr double kExposure = 2;  // half of the values become white
  io::write_image(folder() / "picture.png", image, {.exposure = kExposure});

  std::array<char, 8> signature{};
  std::ifstream(folder() / "picture.png").read(signature.data(), signature.size());
  EXPECT_EQ(std::string(signature.data(), signature.size()), "\x89PNG\r\n\x1a\n");
  const Png png = read_png(folder() / "picture.png");
  ASSERT_EQ(png.width, 7);
  ASSERT_EQ(png.height, 5);
  for (Index i = 0; i < image.values.rows(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double shown = std::min(1.0, kExposure * image.values(i, c));
      EXPECT_NEAR(png.rgb[3 * i + c], 255 * encode_srgb(shown), 0.5 + 1e-9) << i << ' ' << c;
    }
  }
}

TEST_F(ImageFileTest, PngShowsOneBandAsGreyAndNothingAsBlack) {
  Image image = make_image(4, 4, 1);
  image.values.row(15).setZero();
  image.alpha[15] = 0;
  io::write_image(folder() / "picture.png", image);
  const Png png = read_png(folder() / "picture.png");
  for (int i = 0; i < 16; ++i) {
    EXPECT_EQ(png.rgb[3 * i], png.rgb[3 * i + 1]);
    EXPECT_EQ(png.rgb[3 * i], png.rgb[3 * i + 2]);
  }
  EXPECT_EQ(png.rgb[3 * 15], 0);
  EXPECT_GT(png.rgb[3 * 14], 200);
}

TEST_F(ImageFileTest, ExrReadsBackAsTheSameFloats) {
  const std::vector<std::vector<std::string>> channels = {
      {"Y"}, {"band.0", "band.1"}, {"R", "G", "B"}, {"band.0", "band.1", "band.2", "band.3"}};
  for (const auto& names : channels) {
    const Image image = make_image(9, 6, static_cast<Index>(names.size()));
    io::write_image(folder() / "picture.exr", image, {.exposure = 100});
    EXPECT_EQ(read_exr(folder() / "picture.exr", names, 9, 6), image.values);
  }
}

TEST_F(ImageFileTest, FailuresAreErrorsAndLeaveNothingBehind) {
  const Image image = make_image(64, 64, 3);
  for (const char* name : {"picture.png", "picture.exr"}) {
    EXPECT_THROW(io::write_image(folder() / "missing" / name, image), radiosity::OutputError);
    io::write_image(folder() / name, image);
    const std::size_t size = std::filesystem::file_size(folder() / name);
    std::filesystem::remove(folder() / name);
    for (const std::size_t space : {std::size_t{0}, size / 2, size - 1}) {
      const SmallDisk disk(space);
      EXPECT_THROW(io::write_image(folder() / name, image), radiosity::OutputError) << space;
    }
  }
  EXPECT_THROW(io::write_image(folder() / "picture.jpg", image), radiosity::OutputError);
  EXPECT_TRUE(file_names().empty());
}

TEST(ToneMapping, ExposureScalesInverselyWithLight) {
  const Eigen::MatrixX3f colors = io::display_colors(make_image(50, 50, 3).values);
  const double exposure = io::automatic_exposure(colors);
  EXPECT_NEAR(io::automatic_exposure(1000 * colors), exposure / 1000, 1e-6 * exposure / 1000);
  EXPECT_EQ(io::automatic_exposure(Eigen::MatrixX3f::Zero(5, 3)), 1);
}

TEST(ToneMapping, ExposureIgnoresALightAndTheDark) {
  Eigen::MatrixX3f colors = io::display_colors(make_image(100, 100, 3).values);
  colors.array() += 1;  // rows become brighter from 1 to 2
  // A light on 8 % of the pixels, of which the rim is half covered; the rest is black.
  colors.topRows(800).setConstant(1000);
  colors.middleRows(800, 50).setConstant(500);
  Eigen::MatrixX3f with_dark = Eigen::MatrixX3f::Zero(20000, 3);
  with_dark.topRows(10000) = colors;
  // What sets the exposure is among the brightest tenth of all rows, and not the light.
  const double exposure = io::automatic_exposure(with_dark);
  EXPECT_GE(exposure, io::automatic_exposure(colors.row(9999)));
  EXPECT_LE(exposure, io::automatic_exposure(colors.row(8999)));
}

TEST(ToneMapping, WavelengthsShowTheirColors) {
  const std::vector<double> wavelengths = {440, 450, 460, 540, 550, 560, 610, 620, 630};
  Eigen::MatrixXf values = Eigen::MatrixXf::Zero(3, 9);
  values.row(0).head(3).setOnes();
  values.row(1).segment(3, 3).setOnes();
  values.row(2).tail(3).setOnes();
  const Eigen::MatrixX3f colors = io::display_colors(values, wavelengths);
  for (int row = 0; row < 3; ++row) {
    Eigen::Index strongest = 0;
    colors.row(row).maxCoeff(&strongest);
    EXPECT_EQ(strongest, 2 - row) << colors;
  }
  // Spectral colours lie outside the triangle of the primaries: clipped only when encoded.
  EXPECT_LT(colors.row(1).minCoeff(), 0);
  EXPECT_EQ(io::srgb_bytes(Eigen::RowVector3f(-0.5F, 0, 1), 1),
            (std::array<std::uint8_t, 3>{0, 0, 255}));
}

TEST(ToneMapping, WhatIsNotVisibleShowsAsGrey) {
  Eigen::MatrixXf values(1, 3);
  values << 1, 2, 6;
  const Eigen::RowVector3f grey = Eigen::RowVector3f::Constant(3);
  EXPECT_EQ(io::display_colors(values, {1000, 1100, 1300}), grey);
  EXPECT_EQ(io::display_colors(values), Eigen::RowVector3f(1, 2, 6));
  EXPECT_EQ(io::display_colors(Eigen::MatrixXf::Constant(1, 1, 3), {550}), grey);
  EXPECT_EQ(io::display_colors(Eigen::MatrixXf::Constant(1, 5, 3)), grey);
}

}  // namespace
