// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::detection {
namespace {

// Arc length along the rail's section x = x_T from y_from to y_to, signed. The surface may end before y_to: straight on
// then.
double arc_length(const BodyPair& bodies, double x_T, double y_from, double y_to) {
  constexpr double kStep = 5e-5;
  const double length = y_to - y_from;
  if (length == 0.0) return 0.0;
  const int n = std::clamp(to_whole<int>(std::abs(length) / kStep), 32, 2000);
  const double y_low = std::min(y_from, y_to), step = std::abs(length) / n;
  std::vector<double> z(static_cast<std::size_t>(n) + 1);
  bodies.rail->heights({bodies.X_TR.inverse(), {x_T, y_low, 1.0, step, 1, n + 1}}, {z, {}, {}});
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double dz = z[static_cast<std::size_t>(i) + 1] - z[static_cast<std::size_t>(i)];
    sum += std::isnan(dz) ? step : std::sqrt(step * step + dz * dz);
  }
  return std::copysign(sum, length);
}

}  // namespace

ContactFrame contact_frame(const BodyPair& bodies, const ContactPatch& patch) {
  constexpr double kSteepest = std::numbers::pi / 2.0, kMargin = 1e-3;
  ContactFrame frame;
  frame.angle = patch.inclination;
  // A vertical contact plane cannot be told apart from one seen from the other side.
  if (std::abs(std::abs(frame.angle) - kSteepest) < kMargin)
    frame.angle = std::copysign(kSteepest - kMargin, frame.angle);
  const double z = height_at(*bodies.rail, bodies.X_TR.inverse(), {patch.x, patch.y});
  if (std::isnan(z))
    throw Error(ErrorKind::numerical,
                "the rail has no surface at the contact reference point: there is a hole in its data, or contact lies "
                "beyond its edge");
  frame.X_TC = {{patch.x, patch.y, z}, rotation_x(frame.angle)};
  return frame;
}

Grid2 potential_contact_grid(const BodyPair& bodies, const ContactPatch& patch, const ContactFrame& frame,
                             const PotentialContactSettings& settings) {
  const double x_reference = frame.X_TC.origin.x(), y_reference = frame.X_TC.origin.y();
  const double x_low = settings.reference.x() + patch.extent.box.x_min - x_reference;
  const double x_high = settings.reference.x() + patch.extent.box.x_max - x_reference;
  const double s_low = settings.reference.y() + arc_length(bodies, x_reference, y_reference, patch.extent.box.y_min);
  const double s_high = settings.reference.y() + arc_length(bodies, x_reference, y_reference, patch.extent.box.y_max);

  double dx = settings.dx, ds = settings.ds;
  const auto first = [](double low, double step) { return std::floor(low / step) - 1.0; };
  const auto last = [](double high, double step) { return std::ceil(high / step) + 1.0; };
  const auto count = [&](double low, double high, double step) { return last(high, step) - first(low, step) + 1.0; };
  for (bool double_x = true;
       settings.max_elements > 0 && count(x_low, x_high, dx) * count(s_low, s_high, ds) >= settings.max_elements;
       double_x = !double_x) {
    constexpr double kFewest = 10.0;
    const bool x_can = count(x_low, x_high, dx) > kFewest, s_can = count(s_low, s_high, ds) > kFewest;
    if (!x_can && !s_can) break;
    if ((double_x && x_can) || !s_can)
      dx *= 2.0;
    else
      ds *= 2.0;
  }
  constexpr double kMostElements = 1e7;
  if (!(count(x_low, x_high, dx) * count(s_low, s_high, ds) < kMostElements))
    throw Error(ErrorKind::configuration, "the potential contact area would have more than 10 million elements", {},
                "use larger dx, ds");
  Grid2 grid;
  grid.dx = dx;
  grid.dy = ds;
  grid.x0 = first(x_low, dx) * dx;
  grid.y0 = first(s_low, ds) * ds;
  grid.nx = to_whole<int>(count(x_low, x_high, dx));
  grid.ny = to_whole<int>(count(s_low, s_high, ds));
  return grid;
}

}  // namespace treadmark::detection
