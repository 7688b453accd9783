// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/sample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/defects/flat_depth.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::analytic {

namespace {

void require_step(double step) {
  if (!(step > 0.0) || !std::isfinite(step))
    throw Error(ErrorKind::configuration, "the sampling step must be positive");
}

/// Points by fractions of the turning angle are equidistant on an arc even where it is vertical; polynomial pieces are
/// nearly straight, there equal steps in y do.
void sample_piece(const GraphCurve& curve, int piece, double step, Profile& out) {
  const double from = curve.piece_start(piece), to = curve.piece_end(piece);
  const Jet a = curve.jet(from, piece), b = curve.jet(to, piece);
  const double alpha = std::atan(a.dh), beta = std::atan(b.dh);
  const Jet middle = curve.jet(0.5 * (from + to), piece);
  const double k = middle.ddh / std::pow(1.0 + middle.dh * middle.dh, 1.5);
  const bool arc = k != 0.0 && std::fabs((std::sin(beta) - std::sin(alpha)) - k * (to - from)) < 1e-9;
  double length = (beta - alpha) / k;
  if (!arc) {
    // equal steps in y are longest where the piece is steepest
    double steepest = 0.0;
    for (int i = 0; i <= 32; ++i)
      steepest = std::max(steepest, std::fabs(curve.jet(from + (to - from) * i / 32, piece).dh));
    length = (to - from) * std::hypot(1.0, steepest);
  }
  const int n = std::max(1, to_whole<int>(std::ceil(length / step - 1e-9)));
  for (int i = 0; i < n; ++i) {
    const double f = static_cast<double>(i) / n;
    const double y = arc ? from + (std::sin(alpha + f * (beta - alpha)) - std::sin(alpha)) / k : from + f * (to - from);
    out.y.push_back(std::clamp(y, from, to));
    out.z.push_back(curve.jet(out.y.back(), piece).h);
  }
}

}  // namespace

Profile sample_profile(const StandardProfile& profile, double step) {
  require_step(step);
  const std::variant<ArcChain, GraphCurve> shape = standard_curve(profile.name);
  if (const auto* chain = std::get_if<ArcChain>(&shape)) {
    Profile out = sample_profile(*chain, Body::rail, step);
    out.name = profile.name;
    return out;
  }
  const auto& curve = std::get<GraphCurve>(shape);
  Profile out;
  out.body = Body::wheel;
  out.name = profile.name;
  for (int piece = 0; piece < curve.piece_count(); ++piece) sample_piece(curve, piece, step, out);
  const int last = curve.piece_count() - 1;
  out.y.push_back(curve.y_max());
  out.z.push_back(curve.jet(curve.y_max(), last).h);
  std::reverse(out.y.begin(), out.y.end());
  std::reverse(out.z.begin(), out.z.end());
  return out;
}

Profile sample_profile(const ArcChain& chain, Body body, double step) {
  require_step(step);
  Profile out;
  out.body = body;
  out.name = "arc chain";
  ChainPoint p;
  for (const ChainSegment& seg : resolve(chain)) {
    const int n = std::max(1, to_whole<int>(std::ceil(seg.length / step - 1e-9)));
    for (int i = 0; i < n; ++i) {
      p = point_on(seg, seg.length * i / n);
      out.y.push_back(p.y);
      out.z.push_back(p.z);
    }
    p = point_on(seg, seg.length);
  }
  out.y.push_back(p.y);
  out.z.push_back(p.z);
  if (body == Body::wheel) {
    std::reverse(out.y.begin(), out.y.end());
    std::reverse(out.z.begin(), out.z.end());
  }
  return out;
}

SliceSet sample_wheel(const Profile& profile, double nominal_radius, const std::vector<WheelFlat>& flats, double step,
                      double coarse_angle) {
  require_step(step);
  if (!(nominal_radius > 0.0)) throw Error(ErrorKind::configuration, "a wheel needs a positive nominal radius");
  if (!(coarse_angle > 0.0)) throw Error(ErrorKind::configuration, "the coarse angle must be positive");
  const FlatDepth depth(flats, nominal_radius);
  const double fine = std::min(step / nominal_radius, coarse_angle);
  SliceSet slices;
  slices.body = Body::wheel;
  slices.name = profile.name + " with flats";
  // Candidates on the fine raster; away from flats only every so many of them are kept.
  const int n = to_whole<int>(std::ceil(2.0 * kPi / fine));
  const int stride = std::max(1, to_whole<int>(coarse_angle / (2.0 * kPi / n)));
  const double margin = 4.0 * coarse_angle;
  for (int i = 0, kept = -stride; i <= n; ++i) {
    const double theta = -kPi + 2.0 * kPi * i / n;
    if (!depth.touches(theta, margin) && i - kept < stride && i != n) continue;
    kept = i;
    Profile slice = profile;
    for (std::size_t j = 0; j < slice.y.size(); ++j) slice.z[j] -= depth.jet(theta, slice.y[j]).d;
    slices.u.push_back(theta);
    slices.profiles.push_back(std::move(slice));
  }
  return slices;
}

}  // namespace treadmark::analytic
