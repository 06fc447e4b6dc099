#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/solve/surface_flux.h"
#include "viewer/desk/camera_control.h"
#include "viewer/desk/comparison.h"
#include "viewer/desk/examples.h"
#include "viewer/desk/isolines.h"
#include "viewer/desk/legend.h"
#include "viewer/desk/look.h"
#include "viewer/desk/luminaire_facts.h"
#include "viewer/desk/orientation.h"
#include "viewer/desk/patch_facts.h"
#include "viewer/desk/region.h"
#include "viewer/desk/saved_views.h"
#include "viewer/desk/surface_groups.h"
#include "viewer/desk/surface_marks.h"
#include "viewer/desk/surface_totals.h"
#include "viewer/desk/tape.h"
#include "viewer/desk/watching.h"
#include "viewer/work/light_meter.h"
#include "viewer/work/network_finder.h"
#include "viewer/work/plan_meter.h"
#include "viewer/work/session.h"

namespace viewer {

/// What a file is about, and so what is shown of it at first.
enum class Domain {
  light,   ///< true colour
  heat,    ///< net flux: a scene whose surfaces radiate by their temperature
  factors  ///< form factors without any light
};

/// The name of what is shown of it at first.
const char* first_quantity(Domain domain);

/// Lines of the console, unless it is given more.
inline constexpr int kConsoleLines = 3;

/// From where a file is seen that is read again.
struct KeptSight {
  std::string path;
  UpAxis up = UpAxis::y;
  CameraControl camera;
};

/// Everything that the window shows. Panels, keys and scripts act on it through the functions below
/// and through its session, so that all can do the same.
struct Desk {
  explicit Desk(study::StudyOptions options = {}, io::ReadOptions reading = {})
      : session(std::move(options), std::move(reading)) {}

