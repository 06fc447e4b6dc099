#include "io/result/vtp_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "io/base/line_reader.h"
#include "io/base/printable.h"
#include "io/result/vtp_data.h"
#include "io/result/vtp_values.h"
#include "io/result/xml_scanner.h"

namespace io {
namespace {

constexpr std::string_view kAppended = "<AppendedData";
constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();  // points, cells, rows
/// All values together may be so many times the file. Single arrays that are all alike shrink
/// more, but never all.
constexpr std::uint64_t kMostExpansion = 100;
constexpr std::uint64_t kSmallValues = 1 << 24;  // bytes that any file may expand to

class VtpReader {
 public:
  enum class Accepts { polygons, any };
  VtpReader(const std::filesystem::path& path, Accepts accepts)
      : path_(path),
        is_any_kind_(accepts == Accepts::any),
        size_(input_size(path)),
        stream_(path, std::ios::binary) {
    if (!stream_) fail(path_, "cannot be read");
    allowance_ = kSmallValues + kMostExpansion * size_;
  }

  VtpFile read() {
    read_head();
    check_end();
    XmlScanner tags(head_);
    if (!tags.next() || tags.name() != "VTKFile") fail(path_, "is not a .vtp file (VTK XML)");
    read_root(tags);
    while (tags.next()) read_tag(tags);
    if (tags.is_damaged() && !is_cut_) damaged("its XML is not well formed");
    if (n_pieces_ != 1) fail(path_, fmt::format("has {} pieces, expected 1", n_pieces_));
    if (file_.n_points > 0 && file_.points.type.empty()) damaged("it has no points");
    return std::move(file_);
  }

 private:
  [[noreturn]] void damaged(const std::string& what) const { fail(path_, "is damaged: " + what); }

  /// All up to the values at the end, if they stand there as they are.
  void read_head() {
    constexpr std::size_t kStep = 1 << 16;
    std::string piece(kStep, '\0');
    std::size_t searched = 0;
    std::size_t appended = std::string::npos;
    while (stream_ && appended == std::string::npos) {
      searched = head_.size() - std::min(head_.size(), kAppended.size());
      stream_.read(piece.data(), kStep);
      head_.append(piece.data(), static_cast<std::size_t>(stream_.gcount()));
      appended = head_.find(kAppended, searched);
      // A file that is something else need not be read on.
      if (head_.size() <= kStep && head_.find("<VTKFile") == std::string::npos) {
        fail(path_, "is not a .vtp file (VTK XML)");
      }
    }
    if (appended != std::string::npos) read_appended(appended);
  }

  void read_appended(std::size_t place) {
    while (stream_ && head_.find('>', place) == std::string::npos) head_ += next_bytes();
    XmlScanner tag(std::string_view(head_).substr(place));
    if (!tag.next()) damaged("its data have no beginning");
    const std::string encoding = tag.attribute("encoding");
    if (encoding != "raw" && encoding != "base64") damaged("the encoding of its data is unknown");
    while (stream_ && head_.find('_', head_.find('>', place)) == std::string::npos) {
      if (head_.size() > place + (1 << 16)) break;
      head_ += next_bytes();
    }
    const std::size_t tag_end = std::min(head_.find('>', place), head_.size() - 1);
    const std::size_t start = head_.find_first_not_of(" \t\r\n", tag_end + 1);
    if (start == std::string::npos || head_[start] != '_') damaged("its data have no beginning");
    data_ = start + 1;
    if (encoding == "base64") {
      while (stream_) head_ += next_bytes();
      base64_ = head_.substr(data_);
      base64_.resize(std::min(base64_.find('<'), base64_.size()));
    }
    head_.resize(place);
    is_cut_ = true;
  }

  std::string next_bytes() {
    std::string piece(1 << 16, '\0');
    stream_.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    piece.resize(static_cast<std::size_t>(stream_.gcount()));
    return piece;
  }

