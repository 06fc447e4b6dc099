#include "viewer/panels/measure_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <string>

#include "viewer/desk/measuring.h"
#include "viewer/panels/inks.h"

namespace viewer {
namespace {

constexpr ImGuiTableFlags kReadingTable =
    ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;

/// A field for a length, m. It is to be taken once it has been typed in.
struct LengthEdit {
  bool is_typing = false;
  bool is_done = false;
};

LengthEdit edit_length(const char* label, double& length, const char* format) {
  ImGui::SetNextItemWidth(7 * ImGui::GetFontSize());
  ImGui::InputDouble(label, &length, 0.05, 0.25, format, ImGuiInputTextFlags_AutoSelectAll);
  return {.is_typing = ImGui::IsItemActive(), .is_done = ImGui::IsItemDeactivatedAfterEdit()};
}

/// The console tells why if that cannot be.
void try_plane(Desk& desk, const radiosity::WorkPlaneOptions& options) {
  try {
    show_work_plane(desk, options);
  } catch (const std::exception& error) {
    desk.session.tell_error(error.what());
  }
}

void draw_summary(const Desk& desk) {
  const auto found = plane_summary(desk);
  if (!found || !ImGui::BeginTable("plane", 2, kReadingTable)) return;
  const auto row = [](const char* what, const std::string& value) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", what);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
  };
  const std::string unit = std::string(" ") + measured_unit(desk.session);
  row("mean", number_text(found->mean) + unit);
  row("least", number_text(found->least) + unit);
  row("greatest", number_text(found->greatest) + unit);
  row("least / mean", number_text(found->least_to_mean(), 3));
  row("least / greatest", number_text(found->least_to_greatest(), 3));
  row("points", std::to_string(found->n));
  if (found->n_inside > 0) row("in solids", fmt::format("{}, left out", found->n_inside));
  if (found->n_outside > 0) row("off the floor", fmt::format("{}, left out", found->n_outside));
  ImGui::EndTable();
}

void draw_points(Desk& desk) {
  bool is_in_hand = desk.is_meter_in_hand;
  if (ImGui::Checkbox("light meter", &is_in_hand)) take_meter(desk, is_in_hand);
  if (desk.is_meter_in_hand) {
    ImGui::SameLine();
    ImGui::TextDisabled("click surfaces");
  }
  if (desk.meter.points().empty() || !ImGui::BeginTable("meters", 4, kReadingTable)) return;
  const float width = ImGui::GetFontSize();
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 1.2F * width);
  ImGui::TableSetupColumn(measured_unit(desk.session), ImGuiTableColumnFlags_WidthFixed,
                          3.6F * width);
  ImGui::TableSetupColumn("x  y  z, m", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("##away", ImGuiTableColumnFlags_WidthFixed, 1.2F * width);
  ImGui::TableHeadersRow();
  std::optional<std::size_t> removed;
  for (std::size_t k = 0; k < desk.meter.points().size(); ++k) {
    const MeterPoint& point = desk.meter.points()[k];
    const auto value = meter_value(desk, k);
    ImGui::PushID(static_cast<int>(k));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%zu", k + 1);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value ? number_text(*value).c_str() : "...");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(fmt::format("{:.3g}  {:.3g}  {:.3g}", point.position[0],
                                       point.position[1], point.position[2])
                               .c_str());
    if (!point.surface.empty() && ImGui::IsItemHovered()) {
      ImGui::SetTooltip("on %s", point.surface.c_str());
    }
    ImGui::TableNextColumn();
    if (ImGui::SmallButton("×")) removed = k;
    ImGui::PopID();
  }
  ImGui::EndTable();
  if (removed) desk.meter.remove(*removed);
}

}  // namespace

void MeasurePanel::draw_plane(Desk& desk) {
  bool is_on = desk.meter.plane().has_value();
  if (!is_typing_) typed_ = desk.meter.plane().value_or(radiosity::WorkPlaneOptions{});
  if (ImGui::Checkbox("work plane", &is_on)) {
    if (is_on) {
      try_plane(desk, typed_);
    } else {
      hide_work_plane(desk);
    }
  }
  if (!desk.meter.plane()) return;
  if (desk.look.show != Show::work_plane) {
    ImGui::SameLine();
    if (ImGui::SmallButton("show it")) show(desk, "work-plane");
  }
  const bool is_automatic = typed_.spacing <= 0;
  const LengthEdit edits[] = {
      edit_length("m above the floor", typed_.height, "%.3g"),
      edit_length("m of border", typed_.border, "%.3g"),
      edit_length("m apart###apart", typed_.spacing, is_automatic ? "auto" : "%.3g")};
  is_typing_ = false;
  bool is_done = false;
  for (const LengthEdit& edit : edits) {
    is_typing_ |= edit.is_typing;
    is_done |= edit.is_done;
  }
  if (is_done) {
    typed_.border = std::max(0.0, typed_.border);
    typed_.spacing = std::max(0.0, typed_.spacing);
    try_plane(desk, typed_);
  }
  if (desk.look.show != Show::work_plane) return;
  ImGui::Checkbox("isolines##plane", &desk.look.isolines);
  ImGui::SameLine();
  ImGui::Checkbox("numbers", &desk.look.numbers);
}

bool MeasurePanel::draw(Desk& desk) {
  const bool is_used = desk.meter.plane() || !desk.meter.points().empty();
  if (is_used) ImGui::SetNextItemOpen(true, ImGuiCond_Once);
  if (!ImGui::CollapsingHeader("Measure")) return false;
  ImGui::BeginDisabled(!desk.session.is_open());
  draw_plane(desk);
  draw_summary(desk);
  draw_points(desk);
  ImGui::EndDisabled();
  if (!is_used) return false;
  const std::string note = readings_note(desk);
  if (!note.empty()) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextColored(kDoubtInk, "%s", note.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::BeginDisabled(!note.empty());
  const bool is_saving = ImGui::Button("Save as .csv ...");
  ImGui::EndDisabled();
  return is_saving;
}

}  // namespace viewer
