#include "io/mesh/idf_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "io/base/line_reader.h"

namespace io {

std::string folded(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::vector<IdfObject> read_idf_objects(const std::filesystem::path& path,
                                        const radiosity::Progress& progress) {
  std::vector<IdfObject> objects;
  LineReader reader(path, progress);
  std::string field;
  bool is_open = false;  // between the type of an object and its semicolon
  while (reader.next_line()) {
    std::string_view line = reader.line();
    if (trimmed(line).starts_with("##")) {
      reader.fail("is a macro; expected a file that EPMacro has worked on");
    }
    line = line.substr(0, line.find('!'));
    for (const char c : line) {
      if (c != ',' && c != ';') {
        field += c;
        continue;
      }
      const std::string word(trimmed(field));
      field.clear();
      if (!is_open) {
        if (word.empty()) reader.fail("has an object without a type");
        objects.push_back({.type = word, .fields = {}, .line = reader.line_number()});
      } else {
        objects.back().fields.push_back(word);
      }
      is_open = c == ',';
    }
    if (!trimmed(field).empty()) field += ' ';
  }
  if (is_open) {
    fail(fmt::format("{}:{}", path.string(), objects.back().line),
         "the object has no end; expected a semicolon");
  }
  if (!trimmed(field).empty()) fail(path, "ends within an object; expected a semicolon");
  return objects;
}

}  // namespace io
