#include "apps/summary/ugr_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "apps/summary/text_table.h"

namespace apps {
namespace {

using Eigen::Index;
using Json = nlohmann::ordered_json;

std::string reflectances_text(const study::UgrReflectances& rho) {
  return fmt::format("{:g}/{:g}/{:g}", 100 * rho[0], 100 * rho[1], 100 * rho[2]);
}

std::string ugr_value(double ugr) { return std::isfinite(ugr) ? fmt::format("{:.1f}", ugr) : "-"; }

std::string half_text(const study::UgrTable& table, const Eigen::MatrixXd& values,
                      const char* direction) {
  std::vector<Row> rows = {{fmt::format("UGR along {}", direction), ""}};
  for (const study::UgrReflectances& rho : table.made_by.reflectances) {
    rows[0].push_back(reflectances_text(rho));
  }
  for (Index k = 0; k < values.rows(); ++k) {
    const study::UgrRoom& room = table.made_by.rooms[static_cast<std::size_t>(k)];
    rows.push_back({fmt::format("X {:g}H", room.across), fmt::format("Y {:g}H", room.along)});
    for (Index c = 0; c < values.cols(); ++c) rows.back().push_back(ugr_value(values(k, c)));
  }
  return apps::table(rows);
}

Json rows_json(const Eigen::MatrixXd& values) {
  Json rows = Json::array();
  for (Index k = 0; k < values.rows(); ++k) {
    Json row = Json::array();
    for (Index c = 0; c < values.cols(); ++c) {
      row.push_back(std::isfinite(values(k, c)) ? Json(values(k, c)) : Json());
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::string ugr_text(const study::UgrTable& table, double flux) {
  return line("UGR table",
              fmt::format("{:.6g} lm each, spacing {:g} H, H = {:g} m, reflectances of "
                          "ceiling/walls/floor in %",
                          flux, table.made_by.spacing, table.made_by.height)) +
         half_text(table, table.along_c0, "C0") + half_text(table, table.along_c90, "C90");
}

Json ugr_json(const study::UgrTable& table) {
  Json rooms = Json::array();
  for (const study::UgrRoom& room : table.made_by.rooms) {
    rooms.push_back({room.across, room.along});
  }
  return {{"height", table.made_by.height},
          {"spacing", table.made_by.spacing},
          {"rooms", std::move(rooms)},
          {"reflectances", table.made_by.reflectances},
          {"along_c0", rows_json(table.along_c0)},
          {"along_c90", rows_json(table.along_c90)}};
}

}  // namespace apps
