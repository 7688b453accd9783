// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/flow.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::damage {
namespace {

struct Range {
  int first, last;
};

/// Cells of step d, the middle of the first at x0, whose middles lie from low on and before high.
Range middles_between(double low, double high, double x0, double d) {
  const auto from = [&](double x) { return to_whole<int>(std::ceil((x - x0) / d - 1e-9)); };
  return {from(low), from(high) - 1};
}

}  // namespace

MaterialFlow::MaterialFlow(const SurfaceCells& cells, const FlowLaw& law, const SurfaceRecord& present)
    : cells_(cells),
      law_(law),
      present_(present),
      met_(law.depths.size(), Met(cells.nu)),
      lean_(cells.nu),
      along_(cells.nu),
      across_(cells.nu) {}

void MaterialFlow::meet(const std::vector<PassedShear>& shears, const ElementSize& element, const Stretch& stretch) {
  for (const PassedShear& s : shears) {
    const double size = s.stress.norm();
    if (size <= law_.shear_yield) continue;  // no layer yields at less
    const double lean = element.width / (s.y_high - s.y_low);
    const Range rows = middles_between(s.y_low, s.y_high, cells_.y0, cells_.dy);
    for (int j = rows.first; j <= rows.last; ++j) {
      if (!cells_.exists(j)) continue;
      const double half = 0.5 * element.length / cells_.radius[static_cast<std::size_t>(j)], u = s.u - stretch.middle;
      const Range columns =
          cells_.uniform() ? Range{0, 0}
                           : middles_between(u + stretch.begin - half, u + stretch.end + half, cells_.u0, cells_.du);
      for (int column = columns.first; column <= columns.last; ++column) {
        const int i = cells_.wrapped(column);
        if (i < 0 || i >= cells_.nu) continue;
        const double excess = size / law_.yield_after(present_.flow[s.depth].strain.at(i, j)) - 1.0;
        if (excess <= 0.0) continue;
        const Vec2 over = excess / size * s.stress;
        std::size_t k = 0;
        for (const double value : {over.x(), -over.x(), over.y(), -over.y()}) {
          CellSheet& sheet = met_[s.depth].sheets[k++];
          if (value > sheet.at(i, j)) sheet.ref(i, j) = value;
        }
        double& leans = lean_.ref(i, j);
        leans = std::max(leans, lean);
      }
    }
  }
}

/// Of the trapezoidal rule over the depths, from the surface on, below which nothing flows.
double MaterialFlow::weight(std::size_t depth) const {
  const std::vector<double>& z = law_.depths;
  const double above = depth > 0 ? z[depth - 1] : 0.0, below = depth + 1 < z.size() ? z[depth + 1] : z[depth];
  return 0.5 * (below - above);
}

void MaterialFlow::end_passage(SurfaceRecord& record, double passages) {
  for (std::size_t depth = 0; depth < met_.size(); ++depth) {
    const std::vector<CellSheet>& sheets = met_[depth].sheets;
    std::set<int> rows;
    for (const CellSheet& sheet : sheets)
      for (const auto& [j, row] : sheet.rows()) rows.insert(j);
    if (!rows.empty() && depth + 1 == met_.size())
      throw Error(ErrorKind::numerical,
                  fmt::format("the material flows at {:.3g} mm, the deepest of depths_mm", 1e3 * law_.depths[depth]),
                  {}, "give greater depths, down to where it no longer yields");
    for (const int j : rows)
      for (int i = 0; i < cells_.nu; ++i) {
        const Vec2 strain = law_.strain_per_cycle *
                            Vec2(sheets[0].at(i, j) - sheets[1].at(i, j), sheets[2].at(i, j) - sheets[3].at(i, j));
        if (strain == Vec2::Zero()) continue;
        record.flow[depth].strain.ref(i, j) += passages * strain.norm();
        const double carried = passages * weight(depth) * law_.depths[depth];
        along_.ref(i, j) += carried * strain.x() * lean_.at(i, j);
        across_.ref(i, j) += carried * strain.y();
      }
  }
  met_.assign(met_.size(), Met(cells_.nu));
  lean_ = CellSheet(cells_.nu);
}

void MaterialFlow::displace(SurfaceRecord& record) const {
  const auto move = [&record](int from_i, int from_j, int to_i, int to_j, double volume) {
    if (volume == 0.0) return;
    record.volume.ref(from_i, from_j) += volume;
    record.volume.ref(to_i, to_j) -= volume;
  };
  // between neighbours goes the mean of what crosses both
  for (const auto& [j, row] : along_.rows())
    for (int i = 0; i < cells_.nu && !cells_.uniform(); ++i) {
      const double crossing = 0.5 * row[static_cast<std::size_t>(i)] * cells_.dy;
      for (const int side : {-1, 1}) {
        const int other = cells_.wrapped(i + side);
        if (other < 0 || other >= cells_.nu) continue;
        if (side > 0)
          move(i, j, other, j, crossing);
        else
          move(other, j, i, j, crossing);
      }
    }
  for (const auto& [j, row] : across_.rows())
    for (const int side : {-1, 1}) {
      const int other = j + side;
      if (!cells_.exists(j) || !cells_.exists(other)) continue;
      const double radius =
          0.5 * (cells_.radius[static_cast<std::size_t>(j)] + cells_.radius[static_cast<std::size_t>(other)]);
      for (int i = 0; i < cells_.nu; ++i) {
        const double crossing = 0.5 * row[static_cast<std::size_t>(i)] * cells_.du * radius;
        if (side > 0)
          move(i, j, i, other, crossing);
        else
          move(i, other, i, j, crossing);
      }
    }
}

}  // namespace treadmark::damage
