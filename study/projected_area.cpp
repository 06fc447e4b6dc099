#include "study/projected_area.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace study {
namespace {

using radiosity::kPi;
using radiosity::Vec3;

constexpr int kAltitudes = 7;  // 0°, 15°... 90°
constexpr int kAzimuths = 13;  // 0°, ahead, 15°... 180°
constexpr double kStep = kPi / 12;

using Table = std::array<std::array<double, kAltitudes>, kAzimuths>;

constexpr Table kStanding = {{{.350, .350, .314, .258, .206, .144, .082},
                              {.342, .342, .310, .252, .200, .140, .082},
                              {.330, .330, .300, .244, .190, .132, .082},
                              {.310, .310, .275, .228, .175, .124, .082},
                              {.283, .283, .251, .208, .160, .114, .082},
                              {.252, .252, .228, .188, .150, .108, .082},
                              {.230, .230, .214, .180, .148, .108, .082},
                              {.242, .242, .222, .180, .153, .112, .082},
                              {.274, .274, .245, .203, .165, .116, .082},
                              {.304, .304, .270, .220, .174, .121, .082},
                              {.328, .328, .290, .234, .183, .125, .082},
                              {.344, .344, .304, .244, .190, .128, .082},
                              {.347, .347, .308, .246, .191, .128, .082}}};
constexpr Table kSeated = {{{.290, .324, .305, .303, .262, .224, .177},
                            {.292, .328, .294, .288, .268, .227, .177},
                            {.288, .332, .298, .290, .264, .222, .177},
                            {.274, .326, .294, .289, .252, .214, .177},
                            {.254, .308, .280, .276, .241, .202, .177},
                            {.230, .282, .262, .260, .233, .193, .177},
                            {.216, .260, .248, .244, .220, .186, .177},
                            {.234, .258, .236, .227, .208, .180, .177},
                            {.262, .260, .224, .208, .196, .176, .177},
                            {.280, .260, .210, .192, .184, .170, .177},
                            {.298, .256, .194, .174, .168, .168, .177},
                            {.306, .250, .180, .156, .156, .166, .177},
                            {.300, .240, .168, .152, .152, .164, .177}}};

/// Means over the azimuth, which runs to both sides alike.
std::array<double, kAltitudes> mean_over_azimuth(const Table& table) {
  std::array<double, kAltitudes> mean{};
  for (int a = 0; a < kAzimuths; ++a) {
    const double weight = (a == 0 || a == kAzimuths - 1 ? 0.5 : 1.0) / (kAzimuths - 1);
    for (int k = 0; k < kAltitudes; ++k) mean[k] += weight * table[a][k];
  }
  return mean;
}

/// Where an angle lies among steps: the step that it is in, and how far.
struct Step {
  int index;
  double share;
  Step(double angle, int n_values) {
    const double steps = std::clamp(angle / kStep, 0.0, static_cast<double>(n_values - 1));
    index = std::min(static_cast<int>(steps), n_values - 2);
    share = steps - index;
  }
};

double between(const std::array<double, kAltitudes>& values, const Step& step) {
  return (1 - step.share) * values[step.index] + step.share * values[step.index + 1];
}

}  // namespace

std::optional<Posture> posture_named(std::string_view name) {
  if (name == "standing") return Posture::standing;
  if (name == "seated") return Posture::seated;
  return std::nullopt;
}

ProjectedArea::ProjectedArea(Posture posture, const Vec3& up, const std::optional<Vec3>& facing)
    : posture_(posture), up_(up), facing_(facing) {}

double ProjectedArea::operator()(const Vec3& direction) const {
  static const std::array<double, kAltitudes> kStandingMean = mean_over_azimuth(kStanding);
  static const std::array<double, kAltitudes> kSeatedMean = mean_over_azimuth(kSeated);
  const bool is_seated = posture_ == Posture::seated;
  const double height = up_.dot(direction);
  const Step altitude(std::asin(std::min(std::abs(height), 1.0)), kAltitudes);
  if (!facing_) return between(is_seated ? kSeatedMean : kStandingMean, altitude);
  const Table& table = is_seated ? kSeated : kStanding;
  const double sign = height < 0 ? -1 : 1;
  const double ahead = sign * facing_->dot(direction);
  const double aside = up_.cross(*facing_).dot(direction);
  const Step azimuth(std::atan2(std::abs(aside), ahead), kAzimuths);
  return (1 - azimuth.share) * between(table[azimuth.index], altitude) +
         azimuth.share * between(table[azimuth.index + 1], altitude);
}

}  // namespace study
