#include "io/picture/image_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <fmt/format.h>
#include <png.h>

#include <cassert>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "io/base/atomic_file.h"
#include "io/base/extension.h"
#include "io/picture/tone_mapping.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

namespace fs = std::filesystem;
using radiosity::Image;
using radiosity::Index;
using radiosity::OutputError;

/// The names by which other programs know the bands: R, G, B, or band.0, band.1...
std::string channel_name(Index band, Index n_bands, const ImageOptions& options) {
  if (n_bands == 1) return options.channel;
  if (n_bands == 3) return std::string(1, "RGB"[band]);
  return fmt::format("band.{}", band);
}

void write_exr(const fs::path& path, const Image& image, const ImageOptions& options) {
  const Index n_bands = image.values.cols();
  Imf::Header header(image.width, image.height);
  Imf::FrameBuffer frame;
  for (Index band = 0; band < n_bands; ++band) {
    const std::string name = channel_name(band, n_bands, options);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // OpenEXR reads through this pointer only, yet wants it without const.
    auto* pixels = reinterpret_cast<char*>(const_cast<float*>(image.values.col(band).data()));
    frame.insert(name, Imf::Slice(Imf::FLOAT, pixels, sizeof(float),
                                  sizeof(float) * static_cast<std::size_t>(image.width)));
  }
  write_stream_atomically(path, [&](std::ofstream& stream) {
    try {
      Imf::StdOFStream exr_stream(stream, path.c_str());
      Imf::OutputFile file(exr_stream, header);
      file.setFrameBuffer(frame);
      file.writePixels(image.height);
    } catch (const std::exception& error) {
      throw OutputError(fmt::format("{}: cannot write: {}", path.string(), error.what()));
    }
  });
}

}  // namespace

RgbPicture srgb_picture(const Image& image, const ImageOptions& options) {
  const Eigen::MatrixX3f colors = display_colors(image.values, options.wavelengths);
  const double exposure = options.exposure ? *options.exposure : automatic_exposure(colors);
  RgbPicture picture = {image.width, image.height, {}};
  picture.bytes.reserve(3 * static_cast<std::size_t>(colors.rows()));
  for (Index i = 0; i < colors.rows(); ++i) {
    const auto pixel = srgb_bytes(colors.row(i), exposure);
    picture.bytes.insert(picture.bytes.end(), pixel.begin(), pixel.end());
  }
  return picture;
}

void write_image(const fs::path& path, const Image& image, const ImageOptions& options) {
  assert(image.values.rows() == Index{image.width} * image.height);
  const std::string extension = lower_case_extension(path);
  if (extension == ".png") {
    write_png(path, srgb_picture(image, options));
  } else if (extension == ".exr") {
    write_exr(path, image, options);
  } else {
    throw OutputError(fmt::format("{}: cannot write a picture as '{}', expected .png or .exr",
                                  path.string(), extension));
  }
}

std::vector<std::uint8_t> encode_png(const fs::path& path, const RgbPicture& picture) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(picture.width);
  header.height = static_cast<png_uint_32>(picture.height);
  header.format = PNG_FORMAT_RGB;

  std::vector<std::uint8_t> file(PNG_IMAGE_PNG_SIZE_MAX(header));
  png_alloc_size_t size = file.size();
  if (png_image_write_to_memory(&header, file.data(), &size, 0, picture.bytes.data(), 0, nullptr) ==
      0) {
    throw OutputError(fmt::format("{}: cannot encode the picture: {}", path.string(),
                                  static_cast<const char*>(header.message)));
  }
  file.resize(size);
  return file;
}

void write_png(const fs::path& path, const RgbPicture& picture) {
  const std::vector<std::uint8_t> file = encode_png(path, picture);
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream.write(reinterpret_cast<const char*>(file.data()),
                 static_cast<std::streamsize>(file.size()));
  });
}

}  // namespace io
