#include "io/picture/text_raster.h"

#include <fmt/format.h>
#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "radiosity/base/error.h"

namespace io {
namespace {

constexpr int kPixelsPerInch = 72;  // so that VTK's points are pixels
constexpr std::string_view kSquared = "²";
constexpr double kSuperscriptSize = 0.7;

TextRaster rasterize_ascii(const std::string& text, int size) {
  if (text.empty()) return {};
  vtkNew<vtkTextProperty> property;
  property->SetFontSize(size);
  vtkNew<vtkImageData> image;
  std::array<int, 2> dimensions{};
  if (!vtkFreeTypeTools::GetInstance()->RenderString(property, vtkStdString(text), kPixelsPerInch,
                                                     image, dimensions.data())) {
    throw radiosity::OutputError(fmt::format("VTK cannot draw the text \"{}\"", text));
  }
  const auto [width, height] = dimensions;
  TextRaster raster = {width, height, {}};
  for (int y = height - 1; y >= 0; --y) {  // VTK counts rows from the bottom
    for (int x = 0; x < width; ++x) {
      constexpr int kAlpha = 3;
      raster.coverage.push_back(
          static_cast<std::uint8_t>(image->GetScalarComponentAsDouble(x, y, 0, kAlpha)));
    }
  }
  return raster;
}

/// Both beside each other, their tops at one height.
TextRaster beside(const TextRaster& left, const TextRaster& right) {
  TextRaster both = {left.width + right.width, std::max(left.height, right.height), {}};
  both.coverage.assign(static_cast<std::size_t>(both.width) * both.height, 0);
  const auto put = [&](const TextRaster& part, int first_column) {
    for (int y = 0; y < part.height; ++y) {
      std::copy_n(part.coverage.begin() + y * part.width, part.width,
                  both.coverage.begin() + y * both.width + first_column);
    }
  };
  put(left, 0);
  put(right, left.width);
  return both;
}

}  // namespace

TextRaster rasterize(const std::string& text, int size) {
  // VTK's font has no raised two.
  const auto squared = text.find(kSquared);
  if (squared == std::string::npos) return rasterize_ascii(text, size);
  const int small = static_cast<int>(std::lround(kSuperscriptSize * size));
  const TextRaster head =
      beside(rasterize_ascii(text.substr(0, squared), size), rasterize_ascii("2", small));
  return beside(head, rasterize(text.substr(squared + kSquared.size()), size));
}

}  // namespace io
