// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/faults/file_tree.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::testing {
namespace {

const std::string* content_of(const FileTree& tree, const std::string& path) {
  const auto found = tree.find(path);
  return found == tree.end() ? nullptr : &found->second;
}

bool is_index(const std::string& path) { return path.ends_with(".slcw") || path.ends_with(".slcs"); }

/// In a folder that belongs to one index alone: judged through it.
bool is_of_set(const std::string& path) { return path.find(".slcw-") != path.npos || path.find(".slcs-") != path.npos; }

/// Written last and removed first: where it stands, the other files of its folder are of the same making.
bool is_last(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);
  constexpr std::string_view kLast[] = {"result.json", "compare.json",    "bench.json",     "simulation.h5",
                                        "track.json",  "assessment.json", "stability.json", "response.json"};
  return path.size() > name.size() && ranges::find(kLast, name) != std::end(kLast);
}

/// The first of the files of its folder in `whole` that `now` does not hold.
std::string missing_companion(const FileTree& now, const FileTree& whole, const std::string& last) {
  const std::string folder = last.substr(0, last.rfind('/') + 1);
  for (const auto& [path, content] : visible(whole)) {
    const std::string* own = content_of(now, path);
    if (path.starts_with(folder) && (own == nullptr || *own != content)) return path;
  }
  return {};
}

/// The first of the slices of an index in `whole` that `now` does not hold.
std::string missing_slice(const FileTree& now, const FileTree& whole, const std::string& index) {
  const std::string stem = index.substr(0, index.rfind('.'));
  for (const auto& [path, content] : whole) {
    if (is_hidden(path) || is_index(path) || !path.starts_with(stem) || path.find('/', stem.size()) == path.npos)
      continue;
    const std::string* own = content_of(now, path);
    if (own == nullptr || *own != content) return path;
  }
  return {};
}

}  // namespace

FileTree tree_of(const std::filesystem::path& folder) {
  FileTree tree;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, ignored)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string path = entry.path().lexically_relative(folder).string();
    tree[path] = {std::istreambuf_iterator<char>(in), {}};
  }
  return tree;
}

void restore(const std::filesystem::path& folder, const FileTree& tree) {
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  for (const auto& [path, content] : tree) {
    std::filesystem::create_directories((folder / path).parent_path());
    std::ofstream(folder / path, std::ios::binary) << content;
  }
}

bool is_hidden(const std::string& path) {
  return path.starts_with('.') || path.find("/.") != path.npos || path.ends_with(".part");
}

FileTree visible(const FileTree& tree) {
  FileTree out;
  for (const auto& [path, content] : tree)
    if (!is_hidden(path)) out.emplace(path, content);
  return out;
}

std::string first_half_written(const FileTree& tree) {
  constexpr std::size_t kEnd = 28;  // of the file, in a superblock of version 2 (HDF5 file format specification, II.A)
  constexpr std::size_t kCheckSum = 24;
  for (const auto& [path, content] : visible(tree)) {
    std::uint64_t size = content.size();
    if (path.ends_with(".h5") && content.size() > kEnd + sizeof(size))
      std::memcpy(&size, content.data() + kEnd, sizeof(size));
    const bool whole = path.ends_with(".h5")     ? content.starts_with("\x89HDF") && size + kCheckSum == content.size()
                       : path.ends_with(".json") ? content.ends_with("}\n")
                       : path.ends_with(".svg")  ? content.ends_with("</svg>\n")
                                                 : content.empty() || content.ends_with("\n");
    if (!whole) return path + " is half written (" + std::to_string(content.size()) + " bytes)";
  }
  return {};
}

std::string neither_old_nor_new(const FileTree& now, const FileTree& before, const FileTree& after,
                                const Versions& between) {
  for (const auto& [path, content] : visible(now)) {
    if (is_of_set(path)) continue;
    const std::string *old = content_of(before, path), *fresh = content_of(after, path);
    const bool is_old = old != nullptr && *old == content, is_new = fresh != nullptr && *fresh == content;
    if (const auto versions = between.find(path);
        !is_old && !is_new && versions != between.end() && versions->second.count(content) > 0)
      continue;
    if (!is_old && !is_new)
      return path + " is neither the old nor the new one (" + std::to_string(content.size()) + " bytes)";
    if (is_old && is_new) continue;
    const FileTree& whole = is_old ? before : after;
    const std::string missing = is_index(path)  ? missing_slice(now, whole, path)
                                : is_last(path) ? missing_companion(now, whole, path)
                                                : std::string();
    if (!missing.empty()) return path + (is_old ? " is old" : " is new") + ", its " + missing + " is not";
  }
  for (const auto& [path, content] : visible(before))
    if (!is_last(path) && content_of(after, path) != nullptr && content_of(now, path) == nullptr)
      return path + " is gone";
  return {};
}

}  // namespace treadmark::testing
