#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/read_options.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"
#include "study/study_options.h"
#include "viewer/work/factor_row.h"
#include "viewer/work/file_watch.h"
#include "viewer/work/iteration_record.h"
#include "viewer/work/job_progress.h"
#include "viewer/work/known.h"
#include "viewer/work/light_mix.h"
#include "viewer/work/light_path.h"
#include "viewer/work/mix_history.h"
#include "viewer/work/model.h"
#include "viewer/work/pipeline.h"
#include "viewer/work/worker.h"

namespace viewer {

/// A line in the console.
struct Message {
  bool is_error = false;
  std::string text;
  bool is_past = false;            ///< it was told before the file that is open
  bool is_about_openings = false;  ///< what it tells can be shown: `Show::unseen`
  bool is_about_file = false;      ///< it tells that what is open has changed on disk
};

/// The scene in the window, what is computed about it in the background, and the questions that a
/// person asks. Knows nothing of windows. Its methods are for one thread, which calls `update` now
/// and then; none of them takes long.
class Session {
 public:
  explicit Session(study::StudyOptions options = {}, io::ReadOptions reading = {});

  /// Begins to open a scene or result file, with this unit of its coordinates ("mm") if one is
  /// given. What is open stays, and goes on being solved, until the new one is there, and for good
  /// if that cannot be opened; the console tells why.
  void open(const std::string& path, const std::optional<std::string>& unit = {});
  /// Opens the same file again, in the same unit. It is announced anew if that fails and the file
  /// changes again. Throws SceneError if none is open.
  void reload();
  /// The file of those that were read that has since been written again; absent if none has. The
  /// console tells.
  [[nodiscard]] const std::optional<std::filesystem::path>& changed_file() const {
    return file_watch_.changed();
  }
  /// Solves the open scene anew with other patches. Where that cannot be, all stays as it is; the
  /// console tells why.
  void restart(const study::StudyOptions& options);
  /// Why the latest of them could not be; empty if it could, or is under way.
  [[nodiscard]] const std::optional<std::string>& refusal() const { return refusal_; }
  /// Holds the work in the background back, or lets it go on.
  void set_paused(bool is_on) { pause_.set(is_on); }
  [[nodiscard]] bool is_paused() const { return pause_.is_on(); }
  /// Gives up what is being computed; what is known so far stays.
  void stop();

  /// Takes in what the background has found out. Whether anything changed.
  bool update();
  /// Whether nothing is being computed any more that changes the picture or its errors.
  [[nodiscard]] bool is_settled() const;
  /// Whether nothing at all is being computed.
  [[nodiscard]] bool is_idle() const;
  /// What is being computed; not busy if nothing.
  [[nodiscard]] WorkStatus status() const;
  /// The same for a person.
  [[nodiscard]] const JobProgress& job() const { return job_; }

  /// The file that was last asked for, read or not; "" before there is any.
  [[nodiscard]] const std::string& asked_path() const { return asked_path_; }
  [[nodiscard]] bool is_open() const { return model_.mesh != nullptr; }
  [[nodiscard]] const Model& model() const { return model_; }
  /// Whether a scene is open whose surfaces radiate by their temperature: heat, nothing to see.
  [[nodiscard]] bool is_thermal() const;
  [[nodiscard]] const study::StudyOptions& options() const { return options_; }
  /// Absent until there is some.
  [[nodiscard]] const Light* light() const { return light_.get(); }
  /// All that is known now.
  [[nodiscard]] Known known() const {
    return {model_, light_, selected_, row_, light_path_, iteration_};
  }
  /// Whether the light is a result: solved, with its errors, and of the mix as it is now.
  [[nodiscard]] bool has_result() const { return light_ && light_->has_errors() && !changed_; }
  /// Whether the mix has changed and no light has it.
  [[nodiscard]] bool is_change_pending() const { return changed_.has_value(); }
  /// Whether a preview is still getting better.
  [[nodiscard]] bool is_previewing() const { return previewing_.is_busy(); }
  /// Seconds from the beginning until the light was solved; 0 if it is not.
  [[nodiscard]] double seconds_to_solve() const { return seconds_to_solve_; }
  /// Unshot share of the emitted power while light is a preview.
  [[nodiscard]] double unshot_share() const { return unshot_share_; }

  // What if.
  [[nodiscard]] const LightMix& mix() const { return mix_; }
  /// The mix of the scene file.
  [[nodiscard]] const LightMix& original_mix() const { return original_mix_; }
  void set_emitter(std::size_t emitter, double scale, bool is_on);
  void set_reflectance(std::size_t material, const Eigen::VectorXd& reflectance);
  /// Makes a surface a lamp of so many lumens (`with_lamp`), and solves again; lamps and materials
  /// stay as they are, but that cannot be undone. Throws as with_lamp does; SceneError if no scene
  /// is open.
  void make_lamp(std::int32_t surface, double lumens);
  /// Other sun and sky, at full strength. Throws std::invalid_argument unless there are as many.
  void set_daylight(const std::optional<radiosity::Sun>& sun,
                    const std::optional<radiosity::Sky>& sky);
  void reset_daylight();
  /// As in the file: one of them, or all.
  void reset_emitter(std::size_t emitter);
  void reset_material(std::size_t material);
  void reset_mix();
  /// Changes of one lamp or material until the next call are undone together.
  void begin_mix_step() { mix_history_.begin_step(); }
  [[nodiscard]] const MixHistory& mix_history() const { return mix_history_; }
  /// Takes the latest step of changes back, or forth again; nothing if there is none.
  void undo_mix();
  void redo_mix();
  /// Seconds from the latest change of the mix to light that has it; 0 if there is none yet.
  [[nodiscard]] double change_seconds() const { return change_seconds_; }
  /// Whether emitters can be mixed without solving.
  [[nodiscard]] bool can_superpose() const { return emitter_lights_ != nullptr; }

