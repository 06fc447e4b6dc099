// What somebody waits for who looks at the Cornell box and changes it, on patches of equal size.
// Arguments: patches. The form factors are coarse, which is quick and makes no difference here.
#include <benchmark/benchmark.h>

#include <memory>
#include <utility>

#include "io/scene/scene_file.h"
#include "radiosity/radiosity.h"
#include "study/study.h"

namespace radiosity {
namespace {

constexpr double kPictureTolerance = 1e-3;

struct Room {
  explicit Room(long n_patches)
      : scene(io::read_scene(RADIOSITY_SCENES "/cornell-box.json")),
        // A room by itself needs no memory for form factors.
        options({.patches = {.n_patches = n_patches},
                 .tolerance = 0.5,
                 .storage = study::Storage::disk}),
        patches(study::divide(scene, options)),
        emitted(exitance(scene, patches.mesh)),
        rho(reflectance(scene, patches.mesh)) {}

  Scene scene;
  study::StudyOptions options;
  study::Patches patches;
  Eigen::MatrixXd emitted;
  Eigen::MatrixXd rho;
};

/// The room asked for last and its operator, kept from one benchmark to the next.
struct SolvedRoom : Room {
  explicit SolvedRoom(long n_patches)
      : Room(n_patches),
        transport(
            study::make_form_factors(scene, patches.mesh, patches.visibility, options).transport) {}
  std::unique_ptr<Transport> transport;
};

const SolvedRoom& solved_room(long n_patches) {
  static std::pair<long, std::unique_ptr<SolvedRoom>> kept;
  if (kept.first != n_patches) {
    kept.second.reset();
    kept = {n_patches, std::make_unique<SolvedRoom>(n_patches)};
  }
  return *kept.second;
}

void product(benchmark::State& state) {
  const SolvedRoom& room = solved_room(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(room.transport->apply(room.emitted));
  state.counters["patches"] = static_cast<double>(room.patches.mesh.size());
  state.counters["bytes"] = static_cast<double>(room.transport->bytes());
}

void row(benchmark::State& state) {
  const SolvedRoom& room = solved_room(state.range(0));
  Index i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(rows_of(*room.transport).row(i));
    i = (i + 7919) % room.patches.mesh.size();
  }
}

void solve_cold(benchmark::State& state) {
  const SolvedRoom& room = solved_room(state.range(0));
  Solution solution;
  for (auto _ : state) {
    solution = solve(*room.transport, room.emitted, room.rho,
                     {.tolerance = kPictureTolerance, .estimates_errors = false, .on_step = {}});
  }
  state.counters["products"] = solution.products;
}

/// The red wall gets lighter.
void solve_warm(benchmark::State& state) {
  const SolvedRoom& room = solved_room(state.range(0));
  const Solution before =
      solve(*room.transport, room.emitted, room.rho,
            {.tolerance = kPictureTolerance, .estimates_errors = false, .on_step = {}});
  Eigen::MatrixXd rho = room.rho;
  const PatchMesh& mesh = room.patches.mesh;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface_names[mesh.surface[i]] == "left") rho.row(i).array() += 0.1;
  }
  Solution solution;
  for (auto _ : state) {
    solution = solve(*room.transport, room.emitted, rho,
                     {.tolerance = kPictureTolerance,
                      .estimates_errors = false,
                      .start = before.irradiance,
                      .on_step = {}});
  }
  state.counters["products"] = solution.products;
  state.counters["bound"] = solution.error_bound;
}

void find_importance(benchmark::State& state) {
  const SolvedRoom& room = solved_room(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(importance(*room.transport, room.rho, room.patches.mesh.size() / 2,
                                        {.tolerance = kPictureTolerance, .on_step = {}}));
  }
}

void preview_shot(benchmark::State& state) {
  const Room room(state.range(0));
  ShootingPreview preview(room.patches.mesh, room.patches.visibility, room.emitted, room.rho);
  for (auto _ : state) preview.shoot();
  state.counters["unshot"] = preview.unshot_share();
}

/// Until so few per cent of the light are unshot.
void preview_until(benchmark::State& state) {
  const Room room(state.range(0));
  const double share = static_cast<double>(state.range(1)) / 100;
  int n_shots = 0;
  for (auto _ : state) {
    ShootingPreview preview(room.patches.mesh, room.patches.visibility, room.emitted, room.rho);
    while (preview.unshot_share() > share) preview.shoot();
    n_shots = preview.n_shots();
  }
  state.counters["shots"] = n_shots;
}

BENCHMARK(preview_shot)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(30000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(preview_until)
    ->ArgsProduct({{1000, 10000, 30000}, {50, 20, 5}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void register_with_operator() {
  for (const long n : {1000, 10000, 30000}) {
    const auto add = [n](const char* name, void (*function)(benchmark::State&)) {
      benchmark::RegisterBenchmark(name, function)
          ->Arg(n)
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->UseRealTime();
    };
    add("product", product);
    add("row", row);
    add("solve_cold", solve_cold);
    add("solve_warm", solve_warm);
    add("find_importance", find_importance);
  }
}

const bool kRegistered = (register_with_operator(), true);

}  // namespace
}  // namespace radiosity
