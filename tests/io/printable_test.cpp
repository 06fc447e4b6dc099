#include "io/base/printable.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "io/base/csv_field.h"

namespace {

/// Whether a terminal would do something else than show the text: C0, DEL, C1 raw or in UTF-8.
bool steers_terminal(const std::string& text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const auto before = k > 0 ? static_cast<unsigned char>(text[k - 1]) : 0;
    if (byte < 0x20 || byte == 0x7F) return true;
    const bool is_continued = before >= 0xC0 || (before >= 0x80 && before < 0xC0);
    if (byte >= 0x80 && byte < 0xA0 && (!is_continued || before == 0xC2)) return true;
  }
  return false;
}

TEST(Printable, LeavesWhatCanBeRead) {
  for (const std::string text : {"room.obj:41: face uses vertex 97", "Wände, 1 m² ≤ 2 μm",
                                 "部屋.obj", "\U0001F3E0 haus", "a  b", ""}) {
    EXPECT_EQ(io::printable(text), text);
  }
}

TEST(Printable, ReplacesWhatSteersTerminals) {
  EXPECT_EQ(io::printable("a\nb\tc\r\n"), "a b c  ");
  EXPECT_EQ(io::printable("\x1b[31mred\x1b]0;title\x07"), "?[31mred?]0;title?");
  EXPECT_EQ(io::printable("del\x7f"), "del?");
  EXPECT_EQ(io::printable("raw \x9b"
                          "31m"),
            "raw ?31m");
  EXPECT_EQ(io::printable("utf \xc2\x9b"
                          "31m"),
            "utf ?31m");
  EXPECT_EQ(io::printable("a\xc2\x85"
                          "b\xe2\x80\xa8"
                          "c"),
            "a b c");  // NEL, line separator
  EXPECT_EQ(io::printable("gpj.\xe2\x80\xae"
                          "exe"),
            "gpj.?exe");  // right-to-left
  EXPECT_EQ(io::printable("a\xe2\x81\xa6"
                          "b\xef\xbb\xbf"
                          "c"),
            "a?b?c");                                                          // isolate, BOM
  EXPECT_EQ(io::printable("\xc0\x8a|\xed\xa0\x80|\xf5\x80\x80\x80|\xe2\x82"),  // no UTF-8
            "??|???|????|??");
}

TEST(Printable, NothingSteersTerminalsWhateverTheBytes) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (std::size_t k = random() % 12; k > 0; --k) text += static_cast<char>(random());
    EXPECT_FALSE(steers_terminal(io::printable(text))) << i;
    EXPECT_EQ(io::printable(io::printable(text)), io::printable(text)) << i;
    EXPECT_FALSE(steers_terminal(io::in_quotes(text))) << i;
  }
}

TEST(Printable, CutsLongWordsAndTexts) {
  const std::string path = "/start/" + std::string(5000, 'x') + "/end.obj";
  const std::string cut = io::printable(path + ": no such file");
  EXPECT_LT(cut.size(), 300U);
  EXPECT_EQ(cut.rfind("/start/", 0), 0U);
  EXPECT_NE(cut.find("/end.obj: no such file"), std::string::npos);
  std::string list;
  for (int i = 0; i < 5000; ++i) list += "name" + std::to_string(i) + ", ";
  EXPECT_LT(io::printable(list).size(), 2100U);
  EXPECT_EQ(io::in_quotes("short"), "\"short\"");
  EXPECT_LT(io::in_quotes(std::string(5000, 'x')).size(), 50U);
  // Within a character nothing is cut.
  for (int n = 1; n < 8; ++n) {
    std::string umlauts(static_cast<std::size_t>(n), 'a');
    for (int i = 0; i < 3000; ++i) umlauts += "ü";
    EXPECT_EQ(io::printable(umlauts).find('?'), std::string::npos) << n;
    EXPECT_EQ(io::in_quotes(umlauts).find('?'), std::string::npos) << n;
  }
}

TEST(Printable, JsonMeansTheSame) {
  const std::string name = "a\x1b\x7f\xc2\x9b\xe2\x80\xae\xf3\xa0\x81\x81 ü\n\"";
  const nlohmann::json json = {{"name", name}, {"list", {1, 2}}};
  const std::string text = io::printable_json(json.dump(2));
  std::string without_layout;
  for (const char c : text) without_layout += c == '\n' ? ' ' : c;
  EXPECT_FALSE(steers_terminal(without_layout)) << text;
  EXPECT_EQ(nlohmann::json::parse(text), json);
  EXPECT_NE(text.find("ü"), std::string::npos);
}

/// As a reader of RFC 4180 does.
std::string without_quotes(std::string field) {
  if (field.empty() || field.front() != '"') return field;
  std::string text;
  for (std::size_t k = 1; k + 1 < field.size(); ++k) {
    text += field[k];
    if (field[k] == '"') ++k;
  }
  return text;
}

TEST(CsvField, BeginsNoFormulaAndReadsBack) {
  EXPECT_EQ(io::csv_field("floor"), "floor");
  EXPECT_EQ(io::csv_field("a-b=c"), "a-b=c");
  EXPECT_EQ(io::csv_field("=1+1"), "'=1+1");
  EXPECT_EQ(io::csv_field("@SUM(A1,B1)"), "\"'@SUM(A1,B1)\"");
  EXPECT_EQ(io::csv_field("'quoted'"), "'quoted'");
  EXPECT_EQ(io::csv_field("'=x"), "''=x");
  std::mt19937_64 random(3);
  const std::string letters = "=+-@\t\r\n'\",a1 ";
  for (int i = 0; i < 20000; ++i) {
    std::string name;
    for (std::size_t k = random() % 6; k > 0; --k) name += letters[random() % letters.size()];
    const std::string value = without_quotes(io::csv_field(name));
    EXPECT_EQ(std::string("=+-@\t\r\n").find(value.empty() ? 'a' : value[0]), std::string::npos)
        << name;
    EXPECT_EQ(io::csv_text(value), name);
  }
}

}  // namespace
