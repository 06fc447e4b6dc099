#include "tests/support/reader_fuzz.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <random>
#include <stdexcept>

#include "io/result/form_factor_file.h"
#include "io/result/form_factor_reader.h"
#include "io/result/result_file.h"
#include "io/result/result_reader.h"
#include "io/scene/scene_file.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"
#include "tests/support/damaged_files.h"
#include "tests/support/matrix_transport.h"
#include "tests/support/sample_files.h"
#include "tests/support/shapes.h"

namespace radiosity::test {
namespace {

using Random = std::mt19937_64;

constexpr double kLongest = 10;              // s
constexpr std::size_t kLargest = 1'000'000;  // bytes of a mutant
constexpr std::size_t kLongestMessage = 2100;

std::size_t below(Random& random, std::size_t n) {
  return n == 0 ? 0 : static_cast<std::size_t>(random() % n);
}

/// Files that belong together: the first is opened, any may be damaged.
struct Seed {
  std::vector<std::pair<std::string, std::string>> files;  // name and content
};

template <std::size_t N>
std::string pick(Random& random, const std::array<std::string_view, N>& choices) {
  return std::string(choices[below(random, N)]);
}

void flip(std::string& text, Random& random) {
  if (!text.empty()) text[below(random, text.size())] ^= static_cast<char>(1 << below(random, 8));
}

void replace_byte(std::string& text, Random& random) {
  static constexpr std::string_view kBytes("\0\xff\x80\n\r\t \"{}[],:\\/#-.e0", 20);
  if (!text.empty()) text[below(random, text.size())] = kBytes[below(random, kBytes.size())];
}

void cut_off(std::string& text, Random& random) { text.resize(below(random, text.size() + 1)); }

void take_out(std::string& text, Random& random) {
  const std::size_t at = below(random, text.size() + 1);
  text.erase(at, below(random, 1 + std::min<std::size_t>(text.size() - at, 64)));
}

void double_part(std::string& text, Random& random) {
  const std::size_t at = below(random, text.size() + 1);
  const std::string part = text.substr(at, below(random, 200));
  text.insert(below(random, text.size() + 1), part);
}

/// One line, many times.
void repeat_line(std::string& text, Random& random) {
  const std::size_t at = below(random, text.size() + 1);
  const std::size_t begin = text.rfind('\n', at) == std::string::npos ? 0 : text.rfind('\n', at);
  const std::string line = text.substr(begin, std::min<std::size_t>(text.find('\n', at), 200));
  if (line.empty()) return;
  const std::size_t n = std::size_t{1} << below(random, 13);
  std::string lines;
  for (std::size_t k = 0; k < n && lines.size() < kLargest / 2; ++k) lines += line;
  text.insert(std::min(begin + line.size(), text.size()), lines);
}

/// Digits become another number.
void replace_number(std::string& text, Random& random) {
  static constexpr std::array<std::string_view, 18> kNumbers = {"0",
                                                                "-1",
                                                                "1",
                                                                "2",
                                                                "255",
                                                                "65536",
                                                                "1e308",
                                                                "-1e308",
                                                                "1e-320",
                                                                "nan",
                                                                "inf",
                                                                "1e999",
                                                                "2147483647",
                                                                "2147483648",
                                                                "4294967295",
                                                                "9223372036854775807",
                                                                "-9223372036854775808",
                                                                "99999999999999999999999"};
  const std::string_view digits = "0123456789";
  const std::size_t at = text.find_first_of(digits, below(random, text.size() + 1));
  if (at == std::string::npos) return;
  const std::size_t end = std::min(text.find_first_not_of(digits, at), text.size());
  text.replace(at, end - at, pick(random, kNumbers));
}

/// Bytes become a number as binary files hold it.
void replace_binary_number(std::string& text, Random& random) {
  static constexpr std::array<std::uint64_t, 12> kNumbers = {0,
                                                             1,
                                                             0xff,
                                                             0x7f,
                                                             0xffff,
                                                             0x7fffffff,
                                                             0x80000000,
                                                             0xffffffff,
                                                             0x7fffffffffffffff,
                                                             0xffffffffffffffff,
                                                             0x7f800000,
                                                             0x7fc00000};
  const std::size_t size = std::size_t{1} << below(random, 4);
  if (text.size() < size) return;
  text.replace(below(random, text.size() - size + 1), size,
               bytes(kNumbers[below(random, kNumbers.size())]).substr(0, size));
}

void nest(std::string& text, Random& random) {
  static constexpr std::array<std::string_view, 6> kOpening = {
      "[", "{\"a\":", "[{\"children\":", "(", "<a>", "o \\\n"};
  const std::string opening = pick(random, kOpening);
  const std::size_t n = std::size_t{1} << below(random, 17);
  std::string many;
  for (std::size_t k = 0; k < n && many.size() < kLargest / 2; ++k) many += opening;
  text.insert(below(random, text.size() + 1), many);
}

void put_in_token(std::string& text, Random& random) {
  static constexpr std::array<std::string_view, 12> kTokens = {"\xef\xbb\xbf",
                                                               "\xff\xfe",
                                                               "\x1b[31m",
                                                               "\x7f",
                                                               "\xc2\x9b"
                                                               "1m",
                                                               "../../",
                                                               "#",
                                                               "\\\n",
                                                               "/",
                                                               "%2e",
                                                               "\n\n\n",
                                                               "-"};
  const std::size_t at = below(random, text.size() + 1);
  if (below(random, 4) == 0) {
    text.insert(at, std::string(std::size_t{1} << below(random, 18), 'x'));
  } else {
    text.insert(at, pick(random, kTokens));
  }
}

void mutate(std::string& text, Random& random) {
  using Change = void (*)(std::string&, Random&);
  static constexpr std::array<Change, 12> kChanges = {
      flip,     flip,        replace_byte, replace_number,        replace_number, cut_off,
      take_out, double_part, repeat_line,  replace_binary_number, nest,           put_in_token};
  const std::size_t n = 1 + below(random, 4);
  for (std::size_t k = 0; k < n; ++k) kChanges[below(random, kChanges.size())](text, random);
  if (text.size() > kLargest) text.resize(kLargest);
}

PatchMesh small_mesh() {
  PatchMesh mesh;
  add_box(mesh, Vec3(0, 0, 0), Vec3(1, 1, 1), 1, Facing::inwards);
  return mesh;
}

std::string written(const std::filesystem::path& path) {
  std::string content = file_bytes(path);
  std::filesystem::remove(path);
  return content;
}

std::string vtp(const std::filesystem::path& folder) {
  const PatchMesh mesh = small_mesh();
  Solution solution;
  solution.radiosity = Eigen::MatrixXd::Constant(mesh.size(), 1, 0.7);
  solution.irradiance = 2 * solution.radiosity;
  solution.exitance = solution.radiosity;
  solution.reflectance = 0.1 * solution.radiosity;
  solution.radiosity_error = 1e-3 * solution.radiosity;
  solution.energy = {.emitted = Eigen::VectorXd::Constant(1, 1. / 3),
                     .absorbed = Eigen::VectorXd::Constant(1, 1. / 7),
                     .escaped = Eigen::VectorXd::Constant(1, 0)};
  const auto path = folder / "seed.vtp";
  io::write(path, mesh, solution);
  return written(path);
}

std::string small_form_factor_file(const std::filesystem::path& folder) {
  const PatchMesh mesh = small_mesh();
  const auto area = Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size());
  const Eigen::MatrixXd exchange = Eigen::MatrixXd::Constant(mesh.size(), mesh.size(), 0.1);
  const radiosity::test::DenseTestTransport transport(exchange, area);
  const auto path = folder / "seed.h5";
  io::write_form_factors(path, mesh, transport);
  return written(path);
}

std::vector<Seed> seeds(const std::string& format, const std::filesystem::path& folder) {
  const std::pair<std::string, std::string> mtl = {"materials.mtl", kMtl};
  const std::pair<std::string, std::string> bin = {"data.bin", gltf_buffer()};
  if (format == "obj") return {{{{"a.obj", kObj}, mtl}}};
  if (format == "vs3") return {{{{"a.vs3", kVs3}}}, {{{"a.vs3", kVs3a}}}};
  if (format == "idf") return {{{{"a.idf", kIdf}}}};
  if (format == "epJSON") return {{{{"a.epJSON", kEpJson}}}};
  if (format == "foam") {
    std::filesystem::create_directories(folder / "constant/polyMesh");
    return {{{{"a.foam", ""},
              {"constant/polyMesh/boundary", kFoamBoundary},
              {"constant/polyMesh/faces", kFoamFaces},
              {"constant/polyMesh/points", kFoamPoints}}}};
  }
  if (format == "off") return {{{{"a.off", kOff}}}};
  if (format == "msh") {
    return {{{{"a.msh", kMsh2}}},
            {{{"a.msh", kMsh41}}},
            {{{"a.msh", binary_msh(2, std::endian::little)}}},
            {{{"a.msh", binary_msh(4, std::endian::big)}}}};
  }
  if (format == "stl") return {{{{"a.stl", kAsciiStl}}}, {{{"a.stl", binary_stl()}}}};
  if (format == "ply") {
    return {{{{"a.ply", kAsciiPly}}},
            {{{"a.ply", binary_ply(std::endian::little)}}},
            {{{"a.ply", binary_ply(std::endian::big)}}}};
  }
  if (format == "gltf") return {{{{"a.gltf", gltf_json(R"("uri": "data.bin", )")}, bin}}};
  if (format == "glb") return {{{{"a.glb", glb()}}}};
  if (format == "json" || format == "csv") {
    Seed seed{{{"a.json", kJson}, {"spectra.csv", kCsv}, {"square.off", kOff}}};
    if (format == "csv") std::swap(seed.files[0], seed.files[1]);  // the first is damaged
    return {seed};
  }
  if (format == "vtk") {
    return {{{{"a.vtk", legacy_vtk(4, VtkValues::text)}}},
            {{{"a.vtk", legacy_vtk(5, VtkValues::binary)}}}};
  }
  if (format == "vtu") return {{{{"a.vtu", kVtu}}}};
  if (format == "vtp") return {{{{"a.vtp", vtp(folder)}}}};
  if (format == "h5") {
    return {{{{"a.h5", small_form_factor_file(folder)}}}};
  }
  throw std::invalid_argument("no such format to fuzz: " + format);
}

void read_file(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".vtp") {
    (void)io::read_result(path);
  } else if (extension == ".h5") {
    const io::FormFactorReader reader(path);
    for (Index i = 0; i < reader.size(); ++i) {
      (void)reader.row(i);
      (void)reader.row_error(i);
    }
  } else {
    (void)io::read_scene(path);
  }
}

