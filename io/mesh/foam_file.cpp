#include "io/mesh/foam_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "io/base/line_reader.h"

namespace io {
namespace {

using radiosity::Index;

constexpr std::string_view kSigns = "(){};[]";

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Where the token that begins at `begin` ends.
std::size_t end_of_token(std::string_view text, std::size_t begin) {
  if (kSigns.find(text[begin]) != std::string_view::npos) return begin + 1;
  if (text[begin] == '"') {
    const std::size_t end = text.find('"', begin + 1);
    return end == std::string_view::npos ? text.size() : end + 1;
  }
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end]) &&
         kSigns.find(text[end]) == std::string_view::npos) {
    ++end;
  }
  return end;
}

/// Where what follows a comment at `begin` begins; `begin` itself if there is none.
std::size_t behind_comment(std::string_view text, std::size_t begin) {
  const auto behind = [&](std::string_view end) {
    const std::size_t at = text.find(end, begin + 2);
    return at == std::string_view::npos ? text.size() : at + end.size();
  };
  if (text.substr(begin, 2) == "//") return behind("\n");
  if (text.substr(begin, 2) == "/*") return behind("*/");
  return begin;
}

}  // namespace

FoamTokens::FoamTokens(const std::filesystem::path& path) : path_(path) {
  input_size(path);
  std::ifstream file(path, std::ios::binary);
  text_.assign(std::istreambuf_iterator<char>(file), {});
  const std::string_view text = text_;
  long line = 1;
  std::size_t at = 0;
  while (at < text.size()) {
    std::size_t end = behind_comment(text, at);
    const bool is_token = end == at && !is_blank(text[at]);
    if (is_token) {
      end = end_of_token(text, at);
      tokens_.push_back(text.substr(at, end - at));
      lines_.push_back(line);
    }
    end = std::max(end, at + 1);
    line += std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                       text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    at = end;
  }
  if (peek() != "FoamFile") io::fail(path, "is no file of OpenFOAM: it has no FoamFile head");
  take();
  expect("{");
  while (peek() != "}") {
    const std::string_view key = take();
    const std::string_view value = take();
    while (take() != ";") continue;
    if (key == "format" && value != "ascii") {
      fail(fmt::format("is {}, expected ascii (foamFormatConvert with writeFormat ascii)",
                       value.substr(0, 20)));
    }
  }
  take();
}

std::string_view FoamTokens::peek() const { return at_end() ? std::string_view() : tokens_[next_]; }

std::string_view FoamTokens::take() {
  if (at_end()) fail("ends too early");
  return tokens_[next_++];
}

void FoamTokens::expect(std::string_view token) {
  const std::string_view found = take();
  if (found == token) return;
  --next_;
  fail(fmt::format("found \"{}\", expected {}", found.substr(0, 40), token));
}

Index FoamTokens::count() {
  const auto n = parse_number<Index>(take());
  if (n && *n >= 0 && *n <= std::ssize(tokens_) - static_cast<Index>(next_)) return *n;
  --next_;
  fail("expected a number of items that follow");
}

Index FoamTokens::whole() {
  const auto n = parse_number<std::int32_t>(take());
  if (n && *n >= 0) return *n;
  --next_;
  fail("expected a whole number, at least 0");
}

double FoamTokens::number() {
  const auto value = parse_number<double>(take());
  if (value && std::isfinite(*value)) return *value;
  --next_;
  fail("expected a number");
}

void FoamTokens::fail(const std::string& message) const {
  const long line = lines_.empty() ? 1 : lines_[std::min(next_, lines_.size() - 1)];
  io::fail(fmt::format("{}:{}", path_.string(), line), message);
}

std::vector<FoamPatch> read_foam_patches(const std::filesystem::path& boundary) {
  FoamTokens tokens(boundary);
  std::vector<FoamPatch> patches;
  const Index n = tokens.count();
  tokens.expect("(");
  for (Index p = 0; p < n; ++p) {
    FoamPatch patch{.name = std::string(tokens.take()), .groups = {}};
    tokens.expect("{");
    while (tokens.peek() != "}") {
      const std::string_view key = tokens.take();
      if (key == "nFaces") patch.n = tokens.whole();
      if (key == "startFace") patch.first = tokens.whole();
      for (auto word = tokens.take(); word != ";"; word = tokens.take()) {
        if (word == "{" || word == "}") tokens.fail("the entry before has no semicolon");
        if (key == "inGroups") patch.groups.emplace_back(word);
      }
    }
    tokens.expect("}");
    patches.push_back(std::move(patch));
  }
  tokens.expect(")");
  return patches;
}

std::vector<FoamPatch> read_radiating_patches(const std::filesystem::path& boundary) {
  std::vector<FoamPatch> patches = read_foam_patches(boundary);
  std::erase_if(patches, [](const FoamPatch& patch) {
    const auto& groups = patch.groups;
    return std::find(groups.begin(), groups.end(), "viewFactorWall") == groups.end();
  });
  if (patches.empty()) {
    fail(boundary, "has no patch of the group viewFactorWall, which those that radiate belong to");
  }
  return patches;
}

}  // namespace io
