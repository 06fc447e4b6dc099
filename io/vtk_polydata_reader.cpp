#include "io/vtk_polydata_reader.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/line_reader.h"
#include "io/vtp_check.h"

namespace io {
namespace {

/// Keeps VTK from printing while it lives; one at a time, since all of VTK shares these settings.
class Silence {
 public:
  Silence()
      : lock_(mutex()),
        display_mode_(vtkOutputWindow::GetInstance()->GetDisplayMode()),
        verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~Silence() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::GetInstance()->SetDisplayMode(display_mode_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }

  std::lock_guard<std::mutex> lock_;
  int display_mode_;
  vtkLogger::Verbosity verbosity_;
};

/// "ERROR: In /vtk/file.cxx, line 9\nvtkClass (0x12): What is wrong\n\n" without all before and
/// behind "What is wrong", and in one line.
std::string essence(std::string_view text) {
  if (const auto address = text.find("): "); address != std::string_view::npos) {
    text.remove_prefix(address + 3);
  }
  std::string line(trimmed(text));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return line;
}

/// Collects the first message of the objects that it observes.
struct FirstError {
  std::string message;

  static void keep(vtkObject* /*caller*/, unsigned long /*event*/, void* self, void* text) {
    auto& error = *static_cast<FirstError*>(self);
    if (error.message.empty() && text != nullptr) error.message = essence(static_cast<char*>(text));
  }
};

}  // namespace

vtkSmartPointer<vtkPolyData> read_polydata(const std::filesystem::path& path) {
  check_vtp(path);
  const Silence silence;
  FirstError error;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(&FirstError::keep);
  observer->SetClientData(&error);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetReaderErrorObserver(observer);
  reader->SetParserErrorObserver(observer);
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName(path.c_str());
  try {
    reader->Update();
  } catch (const std::bad_alloc&) {
    fail(path, "is damaged: it holds less than it says, or more than fits into memory");
  } catch (const std::length_error&) {
    fail(path, "is damaged: it holds less than it says");
  }
  if (!error.message.empty()) fail(path, fmt::format("is damaged: {}", error.message));
  if (reader->GetErrorCode() != 0) fail(path, "is damaged");
  return reader->GetOutput();
}

}  // namespace io