/// What is wrong with a message; empty if nothing is.
std::string message_fault(const std::string& message) {
  if (message.empty()) return "an empty message";
  if (message.size() > kLongestMessage) return "a message of " + std::to_string(message.size());
  for (const char c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return "control characters: " + message;
  }
  return "";
}

/// Whether the exception is one of those that the program tells in one line.
std::string read_fault(const std::filesystem::path& path, bool& was_read) {
  was_read = false;
  try {
    read_file(path);
    was_read = true;
  } catch (const SceneError& error) {
    return message_fault(error.what());
  } catch (const std::exception& error) {
    return std::string("another exception: ") + error.what();
  }
  return "";
}

}  // namespace

const std::vector<std::string>& fuzz_formats() {
  static const std::vector<std::string> formats = {"obj",  "ply", "stl",  "off",    "msh", "vs3",
                                                   "gltf", "glb", "json", "csv",    "vtk", "vtu",
                                                   "vtp",  "h5",  "idf",  "epJSON", "foam"};
  return formats;
}

FuzzReport fuzz_reader(const std::string& format, std::uint64_t first, long n,
                       const std::filesystem::path& folder) {
  const std::vector<Seed> all = seeds(format, folder);
  FuzzReport report;
  const std::string opened = format == "csv" ? "a.json" : all[0].files[0].first;
  for (const Seed& seed : all) {  // undamaged they must be read, or nothing would be shown
    for (const auto& [name, content] : seed.files) write_bytes(folder / name, content);
    bool was_read = false;
    const std::string fault = read_fault(folder / opened, was_read);
    if (!was_read) report.faults.push_back(format + ": the undamaged file is refused: " + fault);
  }
  for (std::uint64_t number = first; number < first + static_cast<std::uint64_t>(n); ++number) {
    std::seed_seq sequence(format.begin(), format.end());
    std::array<std::uint32_t, 2> words{};
    sequence.generate(words.begin(), words.end());
    Random random(number * 0x9E3779B97F4A7C15U + words[0]);
    Seed seed = all[below(random, all.size())];
    const bool damages_first = format == "csv" || below(random, 2) == 0;
    mutate(seed.files[damages_first ? 0 : below(random, seed.files.size())].second, random);
    for (const auto& [name, content] : seed.files) write_bytes(folder / name, content);

    const auto start = std::chrono::steady_clock::now();
    bool was_read = false;
    std::string fault = read_fault(folder / opened, was_read);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (fault.empty() && seconds > kLongest) fault = "took " + std::to_string(seconds) + " s";
    if (!fault.empty()) {
      report.faults.push_back(format + " mutant " + std::to_string(number) + ": " + fault);
    }
    ++(was_read ? report.n_read : report.n_refused);
    report.slowest = std::max(report.slowest, seconds);
  }
  return report;
}

}  // namespace radiosity::test
