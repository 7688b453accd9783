// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/virtual/scan_line.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/virtual/draws.hpp"
#include "treadmark/scans/virtual/drop_outs.hpp"
#include "treadmark/scans/virtual/shadow.hpp"

namespace treadmark::scans::scanner {
namespace {

constexpr double kJitter = 0.25;       // of the step, to both sides
constexpr double kFarthestOff = 5e-3;  // [m] outliers along the beam
constexpr double kRoom = 50e-3;        // [m] surroundings beyond the surface
constexpr std::size_t kBlobs = 5;
constexpr double kNearestBlob = 15e-3, kFarthestBlob = 40e-3;  // [m] from the surface
constexpr double kBlobSize = 1.5e-3;                           // [m] standard deviation

/// y at even arc lengths, jittered; the same chance for every place of the line.
std::vector<double> places(const Station& station, double step, Draws draws) {
  std::vector<double> y;
  const double length = station.length();
  if (!(length > 0.0)) return y;
  y.reserve(to_whole<std::size_t>(length / step) + 2);
  const double phase = draws.uniform();
  std::size_t piece = 1;
  const auto last = to_whole<long>(length / step) + 2;
  for (long i = -1; i <= last; ++i) {
    const double arc = (static_cast<double>(i) + phase + draws.uniform(-kJitter, kJitter)) * step;
    if (arc > 0.0 && arc < length) y.push_back(station.y_at(arc, piece));
  }
  return y;
}

Vec3 outlier(const LineJob& job, const Vec3& on_surface_S, const Vec3& beam_S, Draws& draws) {
  const double kind = draws.uniform();
  if (kind < 0.5) return on_surface_S + draws.uniform(-kFarthestOff, kFarthestOff) * beam_S;
  if (kind < 0.75) {
    const double x = draws.uniform(), y = draws.uniform(), z = draws.uniform();
    return job.around.low_S + Vec3(x, y, z).cwiseProduct(job.around.high_S - job.around.low_S);
  }
  const Vec3& blob = job.around.blobs_S[draws.index(job.around.blobs_S.size())];
  return blob + kBlobSize * draws.gaussian3();
}

}  // namespace

Surroundings surroundings(const FirstLook& part, std::uint64_t seed) {
  Surroundings around;
  around.low_S = around.high_S = part.patches.front().position_S;
  for (const Patch& patch : part.patches) {
    around.low_S = around.low_S.cwiseMin(patch.position_S).eval();
    around.high_S = around.high_S.cwiseMax(patch.position_S).eval();
  }
  around.low_S.array() -= kRoom;
  around.high_S.array() += kRoom;
  Draws draws(seed, Purpose::blobs);
  for (std::size_t i = 0; i < kBlobs; ++i) {
    const Patch& patch = part.patches[draws.index(part.patches.size())];
    around.blobs_S.emplace_back(patch.position_S + draws.uniform(kNearestBlob, kFarthestBlob) * patch.normal_S);
  }
  return around;
}

Vec3 along_line(const ScannerSettings& settings, const Vec3& position_S) {
  if (!settings.line) return position_S;
  return settings.line(position_S.x()).apply({0.0, position_S.y(), position_S.z()});
}

Line scan_line(const LineJob& job, std::size_t line, double u) {
  const ScannerSettings& settings = job.settings;
  const std::uint64_t seed = settings.seed;
  Line out;
  Station own;
  if (job.common == nullptr) own = Station(job.surface, settings.body, u, job.raster, job.longest);
  const std::vector<double> y = places(job.common != nullptr ? *job.common : own, job.step,
                                       Draws(seed, Purpose::positions, job.pass_number, line));
  if (y.empty()) return out;

  const bool from_stand = job.pass.stand_S.has_value();
  const bool need_normals = from_stand || settings.noise > 0.0 || settings.noise_lateral > 0.0 ||
                            settings.outliers > 0.0 || settings.most_incidence > 0.0;
  std::vector<double> z(y.size()), dzdx(need_normals ? y.size() : 0), dzdy(dzdx.size());
  heights_along(job.surface, settings.body, u, y, {z, dzdx, dzdy});

  const Pose X_SP = natural_plane(settings.body, u);
  // along a line noise stays in the section's own axes
  const Pose X_CP =
      settings.line ? job.X_CS * settings.line(u) * Pose{Vec3(-u, 0.0, 0.0), Mat3::Identity()} * X_SP : job.X_CS * X_SP;
  const Vec3 stand_S = job.pass.stand_S.value_or(Vec3::Zero()), stand_P = X_SP.apply_inverse(stand_S);
  const double least_cosine = settings.most_incidence > 0.0 ? std::cos(settings.most_incidence) : -1.0;
  DropOuts drop_outs(settings.drop_outs, Draws(seed, Purpose::drop_outs, job.pass_number, line));
  Draws noise(seed, Purpose::noise, job.pass_number, line), spoilt(seed, Purpose::outliers, job.pass_number, line);
  out.points_C.reserve(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (std::isnan(z[i])) continue;
    const bool dropped = settings.drop_outs > 0.0 && drop_outs.next();
    const Vec3 p_P(0.0, y[i], z[i]),
        normal_P = need_normals ? normal_in_plane(settings.body, dzdx[i], dzdy[i]) : Vec3::UnitZ();
    const Vec3 beam_P = from_stand ? (stand_P - p_P).normalized() : normal_P;  // towards the scanner
    const double cosine = from_stand ? normal_P.dot(beam_P) : std::fabs(normal_P.z());
    if (cosine < least_cosine) {
      ++out.lost_occlusion;
    } else if (from_stand && (cosine <= 0.0 || in_shadow(job.surface, stand_S, X_SP.apply(p_P)))) {
      ++out.lost_shadow;
    } else if (job.holes.contains(X_SP.apply(p_P))) {
      ++out.lost_holes;
    } else if (dropped) {
      ++out.lost_drop_outs;
    } else if (settings.outliers > 0.0 && spoilt.uniform() < settings.outliers) {
      ++out.outliers;
      out.points_C.push_back(
          job.X_CS.apply(along_line(settings, outlier(job, X_SP.apply(p_P), X_SP.rotation * beam_P, spoilt))));
    } else {
      ++out.on_surface;
      Vec3 p = p_P;
      if (settings.noise > 0.0) p += settings.noise * noise.gaussian() * beam_P;
      if (settings.noise_lateral > 0.0) {
        const Vec3 side = beam_P.unitOrthogonal();
        const double a = noise.gaussian(), b = noise.gaussian();
        p += settings.noise_lateral * (a * side + b * beam_P.cross(side));
      }
      out.points_C.push_back(X_CP.apply(p));
    }
  }
  return out;
}

}  // namespace treadmark::scans::scanner
