#include "apps/commands/inspect_photometry.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "apps/run/shown_events.h"
#include "apps/summary/photometry_summary.h"
#include "apps/summary/summary.h"
#include "apps/summary/ugr_summary.h"
#include "apps/terminal/output_files.h"
#include "io/base/extension.h"
#include "io/light/photometric_file.h"
#include "io/light/polar_curve.h"
#include "io/light/polar_picture.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/scene/photometric_web.h"
#include "study/ugr_table.h"

namespace apps {

void inspect_photometry(const CommonOptions& common, WantsUgr wants_ugr,
                        Interruption& interruption) {
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
  std::optional<study::UgrTable> ugr;
  if (wants_ugr == WantsUgr::yes) {
    const radiosity::ThreadLimit threads(common.n_threads);
    ugr = study::make_ugr_table(photometry, {}, events);
  }
  print(common.json ? photometry_json(photometry, ugr ? &*ugr : nullptr, common.outputs,
                                      terminal.warnings())
                    : photometry_text(photometry, common.outputs) +
                          (ugr ? ugr_text(*ugr, radiosity::flux(photometry.web)) : std::string()));
}

}  // namespace apps
