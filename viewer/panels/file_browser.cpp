#include "viewer/panels/file_browser.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "io/base/extension.h"

namespace viewer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTitle = "Open a scene or a result";
constexpr std::array<std::string_view, 16> kExtensions = {
    ".json", ".obj", ".ply", ".stl", ".off", ".gltf",   ".glb",  ".msh",
    ".vs3",  ".vtk", ".vtu", ".vtp", ".h5",  ".epjson", ".foam", ".idf"};

}  // namespace

bool is_listed(const fs::path& path) {
  const std::string extension = io::lower_case_extension(path);
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

void FileBrowser::open(const std::string& path) {
  is_due_ = true;
  std::error_code error;
  const fs::path full = fs::absolute(path.empty() ? fs::path(".") : fs::path(path), error);
  enter(fs::is_directory(full, error) ? full : full.parent_path());
}

void FileBrowser::enter(const fs::path& folder) {
  folder_ = folder.lexically_normal();
  text_ = folder_.string();
  entries_.clear();
  std::error_code error;
  // Folders that may not be read look empty.
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const fs::path& path = entry->path();
    const bool is_hidden = path.filename().string().starts_with('.');
    if (!is_hidden && (entry->is_directory(ignored) || is_listed(path))) {
      entries_.push_back(path);
    }
  }
  std::sort(entries_.begin(), entries_.end(), [](const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    const bool is_a_folder = fs::is_directory(a, ignored);
    const bool is_b_folder = fs::is_directory(b, ignored);
    return is_a_folder != is_b_folder ? is_a_folder : a < b;
  });
}

std::optional<std::string> FileBrowser::follow_text() {
  std::error_code error;
  if (!fs::is_directory(text_, error)) return text_;
  enter(text_);
  return std::nullopt;
}

std::optional<std::string> FileBrowser::draw_entries() {
  std::optional<std::string> chosen;
  std::optional<fs::path> next;
  if (ImGui::Selectable("..", false, ImGuiSelectableFlags_DontClosePopups)) {
    next = folder_.parent_path();
  }
  for (const fs::path& entry : entries_) {
    std::error_code ignored;
    const bool is_folder = fs::is_directory(entry, ignored);
    const std::string label = entry.filename().string() + (is_folder ? "/" : "");
    constexpr ImGuiSelectableFlags kFlags =
        ImGuiSelectableFlags_DontClosePopups | ImGuiSelectableFlags_AllowDoubleClick;
    if (!ImGui::Selectable(label.c_str(), entry == text_, kFlags)) continue;
    if (is_folder) {
      next = entry;
    } else {
      text_ = entry.string();
      if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) chosen = text_;
    }
  }
  if (next) enter(*next);
  return chosen;
}

std::optional<std::string> FileBrowser::draw(const DialogKeys& keys, double scale) {
  if (is_due_) ImGui::OpenPopup(kTitle);
  is_due_ = false;
  const auto size = static_cast<float>(scale);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize(ImVec2(std::min(560 * size, screen.x), std::min(420 * size, screen.y)),
                           ImGuiCond_Appearing);
  if (!ImGui::BeginPopupModal(kTitle)) return std::nullopt;
  ImGui::SetNextItemWidth(-1);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::InputText("##path", &text_, ImGuiInputTextFlags_AutoSelectAll);
  ImGui::BeginChild("entries", ImVec2(0, -ImGui::GetFrameHeightWithSpacing()), true);
  std::optional<std::string> chosen = draw_entries();
  ImGui::EndChild();
  if (ImGui::Button("Open") || keys.has_enter) chosen = follow_text();
  ImGui::SameLine();
  const bool is_cancelled = ImGui::Button("Cancel") || keys.has_escape;
  if (chosen || is_cancelled) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  if (is_cancelled) return std::nullopt;
  return chosen;
}

}  // namespace viewer
