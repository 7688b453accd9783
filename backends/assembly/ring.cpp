// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/assembly/ring.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/assembly/limited_surface.hpp"
#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::assembly {
namespace {

using displacement::OffsetJet;
using displacement::OffsetRange;

/// How far a circle of radius r lies above its lowest point at x, negative upwards: g = sqrt(r^2 - x^2) - r, and
/// derivatives.
struct Rise {
  double g, g_x, g_r, g_xx, g_xr, g_rr;
  Rise(double x, double r) {
    const double q = std::sqrt((r - x) * (r + x)), q3 = q * q * q;
    g = -x * x / (q + r);
    g_x = -x / q;
    g_r = x * x / (q * (q + r));
    g_xx = -r * r / q3;
    g_xr = x * r / q3;
    g_rr = -x * x / q3;
  }
};

/// What a straight rail is bent upwards by to become a ring. Beyond the ends nothing is bent any further.
class RingField final : public displacement::OffsetField {
 public:
  RingField(analytic::GraphCurve profile, double radius, double half_length)
      : profile_(std::move(profile)), radius_(radius), half_length_(half_length) {}

  OffsetJet jet(double u, double y) const override {
    const analytic::Jet z = profile(y, 0);
    const bool beyond = std::fabs(u) > half_length_;
    const Rise rise(std::clamp(u, -half_length_, half_length_), radius_ + z.h);
    return {rise.g,
            beyond ? 0.0 : rise.g_x,
            rise.g_r * z.dh,
            beyond ? 0.0 : rise.g_xx,
            beyond ? 0.0 : rise.g_xr * z.dh,
            rise.g_rr * z.dh * z.dh + rise.g_r * z.ddh};
  }

  void evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
                std::span<double> d_y) const override {
    int piece = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double across = clamped(y[i]);
      double slope;
      piece = profile_.find(across, piece);
      const double r = radius_ + profile_.height_and_slope(across, piece, slope),
                   x = std::clamp(u[i], -half_length_, half_length_);
      const double q = std::sqrt((r - x) * (r + x));
      value[i] = -x * x / (q + r);
      if (!d_u.empty()) d_u[i] = x == u[i] ? -x / q : 0.0;
      if (!d_y.empty()) d_y[i] = across == y[i] ? x * x / (q * (q + r)) * slope : 0.0;
    }
  }

  OffsetRange range(const Rectangle& uy) const override {
    const analytic::CurveRange z = profile_.range(clamped(uy.y_min), clamped(uy.y_max));
    const double far = std::min(std::max(std::fabs(uy.x_min), std::fabs(uy.x_max)), half_length_);
    const double near =
        uy.x_min <= 0.0 && uy.x_max >= 0.0 ? 0.0 : std::min({std::fabs(uy.x_min), std::fabs(uy.x_max), half_length_});
    const Rise most(far, radius_ + z.h_min), least(near, radius_ + z.h_max);
    return {most.g, least.g, std::fabs(most.g_x), most.g_r * std::max(std::fabs(z.dh_min), std::fabs(z.dh_max))};
  }

  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  double clamped(double y) const { return std::clamp(y, profile_.y_min(), profile_.y_max()); }
  analytic::Jet profile(double y, int guess) const {
    const double across = clamped(y);
    analytic::Jet z = profile_.jet(across, profile_.find(across, guess));
    if (across != y) z.dh = z.ddh = 0.0;
    return z;
  }

  analytic::GraphCurve profile_;
  double radius_, half_length_;
};

}  // namespace

double ring_half_length(double radius, double least_z) {
  if (!(radius < 0.0) || !std::isfinite(radius))
    throw Error(ErrorKind::configuration, "a ring that a wheel runs in needs a negative, finite nominal radius");
  if (!(least_z > radius))
    throw Error(ErrorKind::configuration, "the profile of the ring reaches its axle", {},
                "check the nominal radius and the height of the profile");
  return kRingReach * (least_z - radius);
}

std::shared_ptr<const Surface> make_ring_surface(const ArcChain& chain, double radius) {
  analytic::GraphCurve profile = analytic::graph_of(chain);
  const double half_length = ring_half_length(radius, profile.range(profile.y_min(), profile.y_max()).h_min);
  auto field = std::make_shared<RingField>(std::move(profile), -radius, half_length);
  auto bent = displacement::make_displaced_surface(analytic::make_prismatic_surface(chain), std::move(field),
                                                   Body::rail, "analytic");
  return limit_along(std::move(bent), -half_length, half_length);
}

SliceSet ring_slices(const Profile& profile, double radius) {
  if (profile.z.empty()) throw Error(ErrorKind::configuration, "the profile of a ring has no points");
  const double half_length = ring_half_length(radius, *std::min_element(profile.z.begin(), profile.z.end()));
  // the error of cubic splines is h^4/384 of the fourth derivative, which is 35/r^3 at the ends
  constexpr int kHalf = 60;
  SliceSet slices;
  slices.body = Body::rail;
  slices.name = profile.name;
  for (int i = -kHalf; i <= kHalf; ++i) {
    const double x = half_length * i / kHalf;
    slices.u.push_back(x);
    Profile& section = slices.profiles.emplace_back(profile);
    for (double& z : section.z) z += Rise(x, z - radius).g;
  }
  return slices;
}

TriangleMesh lower_part(const TriangleMesh& ring, double radius) {
  TriangleMesh part = ring;
  std::erase_if(part.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](auto corner) { return !(ring.vertices[static_cast<std::size_t>(corner)].z() > radius); });
  });
  if (part.triangles.empty())
    throw Error(ErrorKind::configuration, "the triangles of the ring all lie above its axle", {},
                "the axle is at z = nominal radius of the rail's frame, the wheel runs at z = 0");
  return part;
}

}  // namespace treadmark::assembly
