#include "apps/run/part_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/terminal/terminal_progress.h"
#include "radiosity/base/error.h"
#include "radiosity/base/work_file.h"

namespace apps {
namespace {

/// Parts that a message names, at most.
constexpr std::size_t kMostNamed = 8;

/// What is wrong with a part beside the first one; empty if nothing is.
std::string difference(const io::FactorPart& part, const io::FactorPart& first,
                       const std::string& first_file) {
  if (part.fingerprint == first.fingerprint && part.part.n_parts == first.part.n_parts) return "";
  if (part.geometry != first.geometry) {
    return fmt::format("is of another scene ({}) than {} ({})", part.scene, first_file,
                       first.scene);
  }
  if (part.part.n_parts != first.part.n_parts) {
    return fmt::format("is one of {} parts, but {} is one of {}", part.part.n_parts, first_file,
                       first.part.n_parts);
  }
  if (part.tolerance != first.tolerance) {
    return fmt::format("was made with --tolerance {:g}, but {} with {:g}", part.tolerance,
                       first_file, first.tolerance);
  }
  if (part.is_compressed != first.is_compressed) {
    const auto kind = [](bool is_compressed) { return is_compressed ? "compressed" : "all"; };
    return fmt::format("has {} form factors, but {} has {}: say --transport",
                       kind(part.is_compressed), first_file, kind(first.is_compressed));
  }
  if (part.program != first.program) {
    return fmt::format("was made by version {} of this program, but {} by {}", part.program,
                       first_file, first.program);
  }
  return fmt::format("was made of other patches or with other options than {}", first_file);
}

/// "3, 7, 9 and 20 others", counted from 1.
std::string names(const std::vector<std::size_t>& numbers) {
  const std::size_t n = std::min(numbers.size(), kMostNamed);
  std::vector<std::size_t> shown(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t& number : shown) ++number;
  std::string text = fmt::format("{}", fmt::join(shown, ", "));
  if (numbers.size() > n) text += fmt::format(" and {} others", numbers.size() - n);
  return text;
}

[[noreturn]] void refuse(const std::string& file, const std::string& reason) {
  throw radiosity::SceneError(fmt::format("{}: {}", file, reason));
}

}  // namespace

PartSet find_parts(const std::vector<std::string>& files, const radiosity::Progress& progress) {
  PartSet set;
  for (const std::string& file : files) {
    progress.check();
    const io::FactorPart part = io::PartReader(file).part();
    if (set.files.empty()) {
      set.common = part;
      set.files.resize(part.part.n_parts);
    }
    const std::string reason = difference(part, set.common, files.front());
    if (!reason.empty()) refuse(file, reason);
    std::filesystem::path& place = set.files[part.part.number];
    if (!place.empty()) {
      refuse(file, fmt::format("is part {} of {}, and so is {}", part.part.number + 1,
                               part.part.n_parts, place.string()));
    }
    place = file;
  }
  const std::size_t n_parts = set.common.part.n_parts;
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < n_parts; ++k) {
    if (set.files[k].empty()) missing.push_back(k);
  }
  if (!missing.empty()) {
    refuse(files.front(),
           fmt::format("of {} parts of {}, {} {} missing: {}", n_parts, set.common.scene,
                       missing.size(), missing.size() == 1 ? "is" : "are", names(missing)));
  }
  return set;
}

void gather_records(const PartSet& parts, const std::filesystem::path& work_file,
                    const radiosity::Progress& progress) {
  radiosity::WorkFile file(work_file);
  const auto n = static_cast<double>(parts.files.size());
  for (std::size_t k = 0; k < parts.files.size(); ++k) {
    io::PartReader(parts.files[k]).visit_records([&](std::span<const std::byte> bytes) {
      progress.check();
      file.append(bytes);
    });
    if (progress.report) progress.report("parts", static_cast<double>(k + 1), n, "parts");
  }
}

}  // namespace apps
