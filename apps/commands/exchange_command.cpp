#include "apps/commands/exchange_command.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <numeric>

#include "apps/run/assembled_scene.h"
#include "apps/run/shown_events.h"
#include "apps/summary/exchange_summary.h"
#include "apps/summary/summary.h"
#include "apps/terminal/machine.h"
#include "apps/terminal/number_list.h"
#include "apps/terminal/output_files.h"
#include "io/base/extension.h"
#include "io/result/node_numbers.h"
#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/base/parallel.h"
#include "radiosity/scene/emissivity_table.h"
#include "radiosity/scene/radiometry.h"

namespace apps {
namespace {

using radiosity::Index;

/// 1 - ρ of each patch's material, whatever heat is given to it. Throws SceneError unless it is the
/// same in all bands, and if nothing absorbs.
Eigen::VectorXd emissivities(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh) {
  const Eigen::MatrixXd all = radiosity::emissivity(scene, mesh);
  for (Index band = 1; band < all.cols(); ++band) {
    if (all.col(band) != all.col(0)) {
      throw radiosity::SceneError(fmt::format(
          "{}: couplings are those of one band, and surfaces reflect differently in the scene's {} "
          "bands; say \"bands\": \"grey\"",
          scene.source, all.cols()));
    }
  }
  const Eigen::VectorXd emissivity = all.col(0);
  if (!(emissivity.maxCoeff() > 0)) {
    throw radiosity::SceneError(
        fmt::format("{}: no surface emits: all have the emissivity 0", scene.source));
  }
  return emissivity;
}

/// The radiosity of each node's light, and what goes with it.
void check_memory(Index n_patches, Index n_nodes) {
  const auto needed = 2.5 * sizeof(double) * static_cast<double>(n_patches + 2 * n_nodes) *
                      static_cast<double>(n_nodes);
  const auto limit = static_cast<double>(radiosity::memory_limit(0));
  if (needed <= limit) return;
  throw radiosity::MemoryShortage(fmt::format(
      "couplings of {} nodes need {:.1f} GB beside the form factors, and {:.1f} GB can be used: "
      "fewer patches need less (--patches N), and so do couplings by surface",
      n_nodes, 1e-9 * needed, 1e-9 * limit));
}

}  // namespace

ExchangeCommand::ExchangeCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  compute_.tolerance = 1e-3;
  CLI::App* command = program.add_subcommand(
      "exchange",
      "Compute the radiative couplings between surfaces, reflections and all (Gebhart factors), "
      "for thermal networks");
  add_common_options(*command, common_);
  command
      ->add_option("-o,--output", common_.outputs,
                   "File of couplings: .csv, .h5 (HDF5), .esatan (GR conductors), .sinda or "
                   ".oppenheim (resistances of surfaces and of space); may be repeated")
      ->check(
          [](const std::string& path) { return check_extension(path, io::network_extensions()); })
      ->type_name("FILE")
      ->allow_extra_args(false);
  auto* by = command->add_option("--by", by_, "Nodes are surfaces or patches")
                 ->check(CLI::IsMember({"surface", "patch"}))
                 ->capture_default_str()
                 ->type_name("WHAT");
  command
      ->add_option("--nodes", nodes_,
                   "Node numbers by surface (.csv of lines surface,node); default: 1, 2 ... in the "
                   "scene's order")
      ->excludes(by)
      ->type_name("FILE");
  command->add_option("--space-node", space_node_, "Number of the node that stands for space")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{999'999'999}))
      ->capture_default_str()
      ->type_name("N");
  command->add_flag("--sigma", sinda_.has_sigma, "Conductors in .sinda times sigma, W/K4");
  command->add_flag("--positive", sinda_.is_positive,
                    "Conductors in .sinda with numbers above 0; default: below, as those of "
                    "radiation");
  command
      ->add_option("--min-coupling", min_coupling_,
                   "Leave out couplings of less than this share of what either node emits; the "
                   "others grow so that each node keeps what it exchanges")
      ->check(check_share)
      ->type_name("X");
  add_assembly_options(*command, compute_, operator_);
  command->callback([this] { run(); });
}

io::NamedNetwork ExchangeCommand::make_network(const study::Study& study,
                                               const radiosity::Progress& progress) const {
  const radiosity::PatchMesh& mesh = study.mesh;
  const bool by_patch = by_ == "patch";
  const Index n = by_patch ? mesh.size() : static_cast<Index>(mesh.surface_names.size());
  check_memory(mesh.size(), n);
  std::vector<std::int32_t> node = mesh.surface;
  if (by_patch) std::iota(node.begin(), node.end(), 0);
  io::NamedNetwork named{
      .network = radiosity::exchange_network(*study.transport, emissivities(study.scene, mesh),
                                             node, n, {.progress = progress}),
      .names = mesh.surface_names,
      .numbers = {},
      .space = space_node_};
  if (by_patch) {
    named.names.clear();
    for (Index i = 0; i < n; ++i) {
      named.names.push_back(fmt::format("{}/{}", mesh.surface_names[mesh.surface[i]], i));
    }
  }
  const auto& outputs = common_.outputs;
  if (std::any_of(outputs.begin(), outputs.end(), [](const std::string& output) {
        return io::lower_case_extension(output) == ".oppenheim";
      })) {
    named.black = radiosity::exchange_network(*study.transport, Eigen::VectorXd::Ones(mesh.size()),
                                              node, n, {.progress = progress});
  }
  named.numbers.resize(static_cast<std::size_t>(n));
  std::iota(named.numbers.begin(), named.numbers.end(), 1);
  return named;
}

void ExchangeCommand::run() const {
  keep_freed_memory();
  check_outputs(common_.outputs, common_.scene);
  if (nodes_) check_against_inputs(common_.outputs, {*nodes_});
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  study::StudyEvents events = shown_events(terminal, interruption_);
  std::optional<std::vector<std::int64_t>> numbers;
  events.divided = [&](const radiosity::Scene& scene, const study::Patches& patches) {
    (void)emissivities(scene, patches.mesh);
    if (radiosity::has_emissivity_tables(scene)) {
      events.warn(
          "emissivities that depend on the temperature count as at the materials' own "
          "temperatures, or at 300 K where these have none");
    }
    if (nodes_) {
      numbers = io::read_node_numbers(*nodes_, patches.mesh.surface_names, events.progress);
    }
  };
  const study::Study assembled = assemble_scene(common_, compute_, operator_, events);
  io::NamedNetwork named = make_network(assembled, events.progress);
  if (numbers) named.numbers = *numbers;
  if (named.network.to_space.any() &&
      std::find(named.numbers.begin(), named.numbers.end(), space_node_) != named.numbers.end()) {
    throw radiosity::SceneError(fmt::format(
        "node {} is both a surface's and space's: choose another by --space-node", space_node_));
  }
  ExchangeSummary summary{.study = assembled,
                          .named = named,
                          .outputs = common_.outputs,
                          .min_coupling = min_coupling_};
  if (min_coupling_ > 0) {
    summary.n_dropped = radiosity::drop_small_couplings(named.network, min_coupling_);
  }
  for (const std::string& output : common_.outputs) {
    const auto lock = interruption_.hold();
    io::write_network(output, named, sinda_);
  }
  print(common_.json ? exchange_json(summary, terminal.warnings()) : exchange_text(summary));
}

}  // namespace apps
