#include "io/result/part_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "io/result/hdf5_growing.h"
#include "io/result/hdf5_input.h"
#include "io/result/hdf5_output.h"
#include "io/result/hdf5_patches.h"
#include "radiosity/base/error.h"

namespace io {
namespace {

using hdf5::Handle;
using hdf5::HdfError;
using hdf5::read_attribute;
using hdf5::write_attribute;
using radiosity::Closed;
using radiosity::ExpectedLight;

constexpr const char* kPartKind = "a part of form factors";
constexpr const char* kRecords = "records";
constexpr auto kPartRequired = std::to_array<const char*>({kRecords, "patches/area"});
/// Bytes that are read at once.
constexpr hsize_t kPiece = 1 << 24;

/// The fields of an ExpectedLight and their names.
template <typename Light, typename Take>
void for_each_field(Light& light, const Take& take) {
  take("exitance", light.exitance);
  take("reflectance", light.reflectance);
  take("emitted", light.emitted);
}

void write_light(hid_t file, const ExpectedLight& light) {
  const Handle group = hdf5::make_group(file, "light");
  for_each_field(light, [&](const char* name, const Eigen::MatrixXd& values) {
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = values;
    hdf5::write_dataset(group, name, std::vector<double>(rows.data(), rows.data() + rows.size()),
                        {static_cast<hsize_t>(rows.rows()), static_cast<hsize_t>(rows.cols())});
  });
}

/// A text of ours, which zeros may fill up.
std::string read_text(hid_t file, const char* name) {
  const std::optional<std::string> text = hdf5::find_text_attribute(file, name);
  if (!text) throw HdfError(fmt::format("has no attribute \"{}\"", name));
  return text->substr(0, text->find('\0'));
}

FactorPart read_part(hid_t file) {
  const auto number = read_attribute<std::int64_t>(file, "part");
  const auto n_parts = read_attribute<std::int64_t>(file, "parts");
  if (number < 1 || n_parts < number ||
      n_parts > static_cast<std::int64_t>(radiosity::kMostParts)) {
    throw HdfError(fmt::format("says it is part {} of {}", number, n_parts));
  }
  FactorPart part;
  part.part = {static_cast<std::size_t>(number - 1), static_cast<std::size_t>(n_parts)};
  part.is_compressed = read_attribute<std::int32_t>(file, "compressed") != 0;
  part.scene = read_text(file, "scene");
  part.program = read_text(file, "program");
  part.geometry = read_text(file, "geometry");
  part.fingerprint = read_text(file, "fingerprint");
  part.tolerance = read_attribute<double>(file, "tolerance");
  const auto closed = read_attribute<std::int32_t>(file, "closed_asked");
  if (closed < 0 || closed > static_cast<std::int32_t>(Closed::automatic)) {
    throw HdfError(fmt::format("the attribute \"closed_asked\" is {}", closed));
  }
  part.closed = static_cast<Closed>(closed);
  part.seed = static_cast<std::uint64_t>(read_attribute<std::int64_t>(file, "seed"));
  part.min_factor = read_attribute<double>(file, "min_factor");
  if (!(part.tolerance > 0) || !(part.min_factor >= 0 && part.min_factor < 1)) {
    throw HdfError("its tolerance or least form factor cannot be");
  }
  return part;
}

}  // namespace

void write_part(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                const FactorPart& part,
                const std::function<void(const radiosity::RecordVisitor&)>& visit_records) {
  hdf5::write_file(path, [&](hid_t file) {
    write_attribute(file, "version", kPartVersion);
    write_attribute(file, "part", static_cast<std::int64_t>(part.part.number + 1));
    write_attribute(file, "parts", static_cast<std::int64_t>(part.part.n_parts));
    write_attribute(file, "compressed", static_cast<std::int32_t>(part.is_compressed));
    write_attribute(file, "scene", part.scene);
    write_attribute(file, "program", part.program);
    write_attribute(file, "geometry", part.geometry);
    write_attribute(file, "fingerprint", part.fingerprint);
    write_attribute(file, "tolerance", part.tolerance);
    write_attribute(file, "closed_asked", static_cast<std::int32_t>(part.closed));
    write_attribute(file, "seed", static_cast<std::int64_t>(part.seed));
    write_attribute(file, "min_factor", part.min_factor);
    hdf5::write_mesh(file, mesh);
    if (part.is_compressed) write_light(file, part.light);
    hdf5::GrowingDataset<std::uint8_t> records(file, kRecords);
    visit_records([&](std::span<const std::byte> record) {
      // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes for HDF5
      records.append({reinterpret_cast<const std::uint8_t*>(record.data()), record.size()});
    });
    records.finish();
  });
}

struct PartReader::File {
  explicit File(const std::filesystem::path& name)
      : path(name), file(hdf5::open_file(name, kPartKind)) {
    hdf5::check_version(file, "part of form factors", kPartVersion, kPartRequired);
    part = read_part(file);
  }

  std::filesystem::path path;
  Handle file;
  FactorPart part;
};

PartReader::PartReader(const std::filesystem::path& path)
    : file_(hdf5::checked(path, [&] { return std::make_unique<File>(path); })) {}
PartReader::~PartReader() = default;
PartReader::PartReader(PartReader&& other) noexcept = default;
PartReader& PartReader::operator=(PartReader&& other) noexcept = default;

const std::filesystem::path& PartReader::path() const { return file_->path; }
const FactorPart& PartReader::part() const { return file_->part; }

radiosity::PatchMesh PartReader::read_mesh() const {
  return hdf5::checked(path(), [&] {
    std::vector<std::string> warnings;
    return hdf5::read_mesh(file_->file, warnings);
  });
}

ExpectedLight PartReader::read_light() const {
  return hdf5::checked(path(), [&] {
    ExpectedLight light;
    for_each_field(light, [&](const std::string& field, Eigen::MatrixXd& values) {
      const std::string name = "light/" + field;
      const std::vector<hsize_t> shape = hdf5::Dataset(file_->file, name.c_str()).shape;
      if (shape.size() != 2) throw HdfError(fmt::format("/{} is no table", name));
      const auto all = hdf5::read_all<double>(file_->file, name.c_str(), shape);
      using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      values = Eigen::Map<const Rows>(all.data(), static_cast<Eigen::Index>(shape[0]),
                                      static_cast<Eigen::Index>(shape[1]));
    });
    return light;
  });
}

void PartReader::visit_records(const radiosity::RecordVisitor& visit) const {
  hdf5::checked(path(), [&] {
    const hdf5::Dataset records(file_->file, kRecords);
    if (records.shape.size() != 1) records.fail("is no list of bytes");
    hdf5::require_numbers<std::int32_t>(records);
    for (hsize_t first = 0; first < records.shape[0]; first += kPiece) {
      const auto piece = hdf5::read_slice<std::uint8_t>(records, first,
                                                        std::min(kPiece, records.shape[0] - first));
      visit(std::as_bytes(std::span(piece)));
    }
  });
}

bool has_intact_part(const std::filesystem::path& path, radiosity::WorkPart part,
                     const std::string& fingerprint) {
  try {
    if (!std::filesystem::exists(path)) return false;
    const PartReader reader(path);
    const FactorPart& found = reader.part();
    if (found.fingerprint != fingerprint || found.part.number != part.number ||
        found.part.n_parts != part.n_parts) {
      return false;
    }
    reader.visit_records([](std::span<const std::byte>) {});
    return true;
  } catch (const radiosity::SceneError&) {
    return false;
  }
}

}  // namespace io
