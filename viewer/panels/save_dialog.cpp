#include "viewer/panels/save_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "io/base/extension.h"
#include "io/base/output_check.h"
#include "radiosity/base/error.h"
#include "viewer/desk/measuring.h"
#include "viewer/panels/inks.h"

namespace viewer {
namespace {

constexpr float kDialogWidth = 560;  // at scale 1

const char* title_of(SaveDialog::Kind kind) {
  switch (kind) {
    case SaveDialog::Kind::picture:
      return "Picture of the window (.png)";
    case SaveDialog::Kind::result:
      return "Result (.vtp, .csv or .ply)";
    case SaveDialog::Kind::scene:
      return "Scene with its changes (.json)";
    case SaveDialog::Kind::readings:
      return "Measured light (.csv)";
  }
  return "";
}

const char* ending_of(SaveDialog::Kind kind) {
  switch (kind) {
    case SaveDialog::Kind::picture:
      return ".png";
    case SaveDialog::Kind::result:
      return ".vtp";
    case SaveDialog::Kind::scene:
      return "-new.json";
    case SaveDialog::Kind::readings:
      return "-measured.csv";
  }
  return "";
}

}  // namespace

void SaveDialog::open(const Desk& desk, Kind kind) {
  kind_ = kind;
  is_due_ = true;
  replaced_.clear();
  error_.clear();
  std::filesystem::path beside = desk.session.model().path;
  if (beside.empty()) beside = "radiosity";
  std::error_code ignored;
  const std::filesystem::path full = std::filesystem::absolute(beside, ignored);
  path_ = (full.parent_path() / full.stem()).lexically_normal().string() + ending_of(kind);
}

bool SaveDialog::save(Desk& desk) {
  error_.clear();
  try {
    if (kind_ == Kind::picture && io::lower_case_extension(path_) != ".png") {
      throw radiosity::OutputError("expected a name that ends in .png");
    }
    check_output(desk, path_);
    io::check_writable(path_);
    std::error_code ignored;
    if (std::filesystem::exists(path_, ignored) && replaced_ != path_) {
      replaced_ = path_;
      return false;
    }
    if (kind_ == Kind::picture) desk.screenshot = path_;
    if (kind_ == Kind::result) begin_save_result(desk, path_);
    if (kind_ == Kind::scene) save_scene(desk, path_);
    if (kind_ == Kind::readings) save_readings(desk, path_);
  } catch (const std::exception& error) {
    error_ = error.what();
    return false;
  }
  const bool is_written = kind_ == Kind::scene || kind_ == Kind::readings;
  if (is_written) desk.session.tell("saved " + path_);
  return true;
}

void SaveDialog::draw(Desk& desk, const DialogKeys& keys, double scale) {
  if (is_due_) ImGui::OpenPopup("Save");
  is_due_ = false;
  const float width =
      std::min(kDialogWidth * static_cast<float>(scale), ImGui::GetIO().DisplaySize.x);
  ImGui::SetNextWindowSize(ImVec2(width, 0));
  if (!ImGui::BeginPopupModal("Save", nullptr, ImGuiWindowFlags_NoResize)) return;
  ImGui::TextUnformatted(title_of(kind_));
  ImGui::SetNextItemWidth(-1);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::InputText("##file", &path_, ImGuiInputTextFlags_AutoSelectAll);
  const bool asks = replaced_ == path_;
  ImGui::PushTextWrapPos(0);
  if (asks) ImGui::TextColored(kDoubtInk, "There is such a file. Replace it?");
  if (!error_.empty()) ImGui::TextColored(kErrorInk, "%s", error_.c_str());
  ImGui::PopTextWrapPos();
  const bool is_asked = ImGui::Button(asks ? "Replace" : "Save") || keys.has_enter;
  ImGui::SameLine();
  const bool is_cancelled = ImGui::Button("Cancel") || keys.has_escape;
  if (is_cancelled || (is_asked && save(desk))) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace viewer
