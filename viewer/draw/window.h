#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/picture/rgb_picture.h"
#include "viewer/desk/key_press.h"
#include "viewer/draw/scene_view.h"

namespace viewer {

/// There is no window to be had: no display, or its OpenGL is too old. The message says so in one
/// line and offers `radiosity render`.
struct WindowError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct WindowOptions {
  std::string title = "radiosity";
  int width = 0;     ///< pixels; 0 = what suits the scale and the screen
  int height = 0;    ///< pixels; likewise
  double scale = 0;  ///< of text and panels; 0 = what the screen asks for
};

/// A window of the desktop with an OpenGL context that VTK and Dear ImGui share. Of one thread.
class Window {
 public:
  /// Opens it. Throws WindowError.
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  [[nodiscard]] bool is_closing() const;
  void close();
  /// Takes it from the screen. What is being computed may take seconds to end.
  void hide();
  void set_title(const std::string& title);
  void resize(int width, int height);
  /// Of the framebuffer, pixels; 0 x 0 while it is minimised.
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  /// Size of text and panels relative to a plain screen.
  [[nodiscard]] double scale() const;
  /// Makes text and panels another size, from the next frame on; what the screen asks for no longer
  /// counts. Not to be called within a frame.
  void set_scale(double scale);

  /// Whether OpenGL is done by the processor, which then has less time for other things.
  [[nodiscard]] bool is_software() const;
  /// Whether edges are smoothed; on by default. Costs most of the time if OpenGL is software.
  void set_antialiased(bool is_on);

  /// Handles what has happened at keyboard and mouse, waiting at most `seconds` for it. Whether
  /// there was anything, or something was to be drawn again.
  bool handle_events(double seconds);
  /// Whether there is anything to be drawn: not while the window is minimised.
  [[nodiscard]] bool is_shown() const;
  /// Begins a frame of ImGui.
  void begin_frame();
  /// Draws the scene, if that is needed, and the panels above it, and shows them. Nothing is drawn
  /// while the window has no size. `views` are parts of the picture side by side.
  void end_frame(std::span<SceneView* const> views);
  /// The same, and returns what is shown: 0 x 0 pixels if the window has no size.
  io::RgbPicture end_captured_frame(std::span<SceneView* const> views);

  /// Puts text where other programs find it to paste.
  void copy(const std::string& text);
  /// Files that were dropped onto the window since the last call.
  std::vector<std::string> take_dropped_files();
  /// Keys that were pressed since the last call, however short, in that order.
  std::vector<KeyPress> take_keys();

 private:
  void draw(std::span<SceneView* const> views);
  void set_renderers(std::span<SceneView* const> views);
  [[nodiscard]] io::RgbPicture read_pixels() const;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace viewer
