#include "viewer/draw/window.h"

// VTK's loader of OpenGL must come before GLFW.
#include <vtk_glew.h>

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <vtkAutoInit.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "viewer/draw/window_events.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace viewer {
namespace {

constexpr double kTextSize = 15;  // pixels on a plain screen
constexpr int kMultiSamples = 4;
constexpr int kPlainWidth = 1280;  // of a window on a plain screen, pixels
constexpr int kPlainHeight = 800;

/// GLFW reports errors through a function without context.
std::string& last_glfw_error() {
  static std::string error;
  return error;
}

/// GLFW 3.4 asks Wayland first, whose library complains on the terminal where it is not there; and
/// VTK's GLEW knows X11 only, which Wayland has, too.
void prefer_x11() {
#ifdef GLFW_PLATFORM_X11
  if (std::getenv("DISPLAY") != nullptr || std::getenv("XDG_RUNTIME_DIR") == nullptr) {
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
  }
#endif
}

/// Xlib ends a program whose display is lost by exit(), from within whatever it is at. What threads
/// are still working with must not be destroyed under them then.
class QuickExit {
 public:
  QuickExit() {
    static const bool is_registered = std::atexit(leave) == 0;
    is_needed() = is_registered;
  }
  ~QuickExit() { is_needed() = false; }
  QuickExit(const QuickExit&) = delete;
  QuickExit& operator=(const QuickExit&) = delete;

 private:
  static std::atomic<bool>& is_needed() {
    static std::atomic<bool> value = false;
    return value;
  }
  static void leave() {
    if (is_needed()) std::_Exit(EXIT_FAILURE);
  }
};

/// GLFW itself, for as long as there is a window.
struct Library {
  QuickExit quick_exit;

  Library() {
    prefer_x11();
    glfwSetErrorCallback([](int, const char* text) { last_glfw_error() = text; });
    if (glfwInit() == GLFW_FALSE) {
      throw WindowError("there is no display to open a window on (" + last_glfw_error() +
                        "); 'radiosity render' makes pictures without one");
    }
  }
  ~Library() { glfwTerminate(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

/// The scale that the screen asks for, and what it has room for.
struct Screen {
  double scale = 1;
  int width = kPlainWidth;
  int height = kPlainHeight;
};

Screen main_screen() {
  Screen screen;
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return screen;
  float scale = 1;
  glfwGetMonitorContentScale(monitor, &scale, nullptr);
  screen.scale = std::max(1.0F, scale);
  glfwGetMonitorWorkarea(monitor, nullptr, nullptr, &screen.width, &screen.height);
  return screen;
}

/// The options with a size and a scale.
WindowOptions completed(WindowOptions options) {
  const Screen screen = main_screen();
  if (!(options.scale > 0)) options.scale = screen.scale;
  const auto fitting = [&](int plain, int most) {
    return std::max(1, std::min(static_cast<int>(plain * std::max(1.0, options.scale)), most));
  };
  if (options.width == 0) options.width = fitting(kPlainWidth, screen.width);
  if (options.height == 0) options.height = fitting(kPlainHeight, screen.height);
  return options;
}

GLFWwindow* open_window(const WindowOptions& options) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  GLFWwindow* window =
      glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  if (window == nullptr) {
    throw WindowError("the window needs OpenGL 3.2, which this display does not have (" +
                      last_glfw_error() + "); 'radiosity render' makes pictures without it");
  }
  return window;
}

/// Latin, Greek and Cyrillic letters, ² and the like. Without the font ImGui's own does, which
/// lacks some of them.
void add_font(double scale) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  const auto size = static_cast<float>(kTextSize * scale);
  static const std::vector<ImWchar> ranges = {
      0x20, 0x24F, 0x370, 0x4FF, 0x2010, 0x2027, 0x2070, 0x209F, 0x2190, 0x21FF, 0x2200, 0x22FF, 0};
  const std::string path = RADIOSITY_FONT;
  if (std::filesystem::exists(path) &&
      fonts.AddFontFromFileTTF(path.c_str(), size, nullptr, ranges.data()) != nullptr) {
    return;
  }
  ImFontConfig config;
  config.SizePixels = static_cast<float>(13 * std::max(1.0, std::round(scale)));
  fonts.AddFontDefault(&config);
}

/// Mesa's renderers that use no graphics card.
bool is_software_renderer() {
  const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string name = text != nullptr ? text : "";
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos;
}

void set_style(double scale) {
  ImGui::GetStyle() = ImGuiStyle();  // sizes are scaled once
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.FrameRounding = 3;
  style.WindowBorderSize = 1;
  style.Colors[ImGuiCol_WindowBg] = ImVec4(0.10F, 0.105F, 0.12F, 1.0F);
  style.Colors[ImGuiCol_PopupBg] = style.Colors[ImGuiCol_WindowBg];
  style.Colors[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.4F);  // not pale, as if it were off
  style.ScaleAllSizes(static_cast<float>(scale));
}

}  // namespace

struct Window::Parts {
  Library library;
  GLFWwindow* window = nullptr;
  vtkNew<vtkGenericOpenGLRenderWindow> render_window;
  std::vector<vtkRenderer*> renderers;  // those that are in the render window
  std::optional<WindowEvents> events;
  double scale = 1;
  bool has_own_scale = false;  // not that of the screen
  bool is_software = false;
  bool is_antialiased = true;
  bool is_stale = false;  // what VTK keeps is not what the window shall show
  int width = 0;
  int height = 0;

