// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs/nurbs_view.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/to_whole.hpp"

#include <cmath>
#include <limits>

namespace treadmark::spline {
namespace {

using nurbs_limits::kSlack;
constexpr int kLeafHalvings = 8;   // of a patch into leaves, before lines look closer
constexpr int kMostHalvings = 48;  // altogether
constexpr double kSameHit = 1e-9;  // [m] hits nearer than this are the same one, found in two leaves
constexpr double kEdgeOn = 1e-9;   // cosine between normals of plane and patch: seen edge-on
constexpr double kGrazing = 0.02;  // the same: not worth dividing before lines come near

// Greatest cosine between the normals of plane and patch, from samples.
double greatest_facing(const BezierPatch& bezier) {
  const PowerPatch power(bezier);
  double most = 0.0;
  for (const double s : {-0.5, 0.0, 0.5})
    for (const double t : {-0.5, 0.0, 0.5}) {
      const PowerPatch::Jet at = power.jet(s, t);
      const auto tangent = [&](const Quad& d) {
        const double w = 1.0 / at.value.w();
        return Vec3(d.x() - at.value.x() * w * d.w(), d.y() - at.value.y() * w * d.w(),
                    d.z() - at.value.z() * w * d.w());
      };
      const Vec3 normal = tangent(at.by_s).cross(tangent(at.by_t));
      most = std::max(most, std::abs(normal.z()) / normal.norm());
    }
  return most;
}

// Of a point, also one that is not over the view.
int bin_of(double at, int bins) { return std::clamp(to_whole<int>(at, -1.0, 2000.0), 0, bins - 1); }

// In rows of so many.
std::size_t index_of(int i, int j, int columns) {
  return static_cast<std::size_t>(columns) * static_cast<std::size_t>(j) + static_cast<std::size_t>(i);
}

}  // namespace

FacingHalf::FacingHalf(const Pose& X, Facing facing) : all(facing == Facing::up) {
  if (all) return;
  outwards = Vec3(X.rotation(0, 2), 0.0, X.rotation(2, 2));
  none = outwards.squaredNorm() < 1e-18;
  if (none) return;
  const double scale = -1.0 / outwards.squaredNorm();
  c = scale * outwards.dot(X.origin);
  x = scale * outwards.dot(X.rotation.col(0));
  y = scale * outwards.dot(X.rotation.col(1));
}

ViewArrays view_arrays(const Pose& X, const FacingHalf& half) {
  ViewArrays view{};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) view.to_plane[3 * i + k] = X.rotation(k, i);
    view.origin[i] = X.origin[i];
  }
  view.side = half.all ? -1.0 : 1.0;
  view.half = !half.all;
  view.lowest[0] = half.c, view.lowest[1] = half.x, view.lowest[2] = half.y;
  return view;
}

NurbsView::Room& NurbsView::spare_room() {
  thread_local Room room;
  return room;
}

NurbsView::~NurbsView() {
  constexpr std::size_t kMostLeaves = 10'000;  // worth keeping, about 8 MB
  if (leaves_.capacity() <= kMostLeaves) std::swap(room_, spare_room());
}

NurbsView::NurbsView(const NurbsNet& net, const Pose& X_SP, const Rectangle& r, Facing facing, Empty)
    : net_(net),
      X_SP_(X_SP),
      rectangle_{r.x_min - kSlack, r.x_max + kSlack, r.y_min - kSlack, r.y_max + kSlack},
      half_(X_SP, facing),
      side_(facing == Facing::up ? -1.0 : 1.0) {
  std::swap(room_, spare_room());
  candidates_.clear();
  leaves_.clear();
  rough_.clear();
}

NurbsView::NurbsView(const NurbsNet& net, const Pose& X_SP, const Rectangle& r, Facing facing)
    : NurbsView(net, X_SP, r, facing, Empty()) {
  for_patches_over(net, X_SP, rectangle_, half_, [&](int iu, int iv, const Vec3& low, const Vec3& high) {
    candidates_.push_back({{low.x(), high.x()}, {low.y(), high.y()}, side_ > 0.0 ? high.z() : -low.z(), iu, iv});
  });
  sort_into_bins();
}

