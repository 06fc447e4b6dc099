#pragma once

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"
#include "apps/terminal/terminal_progress.h"
#include "study/study.h"

namespace apps {

/// How progress is shown: not at all with --quiet, else as stderr allows.
TerminalProgress::Style terminal_style(const CommonOptions& common);

/// Warnings and progress that are shown by `terminal`, and stopped by `interruption`.
study::StudyEvents shown_events(TerminalProgress& terminal, const Interruption& interruption);

}  // namespace apps