  void draw_at_scale(double wanted) {
    if (wanted == scale) return;
    scale = wanted;
    set_style(scale);
    ImGui::GetIO().Fonts->Clear();
    add_font(scale);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }
};

Window::Window(const WindowOptions& asked) : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  const WindowOptions options = completed(asked);
  parts.scale = options.scale;
  parts.has_own_scale = asked.scale > 0;
  parts.window = open_window(options);
  glfwMakeContextCurrent(parts.window);
  glfwSwapInterval(1);
  glfwGetFramebufferSize(parts.window, &parts.width, &parts.height);

  parts.render_window->SetOwnContext(0);
  parts.render_window->SetReadyForRendering(true);
  parts.render_window->SetIsCurrent(true);
  parts.render_window->SetSupportsOpenGL(1);
  parts.render_window->SetFrameBlitModeToBlitToCurrent();
  parts.render_window->SetMultiSamples(kMultiSamples);
  parts.render_window->SetSize(parts.width, parts.height);
  parts.render_window->InitializeFromCurrentContext();
  parts.is_software = is_software_renderer();

  parts.events.emplace(parts.window);

  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leave no files about
  ImGui::GetIO().ConfigInputTextCursorBlink =
      false;  // or it would have to be drawn again and again
  set_style(parts.scale);
  add_font(parts.scale);
  ImGui_ImplGlfw_InitForOpenGL(parts.window, true);
  parts.events->hold();
  ImGui_ImplOpenGL3_Init("#version 150");
}

Window::~Window() {
  Parts& parts = *parts_;
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  set_renderers({});
  parts.render_window->Finalize();
  glfwDestroyWindow(parts.window);
}

bool Window::is_closing() const { return glfwWindowShouldClose(parts_->window) != 0; }
void Window::hide() {
  glfwHideWindow(parts_->window);
  glfwPollEvents();
}

void Window::close() { glfwSetWindowShouldClose(parts_->window, GLFW_TRUE); }
void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(parts_->window, title.c_str());
}
void Window::copy(const std::string& text) { glfwSetClipboardString(parts_->window, text.c_str()); }
void Window::resize(int width, int height) {
  // X ends programs that ask for none.
  glfwSetWindowSize(parts_->window, std::max(1, width), std::max(1, height));
}
int Window::width() const { return parts_->width; }
int Window::height() const { return parts_->height; }
double Window::scale() const { return parts_->scale; }

