#include "viewer/draw/painted_state.h"

#include "viewer/desk/pinning.h"

namespace viewer {

bool is_same_look(const Look& a, const Look& b) {
  const bool is_same_range =
      a.range.has_value() == b.range.has_value() &&
      (!a.range || (a.range->low == b.range->low && a.range->high == b.range->high &&
                    a.range->logarithmic == b.range->logarithmic));
  return a.show == b.show && a.quantity == b.quantity && a.band == b.band && is_same_range &&
         a.fit.low_percent == b.fit.low_percent && a.fit.high_percent == b.fit.high_percent &&
         a.map == b.map && a.hidden == b.hidden && a.outlines == b.outlines &&
         a.isolines == b.isolines && a.numbers == b.numbers && a.logarithmic == b.logarithmic &&
         a.grid == b.grid && a.tick_spacing == b.tick_spacing && a.stops == b.stops &&
         a.smooth == b.smooth && a.step == b.step;
}

bool PaintedState::is_other_look(const Desk& desk) const {
  const Session::Versions& now = desk.session.versions();
  const bool is_selection_shown = is_wide(desk.look.show);  // all of them are about that patch
  return !is_same_look(look, desk.look) || versions.model != now.model ||
         subtracted != subtracted_light(desk) ||
         (is_selection_shown && versions.selection != now.selection);
}

bool PaintedState::is_stale(const Desk& desk) const {
  const Session::Versions& now = desk.session.versions();
  return is_other_look(desk) || (is_light && desk.is_exposure_due) || versions.light != now.light ||
         versions.iteration != now.iteration;
}

}  // namespace viewer
