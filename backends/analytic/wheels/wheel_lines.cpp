// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheels/wheel_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/kernel.hpp"

namespace treadmark::analytic {

struct WheelLines::Four {
  explicit Four(const WheelBody& body, const Vec3& n, bool exact) {
    input.n_x = n.x(), input.n_y = n.y(), input.n_z = n.z();
    input.a = n.x() * n.x() + n.z() * n.z();
    input.radius = body.nominal_radius;
    input.r_max = body.r_max;
    input.near = WheelRay::kNear;
    input.exact = exact;
    input.flats = body.narrow_flats.data();
    input.flat_count = static_cast<int>(body.narrow_flats.size());
    input.chords = nullptr;
    if (n.y() != 0.0) {
      const ChordSlopes::Cells cells = body.chords.towards(n.y() > 0.0);
      input.chords = cells.slopes, input.chord_cells = cells.count;
      input.chords_begin = cells.begin, input.chords_per_length = cells.per_length;
    }
    input.max_d_theta = body.flats.max_d_theta();
    input.max_d_y = body.flats.max_d_y();
    usable = body.all_narrow && input.a > 1e-18;
  }
  Vec3 origin(int k) const { return {lanes.o_x[k], lanes.o_y[k], lanes.o_z[k]}; }
  void set(int k, const Vec3& at, double guess) {
    lanes.o_x[k] = at.x(), lanes.o_y[k] = at.y(), lanes.o_z[k] = at.z();
    lanes.t[k] = guess;
  }

  WheelHit hit(int k) const {
    const WheelLanesHits& l = lanes;
    if ((by_kernel >> k & 1u) == 0) return hits[k];
    return {l.t[k], l.x[k], l.y[k], l.z[k], l.r[k], l.f_theta[k], l.f_y[k], l.depth[k]};
  }

