#include "io/scene/spectrum.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>

#include "io/base/line_reader.h"

namespace io {
namespace {

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> result;
  for (;;) {
    const auto comma = line.find(',');
    result.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return result;
    line.remove_prefix(comma + 1);
  }
}

/// Which of the columns named on the current line is `name`.
std::size_t column_index(LineReader& lines, const std::string& name) {
  const auto names = cells(lines.line());
  if (names.front() != "wavelength_nm") {
    lines.fail(
        fmt::format("the first column is {}, expected wavelength_nm", lines.shown(names.front())));
  }
  lines.recognise();
  const auto found = std::find(names.begin() + 1, names.end(), name);
  if (found == names.end()) {
    lines.fail(fmt::format("no column \"{}\", expected one of {}", name,
                           fmt::join(names.begin() + 1, names.end(), ", ")));
  }
  return static_cast<std::size_t>(found - names.begin());
}

double number(const LineReader& lines, std::string_view cell) {
  const auto value = parse_number<double>(cell);
  if (!value || !std::isfinite(*value)) {
    lines.fail(fmt::format("expected a number, found {}", lines.shown(cell)));
  }
  return *value;
}

}  // namespace

Spectrum read_spectrum(const std::filesystem::path& path, const std::string& column,
                       const std::function<std::optional<std::string>(double)>& check) {
  const radiosity::Progress progress;
  LineReader lines(path, progress);
  if (!lines.next_content()) fail(path, "has no column names");
  const std::size_t index = column_index(lines, column);
  const std::size_t n_columns = cells(lines.line()).size();
  Spectrum spectrum;
  while (lines.next_content()) {
    const auto row = cells(lines.line());
    if (row.size() != n_columns) {
      lines.fail(fmt::format("found {} columns, expected {}", row.size(), n_columns));
    }
    const double wavelength = number(lines, row[0]);
    if (!spectrum.wavelengths.empty() && !(wavelength > spectrum.wavelengths.back())) {
      lines.fail("wavelengths do not increase");
    }
    spectrum.wavelengths.push_back(wavelength);
    spectrum.values.push_back(number(lines, row[index]));
    if (const auto problem = check(spectrum.values.back())) lines.fail(*problem);
  }
  if (spectrum.wavelengths.empty()) fail(path, "has no values");
  return spectrum;
}

Eigen::VectorXd interpolate(const Spectrum& spectrum, const std::vector<double>& wavelengths) {
  const auto& x = spectrum.wavelengths;
  Eigen::VectorXd result(static_cast<Eigen::Index>(wavelengths.size()));
  for (std::size_t band = 0; band < wavelengths.size(); ++band) {
    const double wavelength = wavelengths[band];
    assert(wavelength >= x.front() && wavelength <= x.back());
    const auto after = std::lower_bound(x.begin(), x.end(), wavelength) - x.begin();
    const auto before = std::max<std::ptrdiff_t>(after - 1, 0);
    const double width = x[after] - x[before];
    const double t = width > 0 ? (wavelength - x[before]) / width : 0;
    result[static_cast<Eigen::Index>(band)] =
        (1 - t) * spectrum.values[before] + t * spectrum.values[after];
  }
  return result;
}

}  // namespace io