  Session session;
  Look look;
  Watching watching;
  CameraControl camera;
  std::optional<KeptSight> kept_sight = {};  ///< while it is read again
  std::vector<SavedView> views;              ///< the file's and new ones, kept while it is open
  Tape tape;
  bool is_meter_in_hand = false;  ///< clicks add points to the light meter
  UpAxis up = UpAxis::y;
  std::optional<UpAxis> asked_up = {};  ///< of all files; absent: guessed for each
  Domain domain = Domain::light;
  double exposure = 1;                         ///< automatic part, from radiosity to display value
  bool is_exposure_due = true;                 ///< it shall be found anew
  bool is_painting_due = false;                ///< the colours are not yet those of what is known
  std::optional<Legend> legend;                ///< of what is shown now
  std::vector<IsoNumber> iso_numbers;          ///< beside isolines
  Region region;                               ///< of the picture in the window
  std::optional<PatchFacts> facts;             ///< of the selected patch
  std::vector<radiosity::SurfaceFlux> fluxes;  ///< of the light, where surfaces radiate by heat
  std::vector<EmitterShare> emitter_shares;    ///< of its light, once the light path is known
  Pinning pinning = {};                        ///< light to compare with
  SurfaceMarks marks = {};                     ///< in list and picture
  SurfaceListing listing = SurfaceListing::surfaces;  ///< how surfaces are listed
  bool is_list_open = false;
  TotalOrder surface_order;                 ///< of the list
  std::vector<SurfaceTotal> totals;         ///< in that order; see `sorted_totals`
  Session::Versions totals_versions = {};   ///< at which these were found
  double scale = 1;                         ///< of text and lines, relative to a plain screen
  std::optional<double> wanted_scale = {};  ///< that the window shall take
  bool shows_panels = true;
  bool shows_help = false;
  int console_lines = kConsoleLines;
  std::optional<int> tour_step = {};            ///< that is shown
  std::optional<std::string> copied = {};       ///< text that shall go to the clipboard
  bool asks_light_path = false;                 ///< for each patch that is selected
  std::vector<LuminaireFacts> luminaires = {};  ///< of the scene
  std::shared_ptr<const radiosity::Scene> luminaires_of = {};  ///< that scene
  std::optional<std::size_t> chosen_luminaire = {};            ///< whose photometric solid is shown
  std::optional<std::size_t> hovered_luminaire = {};           ///< whose mark is under the mouse
  std::optional<radiosity::Index> hovered;                     ///< patch under the mouse
  std::optional<double> hovered_reading = {};  ///< of the work plane, if that is before it
  std::optional<int> function_key = {};        ///< the last one that was pressed, for scripts
  int shown_file = 0;                          ///< of Session::Versions
  Session::Versions facts_versions = {};       ///< at which the facts were found
  std::optional<std::string> screenshot;       ///< file that the next drawing shall be written to
  std::string saving = {};                     ///< file that is being written; "" if none is
  std::optional<std::string> save_error = {};  ///< why the latest one could not be
  /// Not to be overwritten, beside what is open and what it refers to.
  std::vector<std::filesystem::path> kept_files = {};
  PlanMeter plan = {};         ///< what the scene itself asks to be measured
  NetworkFinder network = {};  ///< couplings of a thermal scene
  LightMeter meter = {};       ///< among the last, so that they end first
  Worker saver = Worker();
  Worker summer = Worker();   ///< sums up surfaces
  Worker summing = Worker();  ///< sums up what is told of the selected patch
  Examples examples = {};
};

/// Brings the session and what is told of the selected patch up to date; a file that was opened is
/// shown from its camera, with a range of values that fits. Whether anything changed.
bool update(Desk& desk);

/// Opens what is open again, as it is on disk now: seen from where the camera is, with the same
/// quantity; lamps and materials are those of the file. Throws SceneError if nothing is open.
void reload(Desk& desk);

/// Shows what has that name (`show_named`), on a scale that suits it. Throws std::invalid_argument
/// if nothing has.
void show(Desk& desk, const std::string& name);

/// Begins to record an iteration from darkness and shows its first step.
void record_iteration(Desk& desk, radiosity::Method method);
/// Steps through the record by itself, so many steps per second.
void play_iteration(Desk& desk, double speed);

/// Moves the camera until it sees the whole scene from outside, in its direction.
void fit_camera(Desk& desk);
/// The scene's camera, or one that sees the whole scene.
void use_scene_camera(Desk& desk);
/// That of a view that was kept. Throws std::invalid_argument if none is called so.
void use_view(Desk& desk, const std::string& name);

/// Makes a surface a lamp (`Session::make_lamp`), and finds the exposure anew: it is another scene.
void make_lamp(Desk& desk, std::int32_t surface, double lumens);

/// Makes an axis point upwards and looks at the scene from outside.
void set_up(Desk& desk, UpAxis up);
/// Opens the file that is open again, with its coordinates in that unit ("mm"). Throws SceneError
/// for an unknown unit or if no scene is open.
void set_unit(Desk& desk, const std::string& unit);
/// The camera as the picture has it: its angle of view holds across the narrower side.
radiosity::Camera picture_camera(const Desk& desk);

/// What a point of the picture shows: a patch that is not hidden and whose emitting side is seen; x
/// and y in [0, 1] from its top left.
std::optional<radiosity::Hit> hit_at(const Desk& desk, double x, double y);
std::optional<radiosity::Index> patch_at(const Desk& desk, double x, double y);

/// What the mouse points at: "floor, 123.4 lux"; "" if it is nothing.
std::string hovered_text(const Desk& desk);

/// Makes text, panels and lines larger by so many quarters of their plain size, or smaller.
void enlarge(Desk& desk, int quarters);
/// Makes them as large as that; what would not fit or be read is brought into range.
void set_scale(Desk& desk, double scale);
/// Gives the console so many lines, at least one.
void set_console_lines(Desk& desk, int n_lines);
/// All messages, a line each, errors marked.
std::string messages_text(const Session& session);

/// Throws OutputError if a file must not be written, since what is open is read from it.
void check_output(const Desk& desk, const std::string& path);

/// Writes the light as .vtp, .csv or .ply. Throws OutputError, also if there is none, or none yet
/// that is a result: a preview, say, or one whose errors are not known.
void save_result(const Desk& desk, const std::string& path);
/// Begins to do so in the background, which may take seconds; the console tells when it is done, or
/// why it is not. Throws OutputError if there is nothing to write, or where it must not go.
void begin_save_result(Desk& desk, const std::string& path);
/// Writes the scene as the mix has it, with the camera as it stands and all views, as .json. Throws
/// OutputError, also if there is none.
void save_scene(const Desk& desk, const std::string& path);

}  // namespace viewer
