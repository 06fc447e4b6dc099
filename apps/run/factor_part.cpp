#include "apps/run/factor_part.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <string_view>
#include <utility>
#include <vector>

#include "radiosity/stream/streamed_part.h"
#include "radiosity/version.h"

namespace apps {
namespace {

std::optional<std::size_t> as_count(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Measures from its start on.
class PartClock {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::optional<radiosity::WorkPart> parse_part(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const auto number = as_count(std::string_view(text).substr(0, slash));
  const auto n_parts = as_count(std::string_view(text).substr(slash + 1));
  if (!number || !n_parts || *number < 1 || *number > *n_parts ||
      *n_parts > radiosity::kMostParts) {
    return std::nullopt;
  }
  return radiosity::WorkPart{*number - 1, *n_parts};
}

std::string check_part(const std::string& text) {
  if (parse_part(text)) return "";
  return fmt::format("found '{}', expected a part such as 3/16: the third of 16", text);
}

std::filesystem::path part_path(const std::filesystem::path& output, radiosity::WorkPart part) {
  std::filesystem::path path = output;
  path.replace_filename(fmt::format("{}.{}-of-{}{}", output.stem().string(), part.number + 1,
                                    part.n_parts, output.extension().string()));
  return path;
}

io::FactorPart described_part(const radiosity::Scene& scene, const study::StudyOptions& options,
                              const radiosity::Fingerprint& fingerprint, radiosity::WorkPart part) {
  return {.part = part,
          .is_compressed = options.transport == radiosity::TransportKind::compressed,
          .scene = std::filesystem::path(scene.source).filename().string(),
          .program = std::string(radiosity::kVersion),
          .geometry = study::geometry_fingerprint(scene),
          .fingerprint = fingerprint.text(),
          .tolerance = study::factor_tolerance(options),
          .closed = study::closedness(scene, options.closed),
          .seed = options.seed,
          .light = {}};
}

MadePart write_streamed_part(const std::filesystem::path& path, const study::Patches& patches,
                             const io::FactorPart& part, const radiosity::StreamOptions& options,
                             radiosity::TileStore& store, Interruption& interruption) {
  const PartClock clock;
  MadePart summary{.part = part.part};
  radiosity::make_streamed_part(patches.mesh, patches.visibility, options, part.part, store);
  const auto lock = interruption.hold();
  io::write_part(path, patches.mesh, part, [&](const radiosity::RecordVisitor& visit) {
    radiosity::visit_part_records(store, part.part, [&](std::span<const std::byte> record) {
      ++summary.records;
      summary.bytes += record.size();
      visit(record);
    });
  });
  summary.seconds = clock.seconds();
  return summary;
}

MadePart write_compressed_part(const std::filesystem::path& path, const radiosity::Scene& scene,
                               const study::Patches& patches, io::FactorPart part,
                               const study::StudyOptions& options, const study::StudyEvents& events,
                               Interruption& interruption) {
  const PartClock clock;
  MadePart summary{.part = part.part};
  part.light = study::expected_light(scene, patches.mesh, events.progress);
  std::vector<std::byte> records;
  radiosity::make_compressed_part(patches.mesh, patches.visibility,
                                  study::transport_options(scene, options, events), part.light,
                                  part.part, [&](std::span<const std::byte> record) {
                                    ++summary.records;
                                    records.insert(records.end(), record.begin(), record.end());
                                  });
  summary.bytes = records.size();
  const auto lock = interruption.hold();
  io::write_part(path, patches.mesh, part,
                 [&](const radiosity::RecordVisitor& visit) { visit(records); });
  summary.seconds = clock.seconds();
  return summary;
}

}  // namespace apps