NurbsView::NurbsView(const NurbsNet& net, const Pose& X_SP, const Rectangle& r, Facing facing,
                     std::span<const PatchIndex> patches)
    : NurbsView(net, X_SP, r, facing, Empty()) {
  for (const PatchIndex& patch : patches) {
    const ControlBox box(net.patch(patch.iu, patch.iv, X_SP));
    candidates_.push_back({{box.x.low - kSlack, box.x.high + kSlack},
                           {box.y.low - kSlack, box.y.high + kSlack},
                           (side_ > 0.0 ? box.z.high : -box.z.low) + kSlack,
                           patch.iu,
                           patch.iv});
  }
  sort_into_bins();
}

void NurbsView::sort_into_bins() {
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    if (a.outer != b.outer) return a.outer > b.outer;
    return a.iu != b.iu ? a.iu < b.iu : a.iv < b.iv;
  });
  if (candidates_.empty()) {
    bin_begin_.assign(2, 0);
    return;
  }
  const double width = rectangle_.x_max - rectangle_.x_min, height = rectangle_.y_max - rectangle_.y_min;
  // About four bins for every candidate, as square as can be.
  const double number = 4.0 * static_cast<double>(candidates_.size()) + 1.0;
  bins_x_ = to_whole<int>(std::sqrt(number * width / height), 1.0, 1000.0);
  bins_y_ = to_whole<int>(number / bins_x_, 1.0, 1000.0);
  per_x_ = bins_x_ / width;
  per_y_ = bins_y_ / height;
  bin_begin_.assign(static_cast<std::size_t>(bins_x_ * bins_y_) + 1, 0);
  const auto each_bin = [&](const Candidate& c, const auto& use) {
    const int x0 = bin_of((c.x.low - rectangle_.x_min) * per_x_, bins_x_),
              x1 = bin_of((c.x.high - rectangle_.x_min) * per_x_, bins_x_);
    const int y0 = bin_of((c.y.low - rectangle_.y_min) * per_y_, bins_y_),
              y1 = bin_of((c.y.high - rectangle_.y_min) * per_y_, bins_y_);
    for (int j = y0; j <= y1; ++j)
      for (int i = x0; i <= x1; ++i) use(index_of(i, j, bins_x_));
  };
  for (const Candidate& c : candidates_) each_bin(c, [&](std::size_t bin) { ++bin_begin_[bin + 1]; });
  for (std::size_t i = 0; i + 1 < bin_begin_.size(); ++i) bin_begin_[i + 1] += bin_begin_[i];
  bin_fill_ = bin_begin_;
  binned_.resize(static_cast<std::size_t>(bin_begin_.back()));
  for (std::size_t k = 0; k < candidates_.size(); ++k)
    each_bin(candidates_[k],
             [&](std::size_t bin) { binned_[static_cast<std::size_t>(bin_fill_[bin]++)] = static_cast<int>(k); });
}

/// All of it turned away, or beside the rectangle.
bool NurbsView::hidden(const ControlBox& box) const {
  return half_.away(box) || !box.x.overlaps({rectangle_.x_min, rectangle_.x_max}) ||
         !box.y.overlaps({rectangle_.y_min, rectangle_.y_max});
}

void NurbsView::prepare(Candidate& c) {
  c.first_leaf = static_cast<int>(leaves_.size());
  const BezierPatch patch = net_.patch(c.iu, c.iv, X_SP_);
  divide(patch, {});
  c.last_leaf = static_cast<int>(leaves_.size());
  // The box of the control points is tighter than that of the box.
  Interval x = Interval::none(), y = Interval::none();
  for (int k = c.first_leaf; k < c.last_leaf; ++k) {
    x.include(leaves_[static_cast<std::size_t>(k)].leaf.box().x);
    y.include(leaves_[static_cast<std::size_t>(k)].leaf.box().y);
  }
  c.x = {x.low - kSlack, x.high + kSlack};
  c.y = {y.low - kSlack, y.high + kSlack};
}

