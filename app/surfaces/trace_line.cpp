// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/trace_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/backends/sampling/lateral_nodes.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::app {
namespace {

/// The line as a curve of its one moving parameter.
class Tracer {
 public:
  Tracer(const Surface& surface, bool section, double fixed) : surface_(surface), section_(section), fixed_(fixed) {}

  SurfaceJet at(double t) const {
    const Vec2 uv = section_ ? Vec2(fixed_, t) : Vec2(t, fixed_);
    SurfaceJet jet;
    evaluate(surface_, {&uv, 1}, {&jet, 1});
    if (!jet.found() || !tangent(jet).allFinite()) leave(t);
    return jet;
  }
  const Vec3& tangent(const SurfaceJet& jet) const { return section_ ? jet.pv : jet.pu; }

  double length(double from, double to) const {
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from), off = std::sqrt(0.6) * half;
    const auto speed = [&](double t) { return tangent(at(t)).norm(); };
    return std::fabs(half) * (5.0 * speed(middle - off) + 8.0 * speed(middle) + 5.0 * speed(middle + off)) / 9.0;
  }

  /// The parameter a length further on towards end, or end itself where that is nearer.
  double step(double from, double end, double wanted, double& walked) const {
    constexpr int kMost = 12;
    constexpr double kExact = 1e-12;  // [m]
    const double direction = end > from ? 1.0 : -1.0;
    double to = from;
    walked = 0.0;
    for (int i = 0; i < kMost && std::fabs(walked - wanted) > kExact; ++i) {
      const double next = to + direction * (wanted - walked) / tangent(at(to)).norm();
      to = direction * (next - end) > 0.0 ? end : next;
      walked = length(from, to);
      if (to == end && walked <= wanted) break;
    }
    return to;
  }

  TracedPoint point(double t, double s) const {
    const SurfaceJet jet = at(t);
    const SurfaceShape shape = shape_of(jet);
    TracedPoint out;
    out.s = s;
    (section_ ? out.u : out.v) = fixed_;
    (section_ ? out.v : out.u) = t;
    out.position = jet.p;
    out.normal = shape.normal;
    out.curvature_1 = shape.curvature_1;
    out.curvature_2 = shape.curvature_2;
    out.curvature_along = normal_curvature(shape, tangent(jet));
    return out;
  }

 private:
  [[noreturn]] void leave(double t) const {
    throw Error(ErrorKind::input_data,
                fmt::format("the line leaves the surface at {} = {:.9g}", section_ ? "v" : "u", t), {},
                section_ ? "limit y, or choose another section" : "limit the range, or choose another line");
  }

  const Surface& surface_;
  bool section_;
  double fixed_;
};

double v_at(const Surface& surface, Body body, double u, double y) {
  const Vec2 place(0.0, y);
  SurfacePoint found;
  surface.locate(natural_plane(body, u), {&place, 1}, {&found, 1});
  if (found.status == LocateStatus::outside || std::isnan(found.v))
    throw Error(ErrorKind::input_data,
                fmt::format("there is no surface at u = {:.9g} {}, y = {:.6g} mm, where the line begins or ends", u,
                            body == Body::wheel ? "rad" : "m", 1e3 * y));
  return found.v;
}

}  // namespace

TracedLine trace_line(const Surface& surface, Body body, const TraceRequest& r) {
  if (!(r.step > 0.0) || !std::isfinite(r.step))
    throw Error(ErrorKind::configuration, "the step along a line must be positive");
  if (!std::isfinite(r.at) || (r.range && !(r.range->first < r.range->second)))
    throw Error(ErrorKind::configuration, "a line must run from a smaller to a greater number");
  if (!r.section && !r.range)
    throw Error(ErrorKind::configuration, "a line along a surface needs a beginning and an end", {}, "give its range");
  double from = 0.0, to = 0.0, fixed = r.at;
  if (r.section) {
    constexpr double kRim = 1e-9;  // [m], rounding decides at the ends themselves
    std::pair<double, double> y{0.0, 0.0};
    if (r.range) {
      y = *r.range;
    } else {
      const std::array<double, 1> station{r.at};
      const sampling::LateralArc arc = sampling::lateral_arc(surface, body, station, r.step, -kInfinity, kInfinity);
      arc.require_room();
      y = {arc.y.front() + kRim, arc.y.back() - kRim};
    }
    from = v_at(surface, body, r.at, y.first);
    to = v_at(surface, body, r.at, y.second);
  } else {
    from = r.range->first;
    to = r.range->second;
    fixed = v_at(surface, body, from, r.at);
  }
  const Tracer tracer(surface, r.section, fixed);
  TracedLine line{body, std::string(surface.backend()), has_exact_derivatives(surface), {}};
  double t = from, s = 0.0;
  line.points.push_back(tracer.point(t, s));
  while (t != to) {
    check_cancelled();
    double walked = 0.0;
    t = tracer.step(t, to, r.step, walked);
    s += walked;
    line.points.push_back(tracer.point(t, s));
    if (static_cast<double>(line.points.size()) > kMostTraced)
      throw Error(ErrorKind::configuration, fmt::format("more than {:g} points along a line", kMostTraced), {},
                  "take longer steps");
  }
  return line;
}

std::string traced_csv(const TracedLine& line) {
  const bool wheel = line.body == Body::wheel;
  std::string out =
      fmt::format("s_mm,u_{},v,x_mm,y_mm,z_mm,nx,ny,nz,curvature_1_per_m,curvature_2_per_m,curvature_along_per_m\n",
                  wheel ? "deg" : "mm");
  for (const TracedPoint& p : line.points)
    out += fmt::format("{:.9g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.9g},{:.9g},{:.9g}\n",
                       1e3 * p.s, wheel ? p.u * 180.0 / kPi : 1e3 * p.u, p.v, 1e3 * p.position.x(),
                       1e3 * p.position.y(), 1e3 * p.position.z(), p.normal.x(), p.normal.y(), p.normal.z(),
                       p.curvature_1, p.curvature_2, p.curvature_along);
  return out;
}

}  // namespace treadmark::app
