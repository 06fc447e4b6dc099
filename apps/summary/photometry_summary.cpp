#include "apps/summary/photometry_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/summary/text_table.h"
#include "apps/summary/ugr_summary.h"
#include "apps/terminal/terminal_progress.h"
#include "io/base/printable.h"

namespace apps {
namespace {

using radiosity::kPi;
using radiosity::PhotometricWeb;
using radiosity::Photometry;

double in_degrees(double angle) { return angle * 180 / kPi; }

const char* type_name(PhotometricWeb::Type type) {
  return type == PhotometricWeb::Type::c ? "C" : type == PhotometricWeb::Type::b ? "B" : "A";
}

std::string symmetry_text(const PhotometricWeb& web) {
  const radiosity::WebSymmetry symmetry = symmetry_of(web);
  if (symmetry.is_rotational) return "rotational";
  if (symmetry.across_c0 && symmetry.across_c90) return "to the planes C0-C180 and C90-C270";
  if (symmetry.across_c0) return "to the plane C0-C180";
  return symmetry.across_c90 ? "to the plane C90-C270" : "none";
}

/// Angles of the peak to the axis and about it, degrees.
struct PeakAngles {
  double gamma;
  double plane;
};

PeakAngles peak_angles(const radiosity::PeakIntensity& peak) {
  const radiosity::Vec3& d = peak.direction;
  const double across = std::hypot(d.x(), d.y());
  const double plane = across > 1e-9 ? in_degrees(std::atan2(d.y(), d.x())) : 0;
  return {in_degrees(std::atan2(across, -d.z())),
          plane < -1e-9 ? plane + 360 : std::max(plane, 0.)};
}

std::string opening_text(const Photometry& photometry) {
  if (photometry.along_c0 == 0 && photometry.along_c90 == 0) return "a point";
  return fmt::format(
      "{}{:.4g} m along C0, {:.4g} m along C90{}", photometry.is_round ? "round, " : "",
      photometry.along_c0, photometry.along_c90,
      photometry.height > 0 ? fmt::format(", {:.4g} m high", photometry.height) : "");
}

std::string angles_text(double c0, double c90) {
  return fmt::format("{:.1f}° in C0-C180, {:.1f}° in C90-C270", in_degrees(c0), in_degrees(c90));
}

}  // namespace

std::string photometry_text(const Photometry& photometry, const std::vector<std::string>& outputs) {
  const PhotometricWeb& web = photometry.web;
  const double flux = radiosity::flux(web);
  const radiosity::PeakIntensity peak = peak_intensity(web);
  const PeakAngles angles = peak_angles(peak);
  std::string text = line("luminaire", one_line(photometry.file.string()));
  text +=
      line("format", fmt::format("{}, type {}", one_line(photometry.format), type_name(web.type)));
  if (!photometry.maker.empty()) text += line("maker", one_line(photometry.maker));
  if (!photometry.name.empty()) text += line("name", one_line(photometry.name));
  text += line("flux", fmt::format("{:.6g} lm", flux));
  if (photometry.lamp_flux > 0) {
    text += line("lamps", fmt::format("{:.6g} lm, of which {:.4g} % leave the luminaire",
                                      photometry.lamp_flux, 100 * flux / photometry.lamp_flux));
  } else {
    text += line("lamps", "absolute photometry");
  }
  if (photometry.power > 0) {
    text += line("power",
                 fmt::format("{:.4g} W, {:.4g} lm/W", photometry.power, flux / photometry.power));
  }
  if (web.type == PhotometricWeb::Type::c) {
    text += line("downward", fmt::format("{:.4g} %", 100 * downward_flux(web) / flux));
  }
  text += line("symmetry", symmetry_text(web));
  text += line("greatest", fmt::format("{:.6g} cd at gamma {:.4g}°, C {:.4g}°", peak.intensity,
                                       angles.gamma, angles.plane));
  text += line("beam angle", angles_text(spread(web, 0, 0.5), spread(web, kPi / 2, 0.5)));
  text += line("field angle", angles_text(spread(web, 0, 0.1), spread(web, kPi / 2, 0.1)));
  text += line("opening", opening_text(photometry));
  if (!photometry.tilt.angles.empty()) {
    text += line("tilt", fmt::format("{:.4g} to {:.4g} of it, by how it hangs",
                                     std::ranges::min(photometry.tilt.factors),
                                     std::ranges::max(photometry.tilt.factors)));
  }
  text += line("angles", fmt::format("{} x {}", web.polar.size(), web.azimuth.size()));
  for (const std::string& output : outputs) text += line("written", one_line(output));
  return text;
}

std::string photometry_json(const Photometry& photometry, const study::UgrTable* ugr,
                            const std::vector<std::string>& outputs,
                            const std::vector<std::string>& warnings) {
  const PhotometricWeb& web = photometry.web;
  const radiosity::WebSymmetry symmetry = symmetry_of(web);
  const radiosity::PeakIntensity peak = peak_intensity(web);
  const PeakAngles angles = peak_angles(peak);
  const auto both = [&](double share) {
    return std::vector<double>{in_degrees(spread(web, 0, share)),
                               in_degrees(spread(web, kPi / 2, share))};
  };
  nlohmann::ordered_json json = {
      {"luminaire", photometry.file.string()},
      {"format", photometry.format},
      {"type", type_name(web.type)},
      {"maker", photometry.maker},
      {"name", photometry.name},
      {"flux", radiosity::flux(web)},
      {"lamp_flux", nullptr},
      {"downward_flux", nullptr},
      {"power", photometry.power},
      {"rotational", symmetry.is_rotational},
      {"symmetric_to_c0", symmetry.across_c0},
      {"symmetric_to_c90", symmetry.across_c90},
      {"greatest", {{"candela", peak.intensity}, {"gamma", angles.gamma}, {"c", angles.plane}}},
      {"beam_angle", both(0.5)},
      {"field_angle", both(0.1)},
      {"opening",
       {{"along_c0", photometry.along_c0},
        {"along_c90", photometry.along_c90},
        {"height", photometry.height},
        {"round", photometry.is_round}}},
      {"outputs", outputs},
      {"warnings", warnings}};
  if (!photometry.tilt.angles.empty()) {
    std::vector<double> degrees;
    for (const double angle : photometry.tilt.angles) degrees.push_back(in_degrees(angle));
    json["tilt"] = {{"position", photometry.tilt.position},
                    {"angles", degrees},
                    {"factors", photometry.tilt.factors}};
  }
  if (photometry.lamp_flux > 0) json["lamp_flux"] = photometry.lamp_flux;
  if (web.type == PhotometricWeb::Type::c) json["downward_flux"] = downward_flux(web);
  if (ugr != nullptr) json["ugr_table"] = ugr_json(*ugr);
  return io::printable_json(
      json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace apps
