// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::offset {

namespace {

/// Voxels beyond the ends of the base that continue the offsets, so that a spline does not ring at the rim.
constexpr int kBeyond = 16;

[[noreturn]] void refuse(const std::string& why) { throw Error(ErrorKind::configuration, why); }

/// The voxels that are looked at: i in [i_begin, i_end), j in [j_begin, j_end).
struct Plan {
  SheetFrame frame;
  int i_begin, i_end, j_begin, j_end;
  double base_low, base_high;  ///< ends of the base [m]
};

Plan make_plan(const Surface& base, Body body, double R, const OffsetSettings& s) {
  constexpr double kMostNodes = 2147483648.0, kMostIndex = 5e8;
  if (!(s.du > 0.0) || !(s.dy > 0.0) || !std::isfinite(s.du) || !std::isfinite(s.dy))
    refuse("the steps of offsets must be positive");
  if (!(s.tolerance >= 0.0) || !std::isfinite(s.tolerance)) refuse("the tolerance of offsets must not be negative");
  const Rectangle& region = s.region_uy;
  if (!(region.x_min < region.x_max) || !(region.y_min < region.y_max)) refuse("the region of offsets is empty");
  Plan p{};
  p.frame.body = body;
  p.frame.dy = s.dy;
  const Box3 box = base.bounds();
  p.base_low = box.min.y(), p.base_high = box.max.y();
  const double y_low = std::max(region.y_min, p.base_low), y_high = std::min(region.y_max, p.base_high);
  if (!(y_low <= y_high)) refuse("the region of offsets does not touch the base");
  double first = 0.0, last = 0.0;
  if (body == Body::wheel) {
    if (!(R > 0.0) || !std::isfinite(R)) refuse("offsets of a wheel need its nominal radius");
    const double turn = std::max(8.0, std::round(2.0 * kPi * R / s.du));
    if (!(turn < kMostIndex)) refuse("the voxels of the offsets are too small for the circumference of the wheel");
    p.frame.turn = to_whole<int>(turn);
    p.frame.du = 2.0 * kPi / turn;
    last = turn - 1.0;
    if (region.x_max - region.x_min < 2.0 * kPi - p.frame.du) {
      first = std::ceil(region.x_min / p.frame.du - 1e-9);
      last = std::min(first + turn - 1.0, std::floor(region.x_max / p.frame.du + 1e-9));
    }
  } else {
    p.frame.du = s.du;
    if (!(std::fabs(region.x_min) < 1e9) || !(std::fabs(region.x_max) < 1e9))
      refuse("offsets of a rail need a region that is finite along x");
    first = std::ceil(region.x_min / s.du - 1e-9);
    last = std::floor(region.x_max / s.du + 1e-9);
  }
  const double low = std::ceil(y_low / s.dy - 1e-9), high = std::floor(y_high / s.dy + 1e-9);
  if (!(last >= first) || !(high >= low)) refuse("the region of offsets holds no voxel");
  if ((last - first + 1.0) * (high - low + 1.0) > kMostNodes)
    refuse(fmt::format("offsets at {:.0f} x {:.0f} nodes are more than 2^31; choose larger steps or a smaller region",
                       last - first + 1.0, high - low + 1.0));
  if (std::max({std::fabs(first), std::fabs(last), std::fabs(low), std::fabs(high)}) > kMostIndex)
    refuse("the region of offsets lies too far from the origin for its steps");
  p.i_begin = to_whole<int>(first), p.i_end = to_whole<int>(last) + 1;
  p.j_begin = to_whole<int>(low), p.j_end = to_whole<int>(high) + 1;
  return p;
}

/// One section u = const across both surfaces, seen along the natural direction.
class Section {
 public:
  explicit Section(const Plan& plan) : plan_(plan), base_(size()), target_(size()), offset_(size()) {}

  std::size_t size() const { return static_cast<std::size_t>(plan_.j_end - plan_.j_begin); }

