#include <nlohmann/json.hpp>

#include "apps/validation/report/report.h"

namespace apps::validation {
namespace {

using Json = nlohmann::ordered_json;  // writes NaN and infinity as null

Json checks(const std::vector<Check>& list) {
  Json array = Json::array();
  for (const Check& check : list) {
    const bool is_upper = check.relation == Check::Relation::at_most;
    array.push_back({{"what", check.what},
                     {"value", check.value},
                     {"relation", is_upper ? "at most" : "at least"},
                     {"tolerance", check.tolerance},
                     {"unit", check.unit},
                     {"passed", check.passed()},
                     {"derivation", check.derivation}});
  }
  return array;
}

/// The numbers behind plots and tables; maps are for the eye.
Json figures(const std::vector<Figure>& list) {
  Json array = Json::array();
  for (const Figure& figure : list) {
    if (const auto* plot = std::get_if<Plot>(&figure)) {
      Json series = Json::array();
      for (const Series& s : plot->series) {
        series.push_back({{"label", s.label}, {"x", s.x}, {"y", s.y}});
      }
      array.push_back(
          {{"title", plot->title}, {"x", plot->x.label}, {"y", plot->y.label}, {"series", series}});
    } else if (const auto* table = std::get_if<Table>(&figure)) {
      array.push_back({{"title", table->title}, {"header", table->header}, {"rows", table->rows}});
    }
  }
  return array;
}

}  // namespace

std::string report_json(const Report& report) {
  Json cases = Json::array();
  bool is_passed = true;
  for (const CaseOutcome& outcome : report.outcomes) {
    is_passed &= outcome.status != CaseOutcome::Status::failed;
    cases.push_back({{"name", outcome.name},
                     {"title", outcome.title},
                     {"status", status_name(outcome.status)},
                     {"message", outcome.message},
                     {"seconds", outcome.seconds},
                     {"compared", outcome.result.compared},
                     {"reference", outcome.result.reference},
                     {"checks", checks(outcome.result.checks)},
                     {"notes", outcome.result.notes},
                     {"figures", figures(outcome.result.figures)}});
  }
  const Json json = {{"version", report.version},
                     {"machine", report.machine},
                     {"date", report.date},
                     {"threads", report.n_threads},
                     {"seed", report.seed},
                     {"passed", is_passed},
                     {"cases", cases}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace apps::validation
