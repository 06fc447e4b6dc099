#include "io/light/ldt_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/light/web_planes.h"

namespace io {
namespace {

using radiosity::Index;
using radiosity::Photometry;

constexpr double kMillimetre = 1e-3;

/// One value a line.
class LdtLines {
 public:
  explicit LdtLines(LineReader& lines) : lines_(lines) {}

  std::string_view text(std::string_view what) {
    if (!lines_.next_line()) lines_.fail(fmt::format("the file ends before {}", what));
    return trimmed(lines_.line());
  }
  double number(std::string_view what) {
    const std::string_view word = text(what);
    const auto value = parse_number<double>(word);
    if (!value || !std::isfinite(*value)) {
      const bool has_comma = word.find(',') != std::string_view::npos;
      lines_.fail(fmt::format("expected a number for {}, found {}{}", what, lines_.shown(word),
                              has_comma ? "; decimal commas are not read" : ""));
    }
    return *value;
  }
  double at_least_zero(std::string_view what) {
    const double value = number(what);
    if (!(value >= 0)) fail(fmt::format("{} is {}, expected no less than 0", what, value));
    return value;
  }
  long count(std::string_view what, long least, long most) {
    const double value = number(what);
    if (value != std::floor(value) || !(value >= static_cast<double>(least)) ||
        !(value <= static_cast<double>(most))) {
      fail(fmt::format("found {} for {}, expected a whole number from {} to {}", value, what, least,
                       most));
    }
    return static_cast<long>(value);
  }
  std::vector<double> list(std::string_view what, long n) {
    std::vector<double> values;
    for (long k = 0; k < n; ++k) {
      values.push_back(number(fmt::format("{} {} of {}", what, k + 1, n)));
    }
    return values;
  }
  /// What else the file has but blank lines.
  void expect_end() {
    while (lines_.next_line()) {
      const std::string_view rest = trimmed(lines_.line());
      if (rest.empty() || rest == "\x1a") continue;
      fail(fmt::format("found {} behind the last intensity: the counts are wrong",
                       lines_.shown(rest)));
    }
  }
  void recognise() { lines_.recognise(); }
  [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }

