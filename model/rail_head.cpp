// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/rail_head.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace treadmark {
namespace {

/// The highest of all points, or of those that were not seen.
std::optional<std::size_t> top_of(std::span<const double> z, const std::vector<bool>& seen = {}) {
  std::optional<std::size_t> top;
  for (std::size_t i = 0; i < z.size(); ++i)
    if (!std::isnan(z[i]) && (seen.empty() || !seen[i]) && (!top || z[i] < z[*top])) top = i;
  return top;
}

struct Piece {
  std::size_t first = 0, last = 0;
};

/// What is not lower than `lowest` in one piece with a point.
Piece piece_about(std::span<const double> z, std::size_t at, double lowest) {
  Piece piece{at, at};
  for (std::size_t i = at; i > 0 && !(z[i - 1] > lowest); --i)
    if (!std::isnan(z[i - 1])) piece.first = i - 1;
  for (std::size_t i = at + 1; i < z.size() && !(z[i] > lowest); ++i)
    if (!std::isnan(z[i])) piece.last = i;
  return piece;
}

std::optional<RailHead> innermost_head(std::span<const double> z, double depth,
                                       const std::function<double(std::size_t)>& height) {
  const std::optional<std::size_t> top = top_of(z);
  if (!top) return std::nullopt;
  const double z_top = height ? height(*top) : z[*top];
  for (std::size_t i = 0; i < z.size(); ++i)
    if (z[i] - z_top <= depth) {
      const Piece piece = piece_about(z, i, z_top + depth);
      return RailHead{piece.first, piece.last, *top, z_top};
    }
  return std::nullopt;
}

/// The top of the widest piece, each looked at below its own top: a check rail may stand above the running rail.
std::optional<std::size_t> top_of_widest(std::span<const double> y, std::span<const double> z, double depth) {
  constexpr double kRaised = 30e-3, kLeastDepth = 5e-3, kWidestHead = 90e-3;
  depth = std::max(depth, kLeastDepth);
  std::vector<bool> seen(z.size(), false);
  const std::optional<std::size_t> highest = top_of(z);
  std::optional<std::size_t> best;
  double widest = 0.0;
  for (std::optional<std::size_t> top = highest; top && z[*top] - z[*highest] <= kRaised; top = top_of(z, seen)) {
    const Piece piece = piece_about(z, *top, z[*top] + depth);
    const auto begin = seen.begin() + static_cast<std::ptrdiff_t>(piece.first),
               end = seen.begin() + static_cast<std::ptrdiff_t>(piece.last) + 1;
    const double width = std::fabs(y[piece.last] - y[piece.first]);
    // what goes on from a piece that was seen is its flank, and wide ones that lie low are no heads
    const bool is_flank = std::find(begin, end, true) != end,
               is_low = z[*top] - z[*highest] > depth && width > kWidestHead;
    std::fill(begin, end, true);
    if (is_flank || is_low || (best && width < widest)) continue;
    best = top, widest = width;
  }
  return best;
}

}  // namespace

std::optional<RailHead> head_of_rail(std::span<const double> y, std::span<const double> z, double depth, bool innermost,
                                     const std::function<double(std::size_t)>& height) {
  if (!(depth >= 0.0)) return std::nullopt;  // above the top
  if (innermost) return innermost_head(z, depth, height);
  const std::optional<std::size_t> top = top_of_widest(y, z, depth);
  if (!top) return std::nullopt;
  const double z_top = height ? height(*top) : z[*top];
  const Piece piece = piece_about(z, *top, z_top + depth);
  return RailHead{piece.first, piece.last, *top, z_top};
}

}  // namespace treadmark
