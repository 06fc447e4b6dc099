#include "tests/support/desktop.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "tests/support/wait_until.h"

extern char** environ;

namespace radiosity::test {
namespace {

using DisplayPointer = std::unique_ptr<Display, decltype(&XCloseDisplay)>;

DisplayPointer open_display() {
  // Windows may be gone by the time that something is asked of them.
  XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
  return {XOpenDisplay(nullptr), &XCloseDisplay};
}

/// The bytes of a property of format 8 or 32; empty if the window has none of that name.
std::string property(Display* display, Window window, const char* name) {
  Atom type = 0;
  int format = 0;
  unsigned long n = 0;
  unsigned long left = 0;
  unsigned char* bytes = nullptr;
  XGetWindowProperty(display, window, XInternAtom(display, name, False), 0, 1024, False,
                     AnyPropertyType, &type, &format, &n, &left, &bytes);
  std::string value;
  if (bytes != nullptr) value.assign(reinterpret_cast<char*>(bytes), format == 32 ? 8 * n : n);
  if (bytes != nullptr) XFree(bytes);
  return value;
}

/// The first window, at any depth, that is as wanted.
std::optional<Window> find_window(Display* display, Window below,
                                  const std::function<bool(Window)>& is_wanted) {
  if (is_wanted(below)) return below;
  Window root = 0;
  Window parent = 0;
  Window* children = nullptr;
  unsigned n = 0;
  std::optional<Window> found;
  if (XQueryTree(display, below, &root, &parent, &children, &n) == 0) return found;
  for (unsigned k = 0; k < n && !found; ++k) {
    found = find_window(display, children[k], is_wanted);
  }
  if (children != nullptr) XFree(children);
  return found;
}

/// Who drags the files: a window of its own that others are told of and ask for them.
struct Source {
  Display* display;
  Window window;
  Window target;
  std::string list;  // of the files, as text/uri-list

  [[nodiscard]] Atom atom(const char* name) const { return XInternAtom(display, name, False); }

  void send(const char* type, const std::array<long, 4>& more) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(window);
    for (int k = 0; k < 4; ++k) event.xclient.data.l[k + 1] = more.at(k);
    XSendEvent(display, target, False, NoEventMask, &event);
    XFlush(display);
  }

  void answer(const XSelectionRequestEvent& request) const {
    XChangeProperty(display, request.requestor, request.property, request.target, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(list.data()),
                    static_cast<int>(list.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    XSendEvent(display, request.requestor, False, NoEventMask, &event);
    XFlush(display);
  }

  /// Answers what is asked until a message of that type comes; whether it has.
  [[nodiscard]] bool has_heard(const char* type) const {
    return wait_until([&] {
      while (XPending(display) > 0) {
        XEvent event;
        XNextEvent(display, &event);
        if (event.type == SelectionRequest) answer(event.xselectionrequest);
        if (event.type == ClientMessage && event.xclient.message_type == atom(type)) return true;
      }
      return false;
    });
  }
};

}  // namespace

WindowManager::WindowManager() {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  std::array<const char*, 3> arguments = {"openbox", "--sm-disable", nullptr};
  if (posix_spawnp(&pid_, "openbox", &actions, nullptr, const_cast<char**>(arguments.data()),
                   environ) != 0) {
    pid_ = -1;
  }
  posix_spawn_file_actions_destroy(&actions);
  const DisplayPointer display = open_display();
  if (!is_there() || !display) return;
  wait_until([&] {
    const Window root = DefaultRootWindow(display.get());
    return !property(display.get(), root, "_NET_SUPPORTING_WM_CHECK").empty();
  });
}

WindowManager::~WindowManager() {
  if (!is_there()) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
}

WindowPlace window_place(const std::string& title_end) {
  const DisplayPointer display = open_display();
  WindowPlace place;
  if (!display) return place;
  const Window root = DefaultRootWindow(display.get());
  const auto window = find_window(display.get(), root, [&](Window candidate) {
    return property(display.get(), candidate, "WM_NAME").ends_with(title_end);
  });
  XWindowAttributes attributes;
  if (!window || XGetWindowAttributes(display.get(), *window, &attributes) == 0) return place;
  Window child = 0;
  XTranslateCoordinates(display.get(), *window, root, 0, 0, &place.left, &place.top, &child);
  place.width = attributes.width;
  place.height = attributes.height;
  return place;
}

bool drop_files(const std::vector<std::string>& paths) {
  const DisplayPointer display = open_display();
  if (!display) return false;
  const Window root = DefaultRootWindow(display.get());
  const auto target = find_window(display.get(), root, [&](Window candidate) {
    return !property(display.get(), candidate, "XdndAware").empty();
  });
  if (!target) return false;
  const Window window = XCreateSimpleWindow(display.get(), root, 0, 0, 1, 1, 0, 0, 0);
  Source source{display.get(), window, *target, {}};
  for (const std::string& path : paths) source.list += "file://" + path + "\r\n";
  XSetSelectionOwner(display.get(), source.atom("XdndSelection"), window, CurrentTime);
  constexpr long kVersion = 5;
  source.send("XdndEnter", {kVersion << 24, static_cast<long>(source.atom("text/uri-list")), 0, 0});
  const auto copy = static_cast<long>(source.atom("XdndActionCopy"));
  source.send("XdndPosition", {0, 0, CurrentTime, copy});
  if (!source.has_heard("XdndStatus")) return false;
  source.send("XdndDrop", {0, CurrentTime, 0, 0});
  return source.has_heard("XdndFinished");
}

}  // namespace radiosity::test