  void look(const Surface& target, const Surface& base, double u) {
    const SheetFrame& f = plan_.frame;
    PlaneGrid view;
    view.grid = {plan_.j_begin * f.dy, 0.0, f.dy, 1.0, static_cast<int>(size()), 1};
    // x of the plane runs along y of the section: one row of the grid is the section.
    const double sin = f.body == Body::wheel ? std::sin(u) : 0.0, cos = f.body == Body::wheel ? std::cos(u) : 1.0;
    view.X_SP.rotation.col(0) = Vec3::UnitY();
    view.X_SP.rotation.col(1) = Vec3(-cos, 0.0, sin);
    view.X_SP.rotation.col(2) = Vec3(sin, 0.0, cos);
    view.X_SP.origin = f.body == Body::wheel ? Vec3::Zero() : Vec3(u, 0.0, 0.0);
    base.heights(view, {base_, {}, {}});
    target.heights(view, {target_, {}, {}});
  }

  /// Offsets where both are present; nodes of the base alone take the nearest one, and are counted. -1: there is none.
  long subtract() {
    long continued = 0;
    bool any = false;
    for (std::size_t j = 0; j < size(); ++j) {
      offset_[j] = target_[j] - base_[j];
      any = any || !std::isnan(offset_[j]);
    }
    if (!any) return -1;
    const std::vector<double> seen = offset_;
    for (std::size_t j = 0; j < size(); ++j) {
      if (!std::isnan(seen[j]) || std::isnan(base_[j])) continue;
      for (std::size_t k = 1; k < size() && std::isnan(offset_[j]); ++k) {
        if (j >= k && !std::isnan(seen[j - k]))
          offset_[j] = seen[j - k];
        else if (j + k < size() && !std::isnan(seen[j + k]))
          offset_[j] = seen[j + k];
      }
      ++continued;
    }
    return continued;
  }

  /// Offsets from j_begin - kBeyond on, continued beyond a rim of the base by reflection in its end point.
  void write(float* to) const {
    const auto n = static_cast<std::ptrdiff_t>(size());
    std::fill_n(to, n + 2 * kBeyond, 0.0f);
    std::ptrdiff_t first = 0, last = n - 1;
    while (first < n && std::isnan(at(first))) ++first;
    while (last > first && std::isnan(at(last))) --last;
    if (first == n) return;
    for (std::ptrdiff_t j = first; j <= last; ++j)
      if (!std::isnan(at(j))) to[j + kBeyond] = static_cast<float>(at(j));
    const auto reflect = [&](std::ptrdiff_t end, std::ptrdiff_t step) {
      if (!is_rim(end + step)) return;
      for (std::ptrdiff_t k = 1; k <= kBeyond; ++k) {
        const double inside = at(std::clamp(end - k * step, first, last)), v = 2.0 * at(end) - inside;
        if (!std::isnan(v)) to[end + k * step + kBeyond] = static_cast<float>(v);
      }
    };
    reflect(first, -1);
    reflect(last, 1);
  }

 private:
  double at(std::ptrdiff_t j) const { return offset_[static_cast<std::size_t>(j)]; }
  /// Whether the base has ended before the node with this number.
  bool is_rim(std::ptrdiff_t j) const {
    if (j >= 0 && j < static_cast<std::ptrdiff_t>(size())) return true;  // it was looked at and is not there
    const double y = (plan_.j_begin + static_cast<double>(j)) * plan_.frame.dy;
    return y < plan_.base_low || y > plan_.base_high;
  }