  void check_end() {
    std::string tail(std::min<std::uint64_t>(size_, 256), '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(size_ - tail.size()));
    stream_.read(tail.data(), static_cast<std::streamsize>(tail.size()));
    if (tail.find("</VTKFile>") == std::string::npos) {
      fail(path_, "is cut off: it ends before its </VTKFile>");
    }
  }

  void read_root(const XmlScanner& root) {
    const std::string kind = root.attribute("type");
    if (kind == "UnstructuredGrid" && is_any_kind_) {
      file_.kind = VtkKind::unstructured;
    } else if (kind != "PolyData") {
      fail(path_, std::string("is a VTK file of another kind, expected PolyData (.vtp)") +
                      (is_any_kind_ ? " or UnstructuredGrid (.vtu)" : ""));
    }
    const std::string header = root.attribute("header_type");
    if (!header.empty() && header != "UInt32" && header != "UInt64") {
      damaged(fmt::format("the header_type {} is unknown", in_quotes(header)));
    }
    encoding_.word = header == "UInt64" ? 8 : 4;
    if (root.attribute("byte_order") == "BigEndian") encoding_.order = std::endian::big;
    encoding_.compressor = root.attribute("compressor");
    if (!is_known_compressor(encoding_.compressor)) {
      fail(path_, fmt::format("is compressed by {}, expected vtkZLibDataCompressor or "
                              "vtkLZ4DataCompressor",
                              in_quotes(encoding_.compressor)));
    }
  }

  void read_tag(const XmlScanner& tag) {
    const bool is_end = tag.kind() == XmlScanner::Kind::end;
    if (is_end && is_array(tag.name()) && array_) {
      text_ += tag.text_before();
      end_array();
      return;
    }
    if (array_) {
      // An InformationKey in it has texts of its own.
      if (!is_end && is_array(tag.around().back())) text_ += tag.text_before();
      return;
    }
    if (is_end) return;
    if (tag.name() == "Piece") read_piece(tag);
    if (!is_array(tag.name()) || tag.around().empty()) return;
    section_ = tag.around().back();
    array_ = start_array(tag);
    if (array_ && tag.kind() == XmlScanner::Kind::empty) end_array();
  }

  static bool is_array(const std::string& name) { return name == "DataArray" || name == "Array"; }

  void read_piece(const XmlScanner& piece) {
    ++n_pieces_;
    file_.n_points = count(piece, "NumberOfPoints", "the piece");
    if (file_.kind == VtkKind::unstructured) {
      file_.n_polygons = count(piece, "NumberOfCells", "the piece");
      return;
    }
    file_.n_polygons = count(piece, "NumberOfPolys", "the piece");
    file_.n_verts_and_lines =
        count(piece, "NumberOfVerts", "the piece") + count(piece, "NumberOfLines", "the piece");
    for (const char* other : {"NumberOfVerts", "NumberOfLines", "NumberOfStrips"}) {
      file_.n_other_cells += count(piece, other, "the piece");
    }
  }

  /// A number that an attribute gives; 0 if it is not there.
  [[nodiscard]] std::uint64_t count(const XmlScanner& tag, const char* name,
                                    const std::string& who) const {
    if (!tag.has(name)) return 0;
    const auto number = parse_number<std::uint64_t>(tag.attribute(name));
    if (!number || *number > kMost) {
      damaged(fmt::format("{} has the {} {}", who, name, in_quotes(tag.attribute(name))));
    }
    return *number;
  }

  struct OpenArray {
    std::string name;
    std::string format;
    std::optional<std::uint64_t> offset;
    std::optional<std::uint64_t> n_bytes;  // that there must be; absent: any number
    VtpArray values;
  };

  /// Nothing for arrays of parts of the file that are not read.
  std::optional<OpenArray> start_array(const XmlScanner& tag) {
    OpenArray array;
    array.name = tag.attribute("Name");
    array.format = tag.attribute("format");
    array.values.type = tag.attribute("type");
    const std::string label = fmt::format("array {}", in_quotes(array.name));
    if (array.values.type == "Bit") return std::nullopt;  // for nothing that is read
    const std::size_t size = vtp_type_size(array.values.type);
    if (size == 0) damaged(fmt::format("{} has the type {}", label, in_quotes(array.values.type)));
    const std::uint64_t n_rows = count(tag, "NumberOfTuples", label);
    array.values.n_components = 1;
    if (tag.has("NumberOfComponents")) {
      array.values.n_components = count(tag, "NumberOfComponents", label);
      if (array.values.n_components == 0) damaged(label + " has no columns");
    }
    array.offset = parse_number<std::uint64_t>(tag.attribute("offset"));
    std::optional<std::uint64_t> rows = rows_of_section(array.name, n_rows);
    if (!rows && section_ != cells_section() && section_ != "FieldData") return std::nullopt;
    if (array.values.type == "String") rows.reset();  // of any length
    if (rows) {
      if (*rows * array.values.n_components > kMost) damaged(label + " has too many values");
      array.n_bytes = *rows * array.values.n_components * size;
    }
    return array;
  }

  /// The part of the file that has the cells' corners.
  [[nodiscard]] const char* cells_section() const {
    return file_.kind == VtkKind::unstructured ? "Cells" : "Polys";
  }

  /// How many rows an array of the part of the file that we are in must have, if that is known.
  [[nodiscard]] std::optional<std::uint64_t> rows_of_section(const std::string& name,
                                                             std::uint64_t n_given) const {
    if (section_ == "Points") return file_.n_points;
    if (section_ == "CellData") return file_.n_polygons + file_.n_other_cells;
    if (section_ == cells_section() && (name == "offsets" || name == "types")) {
      return file_.n_polygons;
    }
    if (section_ == "FieldData") return n_given;
    return std::nullopt;
  }

  void end_array() {
    OpenArray array = *std::exchange(array_, std::nullopt);
    const std::string text = std::exchange(text_, "");
    const std::string label = fmt::format("array {}", in_quotes(array.name));
    auto bytes = array.format == "ascii" ? text_values(array, text) : stored_values(array, text);
    if (!bytes || bytes->size() % vtp_type_size(array.values.type) != 0) {
      damaged(fmt::format("the data of {} are not as they should be", label));
    }
    array.values.bytes = *std::move(bytes);
    VtpFile::Arrays* arrays = section_ == "CellData"    ? &file_.cells
                              : section_ == "FieldData" ? &file_.fields
                                                        : &file_.polygons;
    if (section_ == "Points") {
      file_.points = std::move(array.values);
    } else if (!arrays->try_emplace(array.name, std::move(array.values)).second) {
      damaged(label + " is there twice");
    }
  }

  std::optional<std::string> text_values(const OpenArray& array, std::string_view text) {
    std::string clean(text);
    std::replace(clean.begin(), clean.end(), '\n', ' ');
    std::string bytes;
    Words words(clean);
    for (auto word = words.next(); !word.empty(); word = words.next()) {
      if (!append_value(word, array.values.type, bytes)) return std::nullopt;
    }
    if (array.n_bytes && bytes.size() != *array.n_bytes) return std::nullopt;
    return bytes;
  }

  std::optional<std::string> stored_values(const OpenArray& array, std::string_view text) {
    std::optional<std::string> bytes;
    if (array.format == "binary") {
      bytes = read_vtp_data(base64_source(text), encoding_, array.n_bytes, allowance_);
    } else if (array.format == "appended" && data_ > 0 && array.offset && *array.offset < size_) {
      bytes = read_vtp_data(appended_source(*array.offset), encoding_, array.n_bytes, allowance_);
    }
    if (!bytes) return std::nullopt;
    allowance_ -= bytes->size();
    if (encoding_.order != std::endian::native) {
      reverse_bytes(*bytes, vtp_type_size(array.values.type));
    }
    return bytes;
  }

  VtpSource appended_source(std::uint64_t offset) {
    if (!base64_.empty()) {
      return base64_source(
          std::string_view(base64_).substr(std::min<std::uint64_t>(offset, base64_.size())));
    }
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(data_ + offset));
    return [this](char* bytes, std::size_t n) {
      return static_cast<bool>(stream_.read(bytes, static_cast<std::streamsize>(n)));
    };
  }

  const std::filesystem::path& path_;
  bool is_any_kind_;
  std::uint64_t size_;
  std::ifstream stream_;
  std::string head_;         // the XML, up to the appended values
  bool is_cut_ = false;      // before them
  std::uint64_t data_ = 0;   // where appended values start; 0 = there are none
  std::string base64_;       // appended values, if they are stored so
  std::uint64_t allowance_;  // bytes that values may still take
  VtpEncoding encoding_;
  VtpFile file_;
  int n_pieces_ = 0;
  std::string section_;             // around the array
  std::optional<OpenArray> array_;  // whose end has not come
  std::string text_;                // in it
};

}  // namespace

VtpFile read_vtp(const std::filesystem::path& path) {
  return VtpReader(path, VtpReader::Accepts::polygons).read();
}

VtpFile read_vtk_xml(const std::filesystem::path& path) {
  return VtpReader(path, VtpReader::Accepts::any).read();
}

}  // namespace io
