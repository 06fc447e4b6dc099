#include "io/light/ies_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/light/number_stream.h"
#include "io/light/web_planes.h"

namespace io {
namespace {

using radiosity::Index;
using radiosity::PhotometricWeb;
using radiosity::Photometry;

constexpr double kFoot = 0.3048;  // m

/// What follows a keyword in brackets, if the line starts with it.
void take_keyword(std::string_view line, std::string_view keyword, std::string& text) {
  if (!text.empty() || !line.starts_with(keyword)) return;
  text = printable(std::string(trimmed(line.substr(keyword.size()))));
}

/// Whether a word is another in capitals, whatever it is in.
bool is_word(std::string_view word, std::string_view capitals) {
  return std::equal(word.begin(), word.end(), capitals.begin(), capitals.end(),
                    [](char a, char b) { return (a >= 'a' && a <= 'z' ? a - 'a' + 'A' : a) == b; });
}

/// Lines up to TILT=; returns what that is.
std::string read_labels(LineReader& lines, Photometry& photometry) {
  constexpr std::string_view kTilt = "TILT=";
  photometry.format = "IES LM-63-1986";
  for (bool is_first = true; lines.next_line(); is_first = false) {
    const std::string_view line = trimmed(lines.line());
    if (line.starts_with("IES")) lines.recognise();
    if (is_first && line.starts_with("IES")) {
      const auto colon = line.find(':');
      const bool is_named = colon != std::string_view::npos;
      photometry.format =
          "IES " + printable(std::string(is_named ? line.substr(colon + 1) : "LM-63-1991"));
    }
    if (is_word(line.substr(0, kTilt.size()), kTilt)) {
      lines.recognise();
      return std::string(trimmed(line.substr(kTilt.size())));
    }
    take_keyword(line, "[LUMINAIRE]", photometry.name);
    take_keyword(line, "[MANUFAC]", photometry.maker);
  }
  lines.fail("has no line that starts with TILT=, expected one in an IES file");
}

radiosity::LampTilt read_tilt_table(NumberStream& numbers) {
  constexpr long kMostTilts = 1000;
  radiosity::LampTilt tilt;
  tilt.position =
      static_cast<int>(numbers.next_count("the lamp's position to the luminaire", 1, 3));
  const long n = numbers.next_count("the number of tilt angles", 1, kMostTilts);
  tilt.angles = numbers.next_list("tilt angle", n);
  const std::string problem = angle_problem("tilt", tilt.angles, 0, 180);
  if (!problem.empty()) numbers.fail(problem);
  for (double& angle : tilt.angles) angle *= radiosity::kPi / 180;
  tilt.factors = numbers.next_list("tilt factor", n);
  for (const double factor : tilt.factors) {
    if (!(factor >= 0)) numbers.fail(fmt::format("tilt factor {} is negative", factor));
  }
  return tilt;
}

void read_tilt(const std::string& tilt, LineReader& lines, NumberStream& numbers,
               const std::filesystem::path& path, const radiosity::Progress& progress,
               Photometry& photometry) {
  if (is_word(tilt, "NONE")) return;
  if (is_word(tilt, "INCLUDE")) {
    photometry.tilt = read_tilt_table(numbers);
    return;
  }
  if (tilt.empty()) lines.fail("TILT= is empty, expected NONE, INCLUDE or a file");
  const std::filesystem::path file = path.parent_path() / tilt;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    lines.fail(fmt::format("the file {} of TILT is not there", lines.shown(tilt)));
  }
  LineReader other(file, progress);
  NumberStream table(other);
  photometry.tilt = read_tilt_table(table);
}

double more_than_zero(NumberStream& numbers, std::string_view what) {
  const double value = numbers.next(what);
  if (!(value > 0)) numbers.fail(fmt::format("{} is {}, expected more than 0", what, value));
  return value;
}

/// Width, length and height of the luminous opening; negative: round.
void read_opening(NumberStream& numbers, double unit, Photometry& photometry) {
  const double width = numbers.next("the width");
  const double length = numbers.next("the length");
  const double height = numbers.next("the height");
  photometry.is_round = width < 0 || length < 0;
  photometry.along_c0 = unit * std::abs(length);
  photometry.along_c90 = unit * std::abs(width);
  photometry.height = unit * std::abs(height);
}

/// The horizontal angles of type C all around, by what the last one tells.
void unfold_c(NumberStream& numbers, const std::filesystem::path& path, GivenPlanes& given,
              Photometry& photometry) {
  const double first = given.planes.front();
  const double last = given.planes.back();
  if (first == 90 && last == 270) {
    mirror_planes(180, given);
    return;
  }
  if (first != 0) {
    numbers.fail(
        fmt::format("horizontal angles from {} to {}, expected them to begin at 0, or to "
                    "be from 90 to 270",
                    first, last));
  }
  if (last == 0) return;
  if (last == 90) mirror_planes(180, given);
  if (last == 90 || last == 180) {
    mirror_planes(360, given);
    return;
  }
  if (last == 360) return;
  if (last < 180) {
    numbers.fail(fmt::format("the last horizontal angle is {}, expected 0, 90, 180 or 360", last));
  }
  photometry.warnings.push_back(
      fmt::format("{}: the last horizontal angle is {}: the plane of 360 is taken to be that of 0",
                  printable(path.string()), last));
  given.planes.push_back(360);
  given.intensity.conservativeResize(Eigen::NoChange, given.intensity.cols() + 1);
  given.intensity.col(given.intensity.cols() - 1) = given.intensity.col(0);
}

PhotometricWeb::Type type_of(long number) {
  return number == 1   ? PhotometricWeb::Type::c
         : number == 2 ? PhotometricWeb::Type::b
                       : PhotometricWeb::Type::a;
}

/// The angles, as long as the counts say.
GivenPlanes read_angles(NumberStream& numbers, PhotometricWeb::Type type, long n_vertical,
                        long n_horizontal) {
  const bool is_c = type == PhotometricWeb::Type::c;
  const bool has_horizontal_pole = type == PhotometricWeb::Type::b;
  GivenPlanes given{type, {}, {}, {}};
  given.vertical = numbers.next_list("vertical angle", n_vertical);
  std::string problem = angle_problem("vertical", given.vertical,
                                      is_c                  ? 0
                                      : has_horizontal_pole ? -180
                                                            : -90,
                                      is_c || has_horizontal_pole ? 180 : 90);
  if (!problem.empty()) numbers.fail(problem);
  given.planes = numbers.next_list("horizontal angle", n_horizontal);
  problem = angle_problem("horizontal", given.planes,
                          is_c                  ? 0
                          : has_horizontal_pole ? -90
                                                : -180,
                          is_c                  ? 360
                          : has_horizontal_pole ? 90
                                                : 180);
  if (!problem.empty()) numbers.fail(problem);
  if (n_vertical < 2 || (!is_c && n_horizontal < 2)) {
    numbers.fail("a single angle spans nothing, expected two or more");
  }
  return given;
}

void read_intensities(NumberStream& numbers, double factor, GivenPlanes& given) {
  const auto n_vertical = static_cast<Index>(given.vertical.size());
  const auto n_planes = static_cast<Index>(given.planes.size());
  given.intensity.resize(n_vertical, n_planes);
  for (Index plane = 0; plane < n_planes; ++plane) {
    for (Index i = 0; i < n_vertical; ++i) {
      const double value = numbers.next("an intensity");
      if (!(value >= 0)) numbers.fail(fmt::format("intensity {} is negative", value));
      given.intensity(i, plane) = factor * value;
    }
  }
}

}  // namespace

