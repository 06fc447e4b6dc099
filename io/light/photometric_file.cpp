#include "io/light/photometric_file.h"

#include <fmt/format.h>

#include <cmath>

#include "io/base/extension.h"
#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/light/ies_reader.h"
#include "io/light/ldt_reader.h"

namespace io {
namespace {

using radiosity::kPi;
using radiosity::Photometry;

/// More light than the lamps give by this share is no rounding.
constexpr double kTooMuch = 1.05;
constexpr double kAngleRounding = 1e-9;  // radian

void add_warning(const std::string& message, Photometry& photometry) {
  photometry.warnings.push_back(
      fmt::format("{}: {}", printable(photometry.file.string()), message));
}

/// Light that the angles leave out: they should end along the axis, level or behind.
void warn_of_angles(Photometry& photometry) {
  if (photometry.web.type != radiosity::PhotometricWeb::Type::c) return;
  const auto is_one_of = [](double angle, double a, double b) {
    return std::abs(angle - a) < kAngleRounding || std::abs(angle - b) < kAngleRounding;
  };
  const double first = photometry.web.polar.front();
  const double last = photometry.web.polar.back();
  if (is_one_of(first, 0, kPi / 2) && is_one_of(last, kPi / 2, kPi)) return;
  add_warning(fmt::format("vertical angles are from {:g} to {:g}, expected 0 or 90 to 90 or 180; "
                          "there is no light beyond",
                          first * 180 / kPi, last * 180 / kPi),
              photometry);
}

}  // namespace

bool is_photometric_file(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  return extension == ".ies" || extension == ".ldt";
}

Photometry read_photometric_file(const std::filesystem::path& path,
                                 const radiosity::Progress& progress) {
  if (!is_photometric_file(path)) fail(path, "expected a photometric file, .ies or .ldt");
  Photometry photometry =
      lower_case_extension(path) == ".ies" ? read_ies(path, progress) : read_ldt(path, progress);
  const double flux = radiosity::flux(photometry.web);
  if (!std::isfinite(flux)) fail(path, "its intensities are too large for numbers");
  if (!(flux > 0)) fail(path, "gives no light: all its intensities are 0");
  if (photometry.lamp_flux > 0 && flux > kTooMuch * photometry.lamp_flux) {
    add_warning(fmt::format("its intensities add up to {:.6g} lm, more than the {:.6g} lm of its "
                            "lamps",
                            flux, photometry.lamp_flux),
                photometry);
  }
  warn_of_angles(photometry);
  return photometry;
}

}  // namespace io
