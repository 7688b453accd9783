// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/missing_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <system_error>
#include <vector>

#include "treadmark/core/output_claim.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 100;

char small(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Names of a folder, not more than people could mean.
std::vector<std::string> names_in(const fs::path& folder) {
  constexpr std::size_t kMost = 10000;
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator one(folder, code), end; !code && one != end && names.size() < kMost; one.increment(code))
    names.push_back(one->path().filename().string());
  ranges::sort(names);
  return names;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  const auto same = [&](std::size_t i, std::size_t j) { return small(a[i - 1]) == small(b[j - 1]); };
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(i, j) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j)) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  if (name.empty() || name.size() > kLongestName) return {};
  std::string best;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
  least = std::min(least, name.size());  // nothing of a short name may be all new
  for (const std::string& one : candidates) {
    if (one.size() > kLongestName) continue;
    const std::size_t distance = edit_distance(name, one);
    if (distance >= least) continue;
    least = distance;
    best = one;
  }
  return best;
}

std::string advice_on_name(std::string_view name, std::span<const std::string> known, const std::string& otherwise) {
  if (const std::string near = nearest_name(name, known); !near.empty()) return "did you mean '" + near + "'?";
  if (!otherwise.empty()) return otherwise;
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "choose " : ", ") + one;
  return all;
}

std::string advice_on_missing(const fs::path& file, const std::string& otherwise) {
  std::error_code code;
  std::string portable = file.string();
  ranges::replace(portable, '\\', '/');
  if (portable != file.string() && fs::exists(portable, code)) return "did you mean " + portable + "?";
  for (const fs::path& part : file)
    if (part == "~" || part.string().starts_with("$"))
      return "'" + part.string() + "' is not replaced here: write the folder";
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code)) {
    std::string there = folder == file || !folder.has_filename() ? std::string() : advice_on_missing(folder);
    if (there.starts_with("did you mean")) return there;
    return otherwise.empty() ? "there is no folder " + folder.string() : otherwise;
  }
  const std::vector<std::string> names = names_in(folder);
  std::string near = nearest_name(file.filename().string(), names);
  if (near.empty())  // the extension forgotten, or another one
    for (const std::string& one : names)
      if (near.empty() && !file.stem().empty() && fs::path(one).stem() == file.stem()) near = one;
  if (near.empty()) return otherwise.empty() ? "check its name and folder" : otherwise;
  return "did you mean " + (file.has_parent_path() ? folder / near : fs::path(near)).string() + "?";
}

void require_file(const fs::path& file, std::string_view what, ErrorKind kind, const SourcePosition& where) {
  std::error_code code;
  const fs::file_status status = fs::status(file, code);
  const SourcePosition place = where.file.empty() ? SourcePosition{file.string(), 0, 0} : where;
  // Its own name is told by the place, unless that is where it is named.
  const std::string name = where.file.empty() ? std::string() : " '" + file.string() + "'";
  if (status.type() == fs::file_type::not_found)
    throw MissingFile(kind, "the " + std::string(what) + name + " does not exist", place, advice_on_missing(file));
  if (fs::is_character_file(status) || fs::is_block_file(status))
    throw Error(kind, "a " + std::string(what) + " is expected," + (name.empty() ? " this" : name) + " is a device",
                place, "name a file");
  refuse_output_as_input(file);
  if (fs::is_directory(status))
    throw Error(kind, "a " + std::string(what) + " is expected," + (name.empty() ? " this" : name) + " is a folder",
                place, "name a file in it");
}

}  // namespace treadmark
