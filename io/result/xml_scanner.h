#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace io {

/// Goes through the tags of an XML text one after the other. What it does not know (document type
/// definitions, CDATA) and what is not well formed ends the text with `is_damaged`.
class XmlScanner {
 public:
  /// `text` must outlive the scanner.
  explicit XmlScanner(std::string_view text) : text_(text) {}

  /// Goes to the next tag; false at the end and where the text is damaged.
  bool next();

  enum class Kind { start, end, empty };  ///< <a>, </a>, <a/>
  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The value of an attribute of the tag; "" if it has none.
  [[nodiscard]] std::string attribute(const std::string& key) const;
  [[nodiscard]] bool has(const std::string& key) const { return attributes_.contains(key); }
  /// The text between the last tag and this one.
  [[nodiscard]] std::string_view text_before() const { return before_; }
  /// The names of the elements that are open: those around a start or empty tag, and around the
  /// element that an end tag ends.
  [[nodiscard]] const std::vector<std::string>& around() const { return open_; }
  [[nodiscard]] bool is_damaged() const { return is_damaged_; }

 private:
  bool scan_tag();
  bool scan_attributes();
  bool skip(std::string_view end);
  void skip_blanks();
  std::string scan_name();

  std::string_view text_;
  std::string_view before_;
  Kind kind_ = Kind::start;
  std::string name_;
  std::map<std::string, std::string> attributes_;
  std::vector<std::string> open_;
  bool is_entering_ = false;  // the last tag has opened an element
  bool is_damaged_ = false;
};

}  // namespace io