  // Ask.
  /// Throws std::out_of_range if there is no such patch.
  void select(std::optional<radiosity::Index> patch);
  [[nodiscard]] std::optional<radiosity::Index> selected() const { return selected_; }
  /// Its form factors; absent until they are found.
  [[nodiscard]] const FactorRow* row() const { return row_.get(); }
  /// Begins to find out where the selected patch's light comes from.
  void ask_light_path();
  /// Of the selected patch and the mix's reflectances; absent until asked for and found.
  [[nodiscard]] const LightPath* light_path() const { return light_path_.get(); }

  // Watch.
  /// Begins to record an iteration from darkness.
  void record_iteration(radiosity::Method method);
  void forget_iteration();
  [[nodiscard]] const IterationRecord* iteration() const { return iteration_.get(); }
  /// Whether lamps or materials have changed since it was begun: it is of other light.
  [[nodiscard]] bool is_iteration_stale() const { return iteration_mix_ != versions_.mix; }
  /// Curves, without frames, of other methods that were recorded of the same light.
  [[nodiscard]] const std::vector<std::shared_ptr<const IterationRecord>>& compared() const {
    return compared_;
  }

  // Console.
  void tell(const std::string& text) { add_message(false, text); }
  /// Unless it has been told since the file was opened.
  void tell_once(const std::string& text);
  void tell_error(const std::string& text) { add_message(true, text); }
  void clear_messages();
  [[nodiscard]] const std::deque<Message>& messages() const { return messages_; }

  /// Counts what changed, so that others know what to draw again.
  struct Versions {
    int file = 0;  ///< how many were opened
    int model = 0;
    int light = 0;
    int mix = 0;
    int selection = 0;
    int iteration = 0;
    int messages = 0;
  };
  [[nodiscard]] const Versions& versions() const { return versions_; }

 private:
  using Clock = std::chrono::steady_clock;

  void find_row();
  void forget_light_path();
  void keep_curve(radiosity::Method next);
  void take_file(OpenedFile file, Clock::time_point start);
  void start_preview();
  void start_shooting();
  void take_rough(std::shared_ptr<const radiosity::Transport> rough);
  void start_form_factors();
  void cancel_computing();
  void take_model(Model model);
  void take_light(Light light, const std::optional<LightMix>& mix);
  void mark_openings();
  [[nodiscard]] bool is_large() const;
  void take_mix(LightMix mix);
  void relight();
  void relight_anew();
  void start_light_task();
  void add_message(bool is_error, const std::string& text);

  study::StudyOptions options_;
  io::ReadOptions reading_;
  std::string asked_path_;
  std::optional<std::string> refusal_;
  Model model_;
  std::shared_ptr<const Light> light_;
  LightMix mix_;
  LightMix original_mix_;
  MixHistory mix_history_;
  std::shared_ptr<const radiosity::Transport> rough_;    // until the model has form factors
  std::shared_ptr<const EmitterLights> emitter_lights_;  // of the mix's reflectances, or none
  std::optional<radiosity::Index> selected_;
  std::shared_ptr<const FactorRow> row_;  // of the selected patch
  std::shared_ptr<const LightPath> light_path_;
  bool has_asked_ = false;  // for the light path; it may have failed
  std::shared_ptr<const IterationRecord> iteration_;
  int iteration_mix_ = 0;  // Versions::mix that it is of
  std::vector<std::shared_ptr<const IterationRecord>> compared_;
  std::deque<Message> messages_;
  Versions versions_;
  double unshot_share_ = 1;
  bool is_quick_running_ = false;  // light or preview have not come to their first picture
  bool is_relight_due_ = false;    // the mix has changed since it began
  double seconds_to_solve_ = 0;
  double change_seconds_ = 0;
  std::optional<Clock::time_point> changed_;  // and no light has it
  Clock::time_point start_;
  Clock::time_point created_ = Clock::now();
  JobProgress job_;

  Pause pause_;
  // Last, so that they end first.
  FileWatch file_watch_;
  Worker opening_;     // from the file to the patches
  Worker pipeline_;    // from the patches to the form factors
  Worker previewing_;  // meanwhile
  Worker lighting_;    // from form factors to light
  Worker asking_;
  Worker rows_;
  Worker recording_;
};

/// Whether what is open is all that it can become: solved, if it is a scene.
bool is_solved(const Session& session);

}  // namespace viewer