void Window::set_scale(double scale) {
  parts_->has_own_scale = true;
  parts_->draw_at_scale(scale);
}

bool Window::is_software() const { return parts_->is_software; }

void Window::set_antialiased(bool is_on) {
  if (is_on == parts_->is_antialiased) return;
  parts_->is_antialiased = is_on;
  parts_->render_window->SetMultiSamples(is_on ? kMultiSamples : 0);
  parts_->is_stale = true;
}

bool Window::handle_events(double seconds) {
  if (seconds > 0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
  parts_->events->end_poll();
  glfwGetFramebufferSize(parts_->window, &parts_->width, &parts_->height);
  const auto scale = parts_->events->take_screen_scale();  // of another screen that it was moved to
  if (scale && !parts_->has_own_scale) parts_->draw_at_scale(std::max(1.0, *scale));
  return parts_->events->take_any();
}

bool Window::is_shown() const {
  return glfwGetWindowAttrib(parts_->window, GLFW_ICONIFIED) == GLFW_FALSE;
}

void Window::begin_frame() {
  parts_->events->forward();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  parts_->events->place_mouse();
  ImGui::NewFrame();
}

void Window::end_frame(std::span<SceneView* const> views) {
  draw(views);
  glfwSwapBuffers(parts_->window);
}

io::RgbPicture Window::end_captured_frame(std::span<SceneView* const> views) {
  draw(views);
  io::RgbPicture picture = read_pixels();
  glfwSwapBuffers(parts_->window);
  return picture;
}

void Window::set_renderers(std::span<SceneView* const> views) {
  Parts& parts = *parts_;
  std::vector<vtkRenderer*> wanted;
  for (SceneView* view : views) wanted.push_back(&view->renderer());
  if (wanted == parts.renderers) return;
  for (vtkRenderer* renderer : parts.renderers) parts.render_window->RemoveRenderer(renderer);
  parts.renderers = std::move(wanted);
  for (vtkRenderer* renderer : parts.renderers) parts.render_window->AddRenderer(renderer);
  parts.is_stale = true;
}

void Window::draw(std::span<SceneView* const> views) {
  Parts& parts = *parts_;
  ImGui::Render();
  if (parts.width <= 0 || parts.height <= 0) return;
  set_renderers(views);
  const int* size = parts.render_window->GetSize();
  if (size[0] != parts.width || size[1] != parts.height) {
    parts.render_window->SetSize(parts.width, parts.height);
    parts.is_stale = true;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  const bool is_dirty = std::any_of(views.begin(), views.end(),
                                    [](const SceneView* view) { return view->is_dirty(); });
  if (is_dirty || parts.is_stale) {
    parts.render_window->Render();
    for (SceneView* view : views) view->set_drawn();
    parts.is_stale = false;
  } else {
    parts.render_window->Frame();  // VTK keeps its picture
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

io::RgbPicture Window::read_pixels() const {
  const Parts& parts = *parts_;
  io::RgbPicture picture{.width = parts.width, .height = parts.height, .bytes = {}};
  const std::size_t row = 3 * static_cast<std::size_t>(parts.width);
  picture.bytes.resize(row * parts.height);
  if (picture.bytes.empty()) return picture;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, parts.width, parts.height, GL_RGB, GL_UNSIGNED_BYTE, picture.bytes.data());
  // OpenGL counts rows from the bottom.
  for (int y = 0; y < parts.height / 2; ++y) {
    std::swap_ranges(picture.bytes.begin() + static_cast<std::ptrdiff_t>(row * y),
                     picture.bytes.begin() + static_cast<std::ptrdiff_t>(row * (y + 1)),
                     picture.bytes.end() - static_cast<std::ptrdiff_t>(row * (y + 1)));
  }
  return picture;
}

std::vector<std::string> Window::take_dropped_files() {
  return parts_->events->take_dropped_files();
}

std::vector<KeyPress> Window::take_keys() { return parts_->events->take_keys(); }

}  // namespace viewer
