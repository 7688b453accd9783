// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <numbers>
#include <type_traits>
#include <vector>

#include "treadmark/backends/spline/slice_geometry.hpp"
#include "treadmark/backends/spline/slice_hulls.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::spline {

/// A rectangle of a plane, by its ranges across and along the grid lines that suit the plane. axes: unit vectors in the
/// surface frame.
struct PlaneWindow {
  Vec3 across_axis, along_axis, normal, origin;
  Interval across, along;
};

/// What boxes around parts of a rail may have to do with a window; all answers are conservative.
class RailWindow {
 public:
  explicit RailWindow(const PlaneWindow& window) : window_(window) {}

  bool exists() const;                                ///< false: the plane has no lines that suit
  Interval u(const SliceHulls::Box& box) const;       ///< that the window can see of the box
  Interval heights(const SliceHulls::Box& box) const;  ///< of the box over the window, empty if it is not
  /// Calls use(part) for the parts of u that lie in the span, in the span's own values.
  template <class Use>
  static void clip(const Interval& u, const Interval& span, const Use& use) {
    const Interval part{std::max(u.low, span.low), std::min(u.high, span.high)};
    if (!part.empty()) use(part);
  }

 private:
  PlaneWindow window_;
};

/// The same for a wheel.
class WheelWindow {
 public:
  explicit WheelWindow(const PlaneWindow& window)
      : window_(window), view_(window.across_axis, window.along_axis, window.normal, window.origin) {}

  bool exists() const { return true; }
  Interval u(const SliceHulls::Box& box) const;
  Interval heights(const SliceHulls::Box& box) const;
  template <class Use>
  static void clip(const Interval& u, const Interval& span, const Use& use) {
    for (int turn = -2; turn <= 2; ++turn) RailWindow::clip(u + turn * 2.0 * std::numbers::pi, span, use);
  }

 private:
  WheelBoxBounds bounds() const { return {view_, window_.across, window_.along}; }

  PlaneWindow window_;
  WheelView view_;
};

template <class Geometry>
using WindowOn = std::conditional_t<std::is_same_v<Geometry, WheelGeometry>, WheelWindow, RailWindow>;

/// Range of the heights over the window.
template <class Window>
Interval heights_over(const Window& window, const SliceNet& net, const SliceHulls& hulls) {
  Interval heights = Interval::none();
  if (!window.exists()) return heights;
  const Interval all_u = window.u(hulls.all());
  const auto wanted = [&](const Interval& group) {
    bool some = false;
    Window::clip(all_u, group, [&](const Interval&) { some = true; });
    return some;
  };
  hulls.visit(wanted, [&](const SliceHulls::Box& box, std::size_t group, int cell) {
    if (window.heights(box).empty()) return false;
    if (cell < 0) return true;
    // Only what the window sees of each span.
    const Interval u = window.u(box);
    for (int span = hulls.first_span(group); span < hulls.first_span(group + 1); ++span)
      Window::clip(u, hulls.span_range(net, span), [&](const Interval& part) {
        SliceHulls::Box seen;
        if (!net.hull(span, cell, part.low, part.high, seen.y, seen.w)) return;
        if (const Interval n = window.heights(seen); !n.empty()) heights.include(n);
      });
    return true;
  });
  return heights;
}

/// Marks the cells that may lie over the window.
template <class Window>
void mark_cells_over(const Window& window, const SliceHulls& hulls, std::vector<char>& marks) {
  if (!window.exists()) return;
  const Interval all_u = window.u(hulls.all());
  const auto wanted = [&](const Interval& group) {
    bool some = false;
    Window::clip(all_u, group, [&](const Interval&) { some = true; });
    return some;
  };
  hulls.visit(wanted, [&](const SliceHulls::Box& box, std::size_t, int cell) {
    if (window.heights(box).empty()) return false;
    if (cell >= 0) marks[static_cast<std::size_t>(cell)] = 1;
    return true;
  });
}

}  // namespace treadmark::spline
