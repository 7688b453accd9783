// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/virtual/first_look.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/roots.hpp"

namespace treadmark::scans::scanner {
namespace {

constexpr std::size_t kStations = 512, kSpread = 16;
constexpr double kPiecesAcross = 384.0;
constexpr double kTurn = 2.0 * std::numbers::pi;

FirstLook part_of(const Surface& surface, const ScannerSettings& settings) {
  FirstLook part;
  const Box3 box = surface.bounds();
  part.y_min = std::max(settings.y_min, box.min.y());
  part.y_max = std::min(settings.y_max, box.max.y());
  if (!std::isfinite(part.y_min) || !std::isfinite(part.y_max))
    throw Error(ErrorKind::configuration, "a surface without lateral ends cannot be scanned as a whole", {},
                "give the range of y that is scanned");
  part.u_min = settings.u_min;
  part.u_max = settings.u_max;
  if (settings.body == Body::wheel) {
    constexpr double kRounding = 1e-9;
    part.metres_per_u = settings.nominal_radius;
    if (std::isinf(part.u_min) && std::isinf(part.u_max)) {
      part.u_min = -std::numbers::pi;
      part.u_max = std::numbers::pi;
    }
    if (!std::isfinite(part.u_min) || !std::isfinite(part.u_max) || part.u_max - part.u_min > kTurn * (1.0 + kRounding))
      throw Error(ErrorKind::configuration, "the scanned part of a wheel needs two ends, not more than a turn apart");
    part.closed = part.u_max - part.u_min >= kTurn * (1.0 - kRounding);
  } else {
    part.u_min = std::max(part.u_min, box.min.x());
    part.u_max = std::min(part.u_max, box.max.x());
    if (!std::isfinite(part.u_min) || !std::isfinite(part.u_max))
      throw Error(ErrorKind::configuration, "a rail without ends cannot be scanned as a whole", {},
                  "give the range along the track that is scanned");
  }
  if (!(part.u_min < part.u_max) || !(part.y_min < part.y_max))
    throw Error(ErrorKind::configuration, "there is no surface in the range to be scanned");
  return part;
}

class Look {
 public:
  Look(const Surface& surface, const ScannerSettings& settings, FirstLook& part)
      : surface_(surface), body_(settings.body), part_(part) {
    longest_ = (part.y_max - part.y_min) / kPiecesAcross;
    step_ = (part.u_max - part.u_min) / static_cast<double>(kStations);
    for (std::size_t i = 0; i < kSpread; ++i)
      part.spread.push_back(part.u_min +
                            (part.u_max - part.u_min) * (static_cast<double>(i) + 0.5) / static_cast<double>(kSpread));
    raster_ = raster(surface, body_, part.spread, part.y_min, part.y_max, longest_);
  }

  void run(const Progress& progress) {
    std::vector<Station> stations(kStations);
    if (surface_.constant_profile())
      stations.assign(kStations, Station(surface_, body_, middle(0), raster_, longest_));
    else
      parallel_for(kStations, [&](std::size_t i) {
        if (!progress.stop_requested()) stations[i] = Station(surface_, body_, middle(i), raster_, longest_);
      });
    if (progress.stop_requested()) throw Error(ErrorKind::numerical, "the scan was stopped");
    std::vector<std::vector<Patch>> patches(kStations);
    parallel_for(kStations, [&](std::size_t i) { patches[i] = patches_of(stations, i); });
    std::size_t count = 0;
    for (const auto& some : patches) count += some.size();
    part_.patches.reserve(count);
    std::size_t best = kStations;  // the present station that is nearest to the middle
    for (std::size_t i = 0; i < kStations; ++i) {
      const auto off = [](std::size_t k) { return std::abs(static_cast<long>(k) - static_cast<long>(kStations / 2)); };
      if (stations[i].length() > 0.0 && (best == kStations || off(i) < off(best))) best = i;
      part_.patches.insert(part_.patches.end(), patches[i].begin(), patches[i].end());
    }
    if (best == kStations) throw Error(ErrorKind::configuration, "there is no surface in the range to be scanned");
    part_.reference = std::move(stations[best]);
    for (const Patch& patch : part_.patches) part_.area += patch.area;
  }

 private:
  double middle(std::size_t i) const { return part_.u_min + step_ * (static_cast<double>(i) + 0.5); }

  bool present(double u) const {
    std::vector<double> h(raster_.size());
    heights_along(surface_, body_, u, raster_, {h, {}, {}});
    return std::any_of(h.begin(), h.end(), [](double z) { return !std::isnan(z); });
  }

  /// How far the surface reaches from a present station towards its neighbour: half way, or to its end.
  double reach(const std::vector<Station>& stations, std::size_t i, int direction) const {
    const bool last = direction < 0 ? i == 0 : i + 1 == kStations;
    if (last && !part_.closed) return 0.5 * step_;
    const std::size_t other = direction < 0 ? (i + kStations - 1) % kStations : (i + 1) % kStations;
    if (stations[other].length() > 0.0) return 0.5 * step_;
    constexpr double kAccuracy = 1e-3;
    constexpr int kHalvings = 20;
    const auto there = [&](double at) { return present(middle(i) + direction * at); };
    return bisect(0.0, step_, there, kHalvings, kAccuracy * step_).low;
  }

  std::vector<Patch> patches_of(const std::vector<Station>& stations, std::size_t i) const {
    const Station& station = stations[i];
    std::vector<Patch> patches;
    if (!(station.length() > 0.0)) return patches;
    const double u = middle(i), width = reach(stations, i, -1) + reach(stations, i, 1);
    const std::vector<double>&y = station.y(), &h = station.h(), &arc = station.arc();
    std::vector<double> z(y.size()), dzdx(y.size()), dzdy(y.size());
    heights_along(surface_, body_, u, y, {z, dzdx, dzdy});
    const Pose X_SP = natural_plane(body_, u);
    for (std::size_t k = 0; k < y.size(); ++k) {
      const double before = k > 0 ? arc[k] - arc[k - 1] : 0.0, after = k + 1 < y.size() ? arc[k + 1] - arc[k] : 0.0;
      const double l = 0.5 * (before + after);
      if (std::isnan(h[k]) || !(l > 0.0)) continue;
      Patch patch;
      patch.u = u;
      patch.y = y[k];
      patch.length = l;
      patch.nominal_area = width * part_.metres_per_u * l;
      patch.area = body_ == Body::wheel ? width * h[k] * l : patch.nominal_area;
      patch.position_S = X_SP.apply({0.0, y[k], h[k]});
      patch.normal_S = X_SP.rotation * normal_in_plane(body_, dzdx[k], dzdy[k]);
      patches.push_back(patch);
    }
    return patches;
  }

  const Surface& surface_;
  Body body_;
  FirstLook& part_;
  double longest_ = 0.0, step_ = 0.0;
  std::vector<double> raster_;
};

}  // namespace

FirstLook look(const Surface& surface, const ScannerSettings& settings, const Progress& progress) {
  FirstLook part = part_of(surface, settings);
  Look(surface, settings, part).run(progress);
  return part;
}

}  // namespace treadmark::scans::scanner
