// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/thb/thb_spline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "treadmark/backends/spline/cubic_pieces.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {
namespace {

// Corners that cells share, unless the surface has an edge there.
class CornerList {
 public:
  std::uint32_t add(double u, double v, double size_u, double size_v, const NurbsNet::Corner& corner) {
    constexpr double kSame = 1e-13;  // [m] what its differences may move the patch by
    const auto [from, to] = known_.equal_range({u, v});
    for (auto at = from; at != to; ++at) {
      const NurbsNet::Corner& c = corners[at->second];
      if ((c.p - corner.p).norm() < kSame && (c.p_u - corner.p_u).norm() * size_u < kSame &&
          (c.p_v - corner.p_v).norm() * size_v < kSame && (c.p_uv - corner.p_uv).norm() * size_u * size_v < kSame)
        return at->second;
    }
    const auto place = static_cast<std::uint32_t>(corners.size());
    corners.push_back(corner);
    known_.insert({{u, v}, place});
    return place;
  }
  std::vector<NurbsNet::Corner> corners;

 private:
  std::multimap<std::pair<double, double>, std::uint32_t> known_;
};

// Bits of two numbers in turns (Morton 1966).
std::uint64_t woven(std::uint32_t x, std::uint32_t y) {
  std::uint64_t out = 0;
  for (int bit = 0; bit < 24; ++bit)
    out |= (static_cast<std::uint64_t>((x >> bit) & 1u) << (2 * bit + 1)) |
           (static_cast<std::uint64_t>((y >> bit) & 1u) << (2 * bit));
  return out;
}

}  // namespace

Vec3 ThbSpline::point(double u, double v) const {
  const ThbCell cell = space.cell_at(u, v);
  const ThbRange r = space.range(cell);
  u = std::clamp(u, r.u0, r.u1);
  v = std::clamp(v, r.v0, r.v1);
  const ThbPiece at =
      over_range(space.piece(cell, coefficients), space.u(0).degree(), space.v(0).degree(), r, {u, r.u1, v, r.v1});
  return at[0][0];
}

NurbsNet listed_net(std::size_t count, const std::function<CubicPiece(std::size_t)>& piece) {
  CornerList list;
  std::vector<NurbsNet::Cell> cells;
  cells.reserve(count);
  double along = 0.0, across = 0.0, length = 0.0, width = 0.0;
  ThbRange all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
               std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t cell = 0; cell < count; ++cell) {
    check_cancelled();
    const auto [r, b] = piece(cell);
    const double size_u = r.u1 - r.u0, size_v = r.v1 - r.v0;
    all = {std::min(all.u0, r.u0), std::max(all.u1, r.u1), std::min(all.v0, r.v0), std::max(all.v1, r.v1)};
    NurbsNet::Cell out{r.u0, r.u1, r.v0, r.v1, {}};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const std::size_t a = 3 * i, c = 3 * j, a1 = i ? 2 : 1, c1 = j ? 2 : 1;
        const double su = (i ? -3.0 : 3.0) / size_u, sv = (j ? -3.0 : 3.0) / size_v;
        const NurbsNet::Corner corner{b[a][c], su * (b[a1][c] - b[a][c]), sv * (b[a][c1] - b[a][c]),
                                      su * sv * (b[a1][c1] - b[a1][c] - b[a][c1] + b[a][c])};
        out.corner[i][j] = list.add(i ? r.u1 : r.u0, j ? r.v1 : r.v0, size_u, size_v, corner);
      }
    cells.push_back(out);
    along += size_u, length += (b[3][0] - b[0][0]).norm();
    across += size_v, width += (b[0][3] - b[0][0]).norm();
  }
  // neighbours on the surface next to each other
  const double per_u = length / along, per_v = width / across;
  const double extent = std::max((all.u1 - all.u0) * per_u, (all.v1 - all.v0) * per_v);
  const auto place = [&](double middle, double first, double per) {
    return to_whole<std::uint32_t>((middle - first) * per / extent * 16'000'000.0);
  };
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  order.reserve(cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k)
    order.emplace_back(woven(place(0.5 * (cells[k].u0 + cells[k].u1), all.u0, per_u),
                             place(0.5 * (cells[k].v0 + cells[k].v1), all.v0, per_v)),
                       k);
  std::sort(order.begin(), order.end());
  std::vector<NurbsNet::Cell> sorted;
  sorted.reserve(order.size());
  for (const auto& [key, k] : order) sorted.push_back(cells[k]);
  list.corners.shrink_to_fit();
  return NurbsNet(std::move(sorted), std::move(list.corners));
}

CubicPiece cubic_piece(const ThbSpline& spline, const ThbCell& cell) {
  CubicPiece out{spline.space.range(cell), spline.space.piece(cell, spline.coefficients)};
  raise_to_cubic(out.b, spline.space.u(0).degree(), spline.space.v(0).degree());
  return out;
}

NurbsNet extracted(const ThbSpline& spline) {
  const std::vector<ThbCell>& cells = spline.space.cells();
  return listed_net(cells.size(), [&](std::size_t k) { return cubic_piece(spline, cells[k]); });
}

}  // namespace treadmark::spline
