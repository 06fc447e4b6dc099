#include "apps/commands/inspect_photometry.h"

#include <fmt/format.h>

#include "apps/run/shown_events.h"
#include "apps/summary/photometry_summary.h"
#include "apps/summary/summary.h"
#include "apps/terminal/output_files.h"
#include "io/base/extension.h"
#include "io/light/photometric_file.h"
#include "io/light/polar_curve.h"
#include "io/light/polar_picture.h"
#include "radiosity/base/error.h"

namespace apps {

void inspect_photometry(const CommonOptions& common, Interruption& interruption) {
  for (const std::string& output : common.outputs) {
    const std::string extension = io::lower_case_extension(output);
    if (extension != ".svg" && extension != ".png") {
      throw radiosity::OutputError(
          fmt::format("{}: a luminaire's polar curve is drawn as .svg or .png", output));
    }
  }
  check_outputs(common.outputs, common.scene);
  TerminalProgress terminal(terminal_style(common));
  const study::StudyEvents events = shown_events(terminal, interruption);
  const radiosity::Photometry photometry = io::read_photometric_file(common.scene, events.progress);
  for (const std::string& warning : photometry.warnings) events.warn(warning);
  for (const std::string& output : common.outputs) {
    const auto lock = interruption.hold();
    if (io::lower_case_extension(output) == ".png") {
      io::write_polar_picture(output, photometry);
    } else {
      io::write_polar_curve(output, photometry);
    }
  }
  print(common.json ? photometry_json(photometry, common.outputs, terminal.warnings())
                    : photometry_text(photometry, common.outputs));
}

}  // namespace apps
