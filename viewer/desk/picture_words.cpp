#include "viewer/desk/picture_words.h"

#include <fmt/format.h>

#include <cmath>

#include "viewer/desk/grids.h"
#include "viewer/desk/measuring.h"
#include "viewer/desk/pinning.h"
#include "viewer/work/standing.h"

namespace viewer {
namespace {

/// How many patches have a red outline, and why.
Standing openings_text(const Desk& desk) {
  const Known known = desk.session.known();
  const std::vector<std::int32_t>* patches = open_patches(known);
  if (patches == nullptr || patches->empty()) return {};
  const bool is_one = patches->size() == 1;
  return {.text = fmt::format("{} patch{} an opening: outlined in red", patches->size(),
                              is_one ? " sees" : "es see")};
}

/// How far what is shown can be trusted.
Standing shown_standing(const Desk& desk) {
  const Show show = desk.look.show;
  if (show == Show::unseen) return openings_text(desk);
  if (show == Show::area || show == Show::form_factors) return {};
  if (show != Show::watched && show != Show::unshot) return standing(desk.session);
  return {.text = watched_text(desk.session, desk.look)};
}

/// The same for the picture's corner.
Standing badge(const Desk& desk) {
  Standing now = shown_standing(desk);
  if (now.text.empty()) return now;
  if (shown_comparison(desk) != Comparison::none) now.text = "now: " + now.text;
  // A preview that is being shot always gets better.
  const bool is_shot = now.is_rough && !desk.session.light()->factor_error;
  if (desk.is_painting_due && !is_shot) {
    now.text += " (being painted)";
    now.is_result = false;
  }
  return now;
}

/// Whether there is no light yet, and will be none: nothing in the scene gives any.
bool will_be_dark(const Session& session) {
  const auto& scene = session.model().scene;
  return session.light() == nullptr && scene && session.mix().emitters.empty() &&
         scene->environment.kind == radiosity::Emission::Kind::none && scene->given_heat.empty();
}

/// What to say if what is to be shown is not there.
std::string missing_text(const Desk& desk) {
  const Session& session = desk.session;
  if (!session.is_open()) {
    if (session.status().is_busy) return "Opening ...";
    // Examples say so themselves.
    return desk.examples.list().empty() ? "Drop a scene or result file here, or press Ctrl+O" : "";
  }
  const Show show = desk.look.show;
  const bool is_painted = show == Show::true_color || show == Show::watched;
  if ((show == Show::watched || show == Show::unshot) && session.iteration() == nullptr) {
    return "Record an iteration in the panel 'Watch'";
  }
  const bool is_of_light = show == Show::true_color || show == Show::quantity;
  if (is_of_light && (is_without_lamps(session.known()) || will_be_dark(session))) {
    return "Nothing gives light: click a surface, or its name in Surfaces, and make it a lamp";
  }
  if (desk.legend || (is_painted && session.light() != nullptr)) return "";
  if (show == Show::work_plane) return "Work plane: " + readings_note(desk);
  if (show == Show::grid) return shown_grid(desk) ? "" : "Grid: " + grids_note(desk);
  if (is_wide(show)) {
    if (!session.model().factors) {
      return session.is_settled() ? "Form factors are not known" : "Waits for the form factors ...";
    }
    if (!session.selected()) return "Click a patch";
    if (show != Show::light_path && session.row() == nullptr) {
      return "Evaluating the form factors of this patch ...";
    }
    if (show == Show::light_path) return "Working out where the light comes from ...";
  }
  if (show == Show::unseen) {
    return session.is_settled() ? "Form factors are not known" : "Waits for the form factors ...";
  }
  return session.is_settled() ? "No light is known" : "Waits for the light ...";
}

}  // namespace

PictureWords picture_words(const Desk& desk) {
  Standing now = badge(desk);
  PictureWords words{.badge = std::move(now.text),
                     .is_result = now.is_result,
                     .message = missing_text(desk),
                     .is_message_central = !desk.session.is_open(),
                     .legend = desk.legend ? &*desk.legend : nullptr};
  if (shown_comparison(desk) == Comparison::wipe) {
    words.split = drawn_split(desk);
    words.pinned = "pinned: " + desk.pinning.light->standing;
  }
  return words;
}

double drawn_split(const Desk& desk) {
  if (desk.region.width <= 0) return desk.pinning.split;
  return std::round(desk.pinning.split * desk.region.width) / desk.region.width;
}

}  // namespace viewer
