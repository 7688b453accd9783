// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/result_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::io {

void check_surfaces(std::span<const SampledSurface> surfaces) {
  std::set<std::string> seen;
  for (const SampledSurface& s : surfaces) {
    const auto refuse = [&](const std::string& why) {
      throw Error(ErrorKind::configuration, fmt::format("sampled surface {}: {}", s.name, why));
    };
    if (s.name.empty() || s.name == "." || s.name.find('/') != std::string::npos ||
        s.name.find('\0') != std::string::npos)
      refuse("this cannot be a name");
    if (!seen.insert(s.name).second) refuse("there are two of this name");
    if (s.body != "wheel" && s.body != "rail") refuse(fmt::format("\"{}\" is neither wheel nor rail", s.body));
    if (s.nu < 1 || s.nv < 1) refuse("it has no points");
    const std::size_t points = s.index(s.nu, 0);
    if (s.u.size() != static_cast<std::size_t>(s.nu) || s.x.size() != points || s.y.size() != points ||
        s.z.size() != points || (!s.deviation.empty() && s.deviation.size() != points))
      refuse(fmt::format("its lists do not have {} stations of {} points", s.nu, s.nv));
  }
}

std::string_view status_word(const CaseResult& result) {
  return result.status == Status::ok && any_grave(result.remarks) ? "doubtful" : to_string(result.status);
}

int surface_index(std::span<const SampledSurface> surfaces, const std::string& name) {
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].name == name) return static_cast<int>(i);
  return -1;
}

std::vector<Vec2> row_edges(const PatchFields& fields, double reference_s) {
  const Grid2& grid = fields.grid;
  const double first = grid.y0 - 0.5 * grid.dy;
  std::vector<Vec2> edges;
  if (fields.row_angle.empty()) {
    for (int iy = 0; iy <= grid.ny; ++iy) edges.emplace_back(first + iy * grid.dy, 0.0);
    return edges;
  }
  edges.emplace_back(0.0, 0.0);
  for (const double angle : fields.row_angle)
    edges.push_back(edges.back() + grid.dy * Vec2(std::cos(angle), std::sin(angle)));
  // The reference lies between two edges.
  const double place = std::clamp((reference_s - first) / grid.dy, 0.0, static_cast<double>(grid.ny));
  const auto below = std::min(to_whole<std::size_t>(place), edges.size() - 2);
  const Vec2 reference = edges[below] + (place - static_cast<double>(below)) * (edges[below + 1] - edges[below]);
  for (Vec2& edge : edges) edge += Vec2(reference_s, 0.0) - reference;
  return edges;
}

}  // namespace treadmark::io