 private:
  LineReader& lines_;
};

/// How the file says that planes are alike, and how many there are.
struct LdtHead {
  long symmetry = 0;
  long n_planes = 0;
  long n_vertical = 0;
};

LdtHead read_head(LdtLines& lines, Photometry& photometry) {
  LdtHead head;
  photometry.maker = printable(std::string(lines.text("the maker")));
  (void)lines.count("the type (Ityp)", 0, 3);
  head.symmetry = lines.count("the symmetry (Isym)", 0, 4);
  head.n_planes = lines.count("the number of C-planes (Mc)", 1, kMostAngles);
  (void)lines.at_least_zero("the distance between C-planes (Dc)");
  head.n_vertical = lines.count("the number of intensities in a plane (Ng)", 2, kMostAngles);
  (void)lines.at_least_zero("the distance between intensities (Dg)");
  lines.recognise();
  const bool is_dividable = (head.symmetry != 2 && head.symmetry != 3 && head.symmetry != 4) ||
                            head.n_planes % (head.symmetry == 2 ? 2 : 4) == 0;
  if (!is_dividable) {
    lines.fail(
        fmt::format("{} C-planes cannot have the symmetry {}", head.n_planes, head.symmetry));
  }
  if (head.n_planes * head.n_vertical > kMostIntensities) {
    lines.fail(fmt::format("{} x {} intensities, more than the {} that are read", head.n_planes,
                           head.n_vertical, kMostIntensities));
  }
  return head;
}

/// Returns the share of its lamps' light that the luminaire is said to give, 0 = it is not said.
double read_luminaire(LdtLines& lines, Photometry& photometry) {
  (void)lines.text("the number of the report");
  photometry.name = printable(std::string(lines.text("the name of the luminaire")));
  (void)lines.text("the number of the luminaire");
  (void)lines.text("the file's name");
  (void)lines.text("the date");
  (void)lines.at_least_zero("the length of the luminaire");
  (void)lines.at_least_zero("the width of the luminaire");
  (void)lines.at_least_zero("the height of the luminaire");
  photometry.along_c90 = kMillimetre * lines.at_least_zero("the length of the luminous area");
  photometry.along_c0 = kMillimetre * lines.at_least_zero("the width of the luminous area");
  photometry.is_round = photometry.along_c0 == 0 && photometry.along_c90 > 0;
  if (photometry.is_round) photometry.along_c0 = photometry.along_c90;
  for (const char* plane : {"C0", "C90", "C180", "C270"}) {
    const double height = lines.at_least_zero(fmt::format("the luminous height at {}", plane));
    photometry.height = std::max(photometry.height, kMillimetre * height);
  }
  (void)lines.at_least_zero("the downward flux fraction (DFF)");
  return lines.at_least_zero("the light output ratio (LORL)") / 100;
}

/// If intensities and what the file says of their sum are far apart: one of them is wrong.
void check_output_ratio(const std::filesystem::path& path, double ratio, Photometry& photometry) {
  constexpr double kFar = 0.1;
  if (ratio == 0 || photometry.lamp_flux == 0) return;
  const double found = radiosity::flux(photometry.web) / photometry.lamp_flux;
  if (std::abs(found - ratio) <= kFar * ratio) return;
  photometry.warnings.push_back(fmt::format(
      "{}: its intensities add up to {:.4g} % of its lamps' light, but its light output "
      "ratio is {:.4g} %",
      printable(path.string()), 100 * found, 100 * ratio));
}

/// Candela for each unit of the file.
double read_lamps(LdtLines& lines, const std::filesystem::path& path, Photometry& photometry) {
  constexpr long kMostSets = 1000;
  const double factor = lines.number("the conversion factor");
  if (!(factor > 0)) {
    lines.fail(fmt::format("the conversion factor is {}, expected more than 0", factor));
  }
  const double tilt = lines.number("the tilt of the luminaire");
  if (tilt != 0) {
    photometry.warnings.push_back(
        fmt::format("{}: was tilted by {:g} degrees when it was measured, of which nothing is made",
                    printable(path.string()), tilt));
  }
  const long n_sets = lines.count("the number of sets of lamps", 1, kMostSets);
  if (n_sets > 1) {
    photometry.warnings.push_back(fmt::format("{}: has {} sets of lamps, of which the first counts",
                                              printable(path.string()), n_sets));
  }
  double flux = 0;
  for (long set = 0; set < n_sets; ++set) {
    const double n_lamps = lines.number("the number of lamps");
    (void)lines.text("the type of the lamps");
    const double lumens = lines.number("the lumens of the lamps");
    if (!(lumens > 0)) {
      lines.fail(fmt::format("the lumens of the lamps are {}, expected more than 0", lumens));
    }
    (void)lines.text("the colour of the light");
    (void)lines.text("the colour rendering");
    const double power = lines.at_least_zero("the power");
    if (set > 0) continue;
    flux = lumens;
    photometry.power = power;
    photometry.lamp_flux = n_lamps < 0 ? 0 : lumens;
  }
  (void)lines.list("direct ratio", 10);
  return factor * flux / 1000;
}

/// The planes that the file has intensities of.
std::vector<double> given_planes(const LdtHead& head, const std::vector<double>& all) {
  const auto plane = [&](long k) { return all[static_cast<std::size_t>(k)]; };
  std::vector<double> planes;
  const long n = head.n_planes;
  switch (head.symmetry) {
    case 1:
      return {0};
    case 2:
      for (long k = 0; k <= n / 2; ++k) planes.push_back(plane(k));
      return planes;
    case 3:  // from C270 by C0 to C90
      for (long k = -n / 4; k <= n / 4; ++k) {
        planes.push_back(k < 0 ? plane(n + k) - 360 : plane(k));
      }
      return planes;
    case 4:
      for (long k = 0; k <= n / 4; ++k) planes.push_back(k < n ? plane(k) : 90);
      return planes;
    default:
      return all;
  }
}

/// All planes of a symmetric file.
void unfold(LdtLines& lines, long symmetry, GivenPlanes& given) {
  const double last = given.planes.back();
  if (symmetry == 4 && last != 90) {
    lines.fail(fmt::format("a quarter of the C-planes ends at {}, expected 90", last));
  }
  if (symmetry == 3 && (last != 90 || given.planes.front() != -90)) {
    lines.fail(fmt::format("half of the C-planes is from {} to {}, expected 270 to 90",
                           given.planes.front() + 360, last));
  }
  if (symmetry == 2 && last != 180) {
    lines.fail(fmt::format("half of the C-planes ends at {}, expected 180", last));
  }
  if (symmetry == 4) mirror_planes(180, given);
  if (symmetry == 2 || symmetry == 4) mirror_planes(360, given);
  if (symmetry == 3) mirror_planes(180, given);
  if (symmetry == 0) {
    if (given.planes.size() == 1) return;
    given.planes.push_back(360);
    given.intensity.conservativeResize(Eigen::NoChange, given.intensity.cols() + 1);
    given.intensity.col(given.intensity.cols() - 1) = given.intensity.col(0);
  }
}

}  // namespace

Photometry read_ldt(const std::filesystem::path& path, const radiosity::Progress& progress) {
  LineReader reader(path, progress);
  LdtLines lines(reader);
  Photometry photometry;
  photometry.file = path;
  photometry.format = "EULUMDAT";
  const LdtHead head = read_head(lines, photometry);
  const double ratio = read_luminaire(lines, photometry);
  const double factor = read_lamps(lines, path, photometry);
  const std::vector<double> planes = lines.list("C-plane", head.n_planes);
  std::string problem = angle_problem("C", planes, 0, 359.999999);
  if (problem.empty() && planes.front() != 0) problem = "the first C-plane is not 0";
  if (!problem.empty()) lines.fail(problem);
  GivenPlanes given;
  given.vertical = lines.list("gamma angle", head.n_vertical);
  problem = angle_problem("gamma", given.vertical, 0, 180);
  if (!problem.empty()) lines.fail(problem);
  given.planes = given_planes(head, planes);
  given.intensity.resize(static_cast<Index>(given.vertical.size()),
                         static_cast<Index>(given.planes.size()));
  for (Index plane = 0; plane < given.intensity.cols(); ++plane) {
    for (Index i = 0; i < given.intensity.rows(); ++i) {
      given.intensity(i, plane) = factor * lines.at_least_zero("an intensity");
    }
  }
  lines.expect_end();
  unfold(lines, head.symmetry, given);
  photometry.web = make_web(given);
  check_output_ratio(path, ratio, photometry);
  return photometry;
}

}  // namespace io