NurbsView::PatchPart NurbsView::PatchPart::half(bool of_u, bool upper) const {
  PatchPart part = *this;
  ++part.halvings;
  double& size = of_u ? part.size_s : part.size_t;
  size *= 0.5;
  (of_u ? part.s : part.t) += (upper ? 0.5 : -0.5) * size;
  return part;
}

void NurbsView::divide(const BezierPatch& bezier, const PatchPart& part) {
  const ControlBox box(bezier);
  if (hidden(box)) return;
  const NurbsLeaf leaf(bezier, box);
  if (!leaf.regular()) {
    const double facing = part.halvings == 0 ? greatest_facing(bezier) : 1.0;
    if (facing < kEdgeOn) return;
    if (facing > kGrazing && part.halvings < kLeafHalvings) {
      const bool of_u = leaf.bends_along_u();
      const auto halves = bezier.halves(of_u);
      divide(halves[0], part.half(of_u, false));
      divide(halves[1], part.half(of_u, true));
      return;
    }
    rough_.push_back(bezier);
  }
  const double outer = (side_ > 0.0 ? box.z.high : -box.z.low) + kSlack;
  leaves_.push_back({leaf, outer, part, leaf.regular() ? -1 : static_cast<int>(rough_.size()) - 1});
}

bool NurbsView::hit(double x, double y, bool exact, bool all, NurbsHit& out) {
  if (!std::isfinite(x) || !std::isfinite(y)) return false;
  const int bin_x = bin_of((x - rectangle_.x_min) * per_x_, bins_x_),
            bin_y = bin_of((y - rectangle_.y_min) * per_y_, bins_y_);
  const std::size_t k = index_of(bin_x, bin_y, bins_x_);
  Search search{x, y, exact, all, out};
  out.hides_others = false;
  for (int i = bin_begin_[k]; i < bin_begin_[k + 1]; ++i) {
    Candidate& c = candidates_[static_cast<std::size_t>(binned_[static_cast<std::size_t>(i)])];
    if (!all && search.found && c.outer <= search.best) break;
    if (x < c.x.low || x > c.x.high || y < c.y.low || y > c.y.high) continue;
    if (c.first_leaf < 0) prepare(c);
    for (int leaf = c.first_leaf; leaf < c.last_leaf; ++leaf) look_into(leaf, c, search);
  }
  if (search.found) follow(search);
  return search.found;
}

void NurbsView::hit_tile(const ViewArrays& view, const TileArrays& tile) {
  const auto& kernels = fastest_kernel<NurbsKernel>();
  std::vector<char> open(static_cast<std::size_t>(tile.nx) * static_cast<std::size_t>(tile.ny), 0);
  const auto x = [&](int i) { return tile.x0 + (tile.ix0 + i) * tile.dx; };
  const auto y = [&](int j) { return tile.y0 + (tile.iy0 + j) * tile.dy; };
  const auto over = [](const Interval& range, double at) {
    return range.low - kSlack <= at && at <= range.high + kSlack;
  };
  for (Candidate& c : candidates_) {
    prepare(c);
    for (int k = c.first_leaf; k < c.last_leaf; ++k) {
      const Leaf& l = leaves_[static_cast<std::size_t>(k)];
      if (l.rough < 0 && kernels.hit(view, l.leaf.powers(), tile)) continue;
      const ControlBox& box = l.leaf.box();
      for (int j = 0; j < tile.ny; ++j)
        for (int i = 0; over(box.y, y(j)) && i < tile.nx; ++i)
          if (over(box.x, x(i))) open[index_of(i, j, tile.nx)] = 1;
    }
  }
  NurbsHit found;
  for (int j = 0; j < tile.ny; ++j)
    for (int i = 0; i < tile.nx; ++i) {
      const long at = i + tile.stride * j;
      if (open[index_of(i, j, tile.nx)] == 0) continue;
      if (!hit(x(i), y(j), tile.dzdx != nullptr, false, found) || side_ * found.z <= side_ * tile.z[at]) continue;
      tile.z[at] = found.z;
      if (tile.dzdx != nullptr) tile.dzdx[at] = found.dzdx, tile.dzdy[at] = found.dzdy;
    }
}