  const Plan& plan_;
  std::vector<double> base_, target_, offset_;
};

/// Rows of one block of voxels, and what was found in them.
struct Rows {
  std::int32_t bi = 0;
  std::vector<int> i;
  std::vector<std::pair<BlockKey, Block>> blocks;
  std::vector<bool> bare;  ///< sections without offsets, in the order of i
  std::size_t continued = 0, sections = 0;
  double max_offset = 0.0;
};

void sample_rows(const Plan& plan, const Surface& target, const Surface& base, float tolerance, Rows& rows) {
  Section section(plan);
  const std::size_t width = section.size() + 2 * kBeyond;
  std::vector<float> values(kBlockI * width, 0.0f);
  for (const int i : rows.i) {
    section.look(target, base, plan.frame.u0 + i * plan.frame.du);
    const long continued = section.subtract();
    if (continued >= 0) ++rows.sections;
    rows.bare.push_back(continued < 0);
    rows.continued += static_cast<std::size_t>(std::max(continued, 0L));
    section.write(values.data() + static_cast<std::size_t>(plan.frame.wrapped(i) & 7) * width);
  }
  const int j_first = plan.j_begin - kBeyond, j_last = j_first + static_cast<int>(width) - 1;
  for (int bj = j_first >> 6; bj <= j_last >> 6; ++bj) {
    Block block{};
    bool any = false;
    for (int i = 0; i < kBlockI; ++i)
      for (int j = std::max(j_first, bj * kBlockJ); j <= std::min(j_last, bj * kBlockJ + kBlockJ - 1); ++j) {
        const float v = values[static_cast<std::size_t>(i) * width + static_cast<std::size_t>(j - j_first)];
        block[static_cast<std::size_t>((i << 6) | (j & 63))] = v;
        any = any || std::fabs(v) > tolerance;
        rows.max_offset = std::max(rows.max_offset, static_cast<double>(std::fabs(v)));
      }
    if (any) rows.blocks.push_back({{rows.bi, bj}, block});
  }
}

/// Bare sections between others: more than one run of bare ones round a whole wheel, or any that both sides are not.
std::size_t gaps(const std::vector<Rows>& all, const Plan& plan) {
  std::vector<bool> bare;
  for (const Rows& rows : all) bare.insert(bare.end(), rows.bare.begin(), rows.bare.end());
  const bool whole = plan.frame.turn > 0 && plan.i_end - plan.i_begin == plan.frame.turn;
  const std::size_t n = bare.size();
  std::vector<std::size_t> runs;  // lengths of bare runs
  for (std::size_t i = 0; i < n; ++i) {
    if (!bare[i]) continue;
    if (i == 0 || !bare[i - 1]) runs.push_back(0);
    ++runs.back();
  }
  if (runs.empty()) return 0;
  if (whole) {  // the part that is not there at all is the longest run, across the seam too
    if (bare.front() && bare.back() && runs.size() > 1) {
      runs.front() += runs.back();
      runs.pop_back();
    }
    const std::size_t longest = *std::max_element(runs.begin(), runs.end());
    std::size_t sum = 0;
    for (const std::size_t run : runs) sum += run;
    return sum - longest;
  }
  std::size_t between = 0;
  for (std::size_t k = 0, i = 0; k < runs.size(); ++k) {
    while (!bare[i]) ++i;
    if (i > 0 && i + runs[k] < n) between += runs[k];
    i += runs[k];
  }
  return between;
}

}  // namespace

OffsetSample sample_offsets(const Surface& target, const Surface& base, Body body, double nominal_radius,
                            const OffsetSettings& settings) {
  const Facing wanted = body == Body::wheel ? Facing::down : Facing::up;
  if (target.facing() != wanted || base.facing() != wanted)
    refuse("offsets are sampled between two wheels or two rails");
  const Plan plan = make_plan(base, body, nominal_radius, settings);
  std::vector<Rows> all;
  for (int i = plan.i_begin; i < plan.i_end; ++i) {
    const std::int32_t bi = plan.frame.wrapped(i) >> 3;
    if (all.empty() || all.back().bi != bi) all.push_back({bi, {}, {}, {}, 0, 0, 0.0});
    all.back().i.push_back(i);
  }
  const auto tolerance = static_cast<float>(settings.tolerance);
  parallel_for(all.size(), [&](std::size_t k) { sample_rows(plan, target, base, tolerance, all[k]); });

  const auto offsets = std::make_shared<SparseOffsets>();
  offsets->frame = plan.frame;
  offsets->tolerance = settings.tolerance;
  offsets->nominal_radius = body == Body::wheel ? nominal_radius : 0.0;
  OffsetSample result;
  std::size_t sections = 0;
  for (Rows& rows : all) {
    check_cancelled();
    for (const auto& [key, block] : rows.blocks) result.active += offsets->grid.insert(key, block, tolerance);
    result.continued += rows.continued;
    result.max_offset = std::max(result.max_offset, rows.max_offset);
    sections += rows.sections;
  }
  result.gaps = gaps(all, plan);
  if (sections == 0) throw Error(ErrorKind::input_data, "the base nowhere underlies the surface to be sampled");
  result.nodes =
      static_cast<std::size_t>(plan.i_end - plan.i_begin) * static_cast<std::size_t>(plan.j_end - plan.j_begin);
  result.offsets = offsets;
  return result;
}

}  // namespace treadmark::offset