Photometry read_ies(const std::filesystem::path& path, const radiosity::Progress& progress) {
  LineReader lines(path, progress);
  Photometry photometry;
  photometry.file = path;
  const std::string tilt = read_labels(lines, photometry);
  NumberStream numbers(lines);
  read_tilt(tilt, lines, numbers, path, progress, photometry);

  const long n_lamps = numbers.next_count("the number of lamps", 1, 1000000);
  const double lumens = numbers.next("the lumens of a lamp");
  if (!(lumens > 0) && lumens != -1) {
    numbers.fail(
        fmt::format("the lumens of a lamp are {}, expected more than 0, or -1 for "
                    "absolute photometry",
                    lumens));
  }
  if (lumens > 0) photometry.lamp_flux = static_cast<double>(n_lamps) * lumens;
  const double multiplier = more_than_zero(numbers, "the multiplier of intensities");
  const long n_vertical = numbers.next_count("the number of vertical angles", 1, kMostAngles);
  const long n_horizontal = numbers.next_count("the number of horizontal angles", 1, kMostAngles);
  if (n_vertical * n_horizontal > kMostIntensities) {
    numbers.fail(fmt::format("{} x {} intensities, more than the {} that are read", n_vertical,
                             n_horizontal, kMostIntensities));
  }
  const PhotometricWeb::Type type = type_of(numbers.next_count("the photometric type", 1, 3));
  const long units = numbers.next_count("the type of units", 1, 2);
  read_opening(numbers, units == 1 ? kFoot : 1, photometry);
  const double ballast = more_than_zero(numbers, "the ballast factor");
  const double second = more_than_zero(numbers, "the ballast-lamp factor");
  // Of the ballast with the lamp; since 2019 a code that tells where the file comes from.
  const double ballast_lamp = photometry.format.ends_with("2019") ? 1 : second;
  photometry.power = numbers.next("the input power");
  if (!(photometry.power >= 0)) {
    numbers.fail(fmt::format("the input power is {} W, expected no less than 0", photometry.power));
  }

  GivenPlanes given = read_angles(numbers, type, n_vertical, n_horizontal);
  read_intensities(numbers, multiplier * ballast * ballast_lamp, given);
  const std::string_view rest = numbers.next_word();
  if (!rest.empty() && rest.front() != '[') {
    numbers.fail(
        fmt::format("found {} behind the last of {} x {} intensities: the counts are "
                    "wrong, or numbers have decimal commas",
                    lines.shown(rest), n_vertical, n_horizontal));
  }
  if (type == PhotometricWeb::Type::c) {
    unfold_c(numbers, path, given, photometry);
  } else if (given.planes.front() == 0) {
    mirror_planes(0, given);
  }
  photometry.web = make_web(given);
  return photometry;
}

}  // namespace io