void NurbsView::look_into(int index, const Candidate& c, Search& search) {
  const Leaf& l = leaves_[static_cast<std::size_t>(index)];
  if (!search.all && search.found && l.outer <= search.best) return;
  LeafRoot root;
  double s, t;
  if (!l.leaf.may_meet(search.x, search.y, s, t)) return;
  if (l.rough >= 0) return look_closer(rough_[static_cast<std::size_t>(l.rough)], l.part, c, search);
  if (track_.leaf == index) {
    const double dx = search.x - track_.x, dy = search.y - track_.y, distance_2 = dx * dx + dy * dy;
    search.guessed.s = track_.root.s + track_.root.s_x * dx + track_.root.s_y * dy;
    search.guessed.t = track_.root.t + track_.root.t_x * dx + track_.root.t_y * dy;
    s = search.guessed.s + track_.bend_s * distance_2;
    t = search.guessed.t + track_.bend_t * distance_2;
  }
  if (!l.leaf.solve(search.x, search.y, s, t, search.exact, root)) return;
  const bool found = search.found;
  const double best = search.best;
  take(root, l.part, c, search);
  if (search.found != found || search.best != best) {
    search.leaf = index;
    search.root = root;
  }
}

/// Halves a part that is not regular, which holds a fold, until the pieces over the line are.
void NurbsView::look_closer(const BezierPatch& bezier, const PatchPart& part, const Candidate& c, Search& search) {
  if (--search.parts_left < 0) return;
  const ControlBox box(bezier);
  const double outer = (side_ > 0.0 ? box.z.high : -box.z.low) + kSlack;
  if (!search.all && search.found && outer <= search.best) return;
  constexpr double kRounding = 1e-14;
  if (search.x < box.x.low - kRounding || search.x > box.x.high + kRounding || search.y < box.y.low - kRounding ||
      search.y > box.y.high + kRounding)
    return;
  const NurbsLeaf leaf(bezier, box);
  double first_s, first_t;
  LeafRoot root;
  if (!leaf.may_meet(search.x, search.y, first_s, first_t)) return;
  if (leaf.regular()) {
    if (leaf.solve(search.x, search.y, first_s, first_t, search.exact, root)) take(root, part, c, search);
    return;
  }
  if (part.halvings == kMostHalvings) {  // on the fold itself, to rounding
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    if (leaf.solve(search.x, search.y, 0.0, 0.0, search.exact, root)) return take(root, part, c, search);
    root = {0.0, 0.0, 0.5 * (box.z.low + box.z.high), kNaN, kNaN};
    if (box.z.width() < kSameHit) take(root, part, c, search);
    return;
  }
  const bool of_u = leaf.bends_along_u();
  const auto halves = bezier.halves(of_u);
  look_closer(halves[0], part.half(of_u, false), c, search);
  look_closer(halves[1], part.half(of_u, true), c, search);
}

void NurbsView::take(const LeafRoot& root, const PatchPart& part, const Candidate& c, Search& search) const {
  if (!half_.all && root.z < half_.lowest(search.x, search.y)) return;
  if (search.found && std::abs(root.z - search.out.z) > kSameHit) search.out.hides_others = true;
  if (search.found && side_ * root.z <= search.best) return;
  search.found = true;
  search.best = side_ * root.z;
  search.out.iu = c.iu, search.out.iv = c.iv;
  search.out.s = std::clamp(part.s + part.size_s * root.s, -0.5, 0.5);
  search.out.t = std::clamp(part.t + part.size_t * root.t, -0.5, 0.5);
  search.out.z = root.z, search.out.dzdx = root.dzdx, search.out.dzdy = root.dzdy;
}

void NurbsView::follow(const Search& search) {
  if (search.leaf < 0) return;
  const double dx = search.x - track_.x, dy = search.y - track_.y, distance_2 = dx * dx + dy * dy;
  const bool same = search.leaf == track_.leaf && distance_2 > 0.0;
  const double bend_s = same ? (search.root.s - search.guessed.s) / distance_2 : 0.0;
  const double bend_t = same ? (search.root.t - search.guessed.t) / distance_2 : 0.0;
  track_ = {search.leaf, search.x, search.y, search.root, bend_s, bend_t};
}

}  // namespace treadmark::spline
