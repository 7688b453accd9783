// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/nearest_key.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace treadmark::io {
namespace {

/// Damerau-Levenshtein distance (restricted: adjacent transpositions).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string_view leaf(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

}  // namespace

std::string nearest_key(std::string_view path, std::span<const std::string> known) {
  constexpr std::size_t kLongest = 100;
  if (path.empty() || path.size() > kLongest) return {};
  std::string best;
  std::size_t best_distance = path.size() + 1;
  for (const std::string& candidate : known) {
    std::size_t distance = edit_distance(path, candidate);
    // The same name in another section, or the unit forgotten, is as near as a slip of the finger.
    if (leaf(path) == leaf(candidate)) distance = std::min<std::size_t>(distance, 2);
    if (candidate.starts_with(std::string(path) + '_')) distance = std::min<std::size_t>(distance, 1);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  const std::size_t tolerated = std::max<std::size_t>(2, leaf(path).size() / 3);
  return best_distance <= tolerated ? best : std::string();
}

}  // namespace treadmark::io