  bool usable;
  int piece = -1;
  WheelLanesInput input;
  WheelLanesHits lanes;  ///< heights of all hits, and what else the kernel found
  unsigned by_kernel = 0;
  WheelHit hits[kWheelLanes];  ///< of the rest
};

WheelLines::WheelLines(const WheelBody& body, const Pose& X_SP, const HeightsOut& out)
    : body_(body),
      X_(X_SP),
      out_(out),
      n_(X_SP.rotation.col(2)),
      slopes_(!out.dzdx.empty() || !out.dzdy.empty()),
      kernel_(fastest_kernel<WheelLanesKernel>().hits) {}

unsigned WheelLines::cast(Four& four, int count, WheelRay& ray) const {
  WheelLanesHits& l = four.lanes;
  unsigned found = 0, tried = 0;
  four.by_kernel = 0;
  double guesses[kWheelLanes];
  const auto alone = [&](int k, double guess) {
    tried |= 1u << k;
    if (!ray.cast(four.origin(k), guess, four.hits[k], slopes_)) return;
    found |= 1u << k;
    l.t[k] = four.hits[k].t;
  };
  if (count > 1 && std::isnan(l.t[0]) && n_.y() != 0.0) {  // the profile's piece is not known
    alone(0, kNaN);
    if (found == 0) {
      for (int k = 1; k < count; ++k) alone(k, kNaN);
      return found;
    }
    for (int k = 0; k < count; ++k)
      if (std::isnan(l.t[k])) l.t[k] = four.hits[0].t;
  }
  std::copy(std::begin(l.t), std::end(l.t), guesses);
  if (four.usable && count > 1) {
    const int middle = (count - 1) / 2;
    const double y = n_.y() == 0.0 ? l.o_y[middle] : l.o_y[middle] + l.t[middle] * n_.y();
    const int piece = body_.curve.find(y, std::max(0, four.piece));
    if (piece != four.piece) {
      four.piece = piece;
      four.input.piece = body_.pieces[static_cast<std::size_t>(piece)];
    }
    for (int k = count; k < kWheelLanes; ++k) four.set(k, four.origin(count - 1), l.t[count - 1]);
    four.by_kernel = kernel_(four.input, l) & ((1u << count) - 1u) & ~tried;
    if (found != 0) l.t[0] = four.hits[0].t;
    found |= four.by_kernel;
    tried |= four.by_kernel;
  }
  for (int k = 0; k < count; ++k)
    if ((tried >> k & 1u) == 0) alone(k, guesses[k]);
  return found;
}

Vec2 WheelLines::slopes(const WheelHit& hit) const {
  const double inverse = 1.0 / hit.r, sin = hit.x * inverse, cos = hit.z * inverse, along = hit.f_theta * inverse;
  const double f_x = sin + along * cos, f_z = cos - along * sin;
  const auto part = [&](int k) {
    return f_x * X_.rotation(0, k) + hit.f_y * X_.rotation(1, k) + f_z * X_.rotation(2, k);
  };
  const double per = -1.0 / part(2);
  return {part(0) * per, part(1) * per};
}

void WheelLines::write(std::size_t i, bool found, const Four& four, int k) const {
  if (!out_.z.empty()) out_.z[i] = found ? four.lanes.t[k] : kNaN;
  if (!slopes_) return;
  const Vec2 s = found ? slopes(four.hit(k)) : Vec2::Constant(kNaN);
  if (!out_.dzdx.empty()) out_.dzdx[i] = s.x();
  if (!out_.dzdy.empty()) out_.dzdy[i] = s.y();
}

void WheelLines::march(const Grid2& g, bool along_x, int begin, int end) const {
  WheelRay ray(body_, n_);
  Four four(body_, n_, slopes_);
  const int count = along_x ? g.nx : g.ny;
  double first[kWheelLanes] = {kNaN, kNaN, kNaN, kNaN};  // heights at the start of the line before
  struct Trail {
    double t1 = kNaN, t2 = kNaN, t3 = kNaN;  // heights before, nearest first
  };
  // Four points wait for the four before them in their line, not for those of another line.
  constexpr int kTogether = 2;
  for (int from = begin; from < end; from += kTogether) {
    Trail trails[kTogether];
    for (int i = 0; i < count; i += kWheelLanes) {
      const int lanes = std::min(kWheelLanes, count - i);
      for (int line = from; line < std::min(end, from + kTogether); ++line) {
        auto& [t1, t2, t3] = trails[line - from];
        const double rise = std::isnan(t2) ? 0.0 : t1 - t2, bend = std::isnan(t3) ? 0.0 : t1 - 2.0 * t2 + t3;
        for (int k = 0; k < lanes; ++k) {
          const double x = along_x ? g.x(i + k) : g.x(line), y = along_x ? g.y(line) : g.y(i + k);
          const double guess = i == 0 ? first[k] : t1 + (k + 1) * (rise + 0.5 * (k + 2) * bend);
          four.set(k, X_.origin + X_.rotation.col(0) * x + X_.rotation.col(1) * y, guess);
        }
        const unsigned found = cast(four, lanes, ray);
        for (int k = 0; k < lanes; ++k) {
          const bool hit = (found >> k & 1u) != 0;
          write(along_x ? g.index(i + k, line) : g.index(line, i + k), hit, four, k);
          t3 = t2;
          t2 = t1;
          t1 = hit ? four.lanes.t[k] : kNaN;
          if (i == 0) first[k] = t1;
        }
      }
    }
  }
}

void WheelLines::follow(std::span<const Vec2> points, std::size_t begin, std::size_t end) const {
  WheelRay ray(body_, n_);
  Four four(body_, n_, slopes_);
  // every line starts from the tangent plane at the last hit, bent as that hit lay off its own start
  double z = kNaN, bend = 0.0;
  Vec2 slope = Vec2::Zero(), before = Vec2::Zero();
  for (std::size_t i = begin; i < end; i += kWheelLanes) {
    const int lanes = static_cast<int>(std::min<std::size_t>(kWheelLanes, end - i));
    double tangent[kWheelLanes], distance_2[kWheelLanes];
    for (int k = 0; k < lanes; ++k) {
      const Vec2& p = points[i + static_cast<std::size_t>(k)];
      const Vec2 d = p - before;
      distance_2[k] = d.squaredNorm();
      tangent[k] = z + slope.dot(d);
      four.set(k, X_.origin + X_.rotation.col(0) * p.x() + X_.rotation.col(1) * p.y(),
               tangent[k] + bend * distance_2[k]);
    }
    const unsigned found = cast(four, lanes, ray);
    int last = -1;
    for (int k = 0; k < lanes; ++k) {
      const bool hit = (found >> k & 1u) != 0;
      write(i + static_cast<std::size_t>(k), hit, four, k);
      if (hit) last = k;
    }
    if (last < 0) continue;
    const double t = four.lanes.t[last];
    bend = distance_2[last] > 0.0 && !std::isnan(tangent[last]) ? (t - tangent[last]) / distance_2[last] : 0.0;
    z = t;
    slope = slopes(four.hit(last));
    before = points[i + static_cast<std::size_t>(last)];
  }
}

}  // namespace treadmark::analytic
