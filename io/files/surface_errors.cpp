// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/surface_errors.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {
namespace {

struct CommentStyle {
  std::string_view extension, sign, other;  ///< other: how further lines of the head begin, blanks between them
};
constexpr CommentStyle kCommentStyles[] = {{".slcs", "%", ""},
                                           {".slcw", "%", ""},
                                           {".ply", "comment", "ply format obj_info"},
                                           {".obj", "#", ""},
                                           {".off", "#", "OFF"}};

bool is_one_of(std::string_view word, std::string_view words) {
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (word == words.substr(0, end)) return true;
    words.remove_prefix(std::min(words.size(), end + 1));
  }
  return false;
}

std::ifstream opened(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) stream.open(profiles::portable_path(file.string()), std::ios::binary);
  return stream;
}

/// At the top of a file, without their signs.
std::vector<std::string> comments_of(const std::filesystem::path& file) {
  std::vector<std::string> comments;
  const auto style = ranges::find(kCommentStyles, extension_of(file), &CommentStyle::extension);
  if (style == std::end(kCommentStyles)) return comments;
  std::ifstream stream = opened(file);
  std::array<char, 4096> buffer{};
  const auto next = [&] {
    if (stream.getline(buffer.data(), buffer.size())) return true;
    if (stream.gcount() == 0 || stream.eof() || stream.bad()) return false;
    // a longer line is none of ours, but ours may come after it
    stream.clear();
    stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    return true;
  };
  while (next()) {
    std::string_view line(buffer.data());
    const auto skip_blanks = [&] { line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size())); };
    skip_blanks();
    if (line.starts_with(style->sign)) {
      line.remove_prefix(style->sign.size());
      skip_blanks();
      comments.emplace_back(line);
    } else if (!line.empty() && !is_one_of(line.substr(0, line.find_first_of(" \t\r")), style->other)) {
      break;
    }
  }
  return comments;
}

/// What stands in the 80 characters before the triangles of a binary .stl, piece by piece.
std::vector<std::string> pieces_of_head(const std::filesystem::path& file) {
  std::array<char, 80> head{};
  opened(file).read(head.data(), head.size());
  std::vector<std::string> pieces;
  std::istringstream text(std::string(head.data(), head.size()));
  for (std::string piece; std::getline(text, piece, ';');) pieces.push_back(std::move(piece));
  return pieces;
}

}  // namespace

std::vector<SurfaceDoubt> read_surface_doubts(const std::filesystem::path& file) {
  return doubts_of_lines(extension_of(file) == ".stl" ? pieces_of_head(file) : comments_of(file));
}

std::shared_ptr<const SurfaceErrors> read_surface_errors(const std::filesystem::path& file) {
  try {
    return errors_of_lines(comments_of(file));
  } catch (const Error& error) {
    throw Error(error.kind(), error.message(), {file.string(), 0, 0}, error.advice());
  }
}

}  // namespace treadmark::io
