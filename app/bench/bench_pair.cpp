// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/bench_pair.hpp"

#include "treadmark/app/bench/check_surface.hpp"
#include "treadmark/app/bench/machine.hpp"
#include "treadmark/backends/conformance/promises.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/undeformed_distance.hpp"

namespace treadmark::app {
namespace {

struct Stopped {};

class PairBench {
 public:
  PairBench(const BenchScene& scene, const BenchPair& pair, double seconds, const BenchStep& step)
      : scene_(scene), pair_(pair), bodies_(scene.bodies), seconds_(seconds), step_(step) {
    bodies_.rail = pair.rail.get();
    bodies_.wheel = pair.wheel.get();
  }

  std::array<BenchRow, 2> rows() {
    std::array<BenchRow, 2> rows{body_row(Body::rail), body_row(Body::wheel)};
    if (rows[0].agrees && rows[1].agrees) detection(rows);
    return rows;
  }

 private:
  void next(const std::string& what) {
    if (!step_(what)) throw Stopped{};
  }

  double timed(const std::string& what, const std::function<void()>& call) {
    next(what);
    return median_time(call, seconds_);
  }

  /// Of names that are in no list: not.
  bool one_place() const {
    const auto all = backends();
    return ranges::any_of(all, [&](const Backend* b) { return b->name == pair_.backend && b->one_place; });
  }

  BenchRow body_row(Body body) {
    const bool rail = body == Body::rail;
    const std::string word = rail ? "rail" : "wheel";
    const Surface& surface = rail ? *pair_.rail : *pair_.wheel;
    const BenchView& view = scene_.view(body);
    BenchRow row;
    row.backend = pair_.backend;
    row.resolution = pair_.resolution;
    row.body = body;
    row.memory_bytes = surface.memory_bytes();
    row.points = view.grid.size();
    next(word + ", agreement");
    const SurfaceAgreement agreement = check_surface(surface, view, pair_.resolution, one_place());
    row.difference = agreement.difference;
    row.reason = agreement.reason;
    if (row.reason.empty()) {
      conformance::Subject subject = conformance::look_at(rail ? pair_.rail : pair_.wheel, 0.0, pair_.backend);
      subject.planes = {view.level.X_SP, view.tilted.X_SP};
      row.reason = conformance::broken_promise(subject);
    }
    row.agrees = row.reason.empty();
    if (!row.agrees) return row;

    row.build = rail ? pair_.rail_build_seconds : pair_.wheel_build_seconds;
    std::vector<double> z(row.points), dzdx(row.points), dzdy(row.points);
    const double points = static_cast<double>(row.points);
    const auto heights = [&](const std::string& what, const Surface& s, const BenchView::Plane& plane, bool slopes) {
      const PlaneGrid grid{plane.X_SP, view.grid};
      return timed(word + ", " + what,
                   [&] {
                     if (slopes)
                       s.heights(grid, {z, dzdx, dzdy});
                     else
                       s.heights(grid, {z, {}, {}});
                   }) /
             points;
    };
    row.height = heights("heights", surface, view.level, false);
    row.height_tilted = heights("tilted heights", surface, view.tilted, false);
    row.normal = heights("normals", surface, view.tilted, true);
    const Surface* base = scene_.base(body);
    if (pair_.over_base && base != nullptr) row.base_height = heights("base", *base, view.level, false);
    return row;
  }

  void detection(std::array<BenchRow, 2>& rows) {
    next("agreement of the search");
    int patches = -1;
    std::string reason = check_search(bodies_, scene_.search, &patches);
    if (reason.empty()) reason = check_distance(bodies_, scene_.X_TC, scene_.contact_grid);
    if (!reason.empty()) {
      for (BenchRow& row : rows) withdraw(row, reason);
      return;
    }
    const double cold = timed("search", [&] { detection::ContactSearch(bodies_, scene_.search).at(0.0); });
    detection::ContactSearch search(bodies_, scene_.search);
    search.at(0.0);
    bool further = false;  // never twice the same position
    const double warm =
        timed("search after a small move", [&] { search.at((further = !further) ? kWarmStep : 2.0 * kWarmStep); });
    const double distance = timed("undeformed distance",
                                  [&] { detection::undeformed_distance(bodies_, scene_.X_TC, scene_.contact_grid); });
    for (BenchRow& row : rows) {
      row.search_cold = cold;
      row.search_warm = warm;
      row.distance = distance;
      row.patches = patches;
    }
  }

  static void withdraw(BenchRow& row, const std::string& reason) {
    row.agrees = false;
    row.reason = reason;
    row.build = row.height = row.height_tilted = row.normal = row.base_height = BenchRow::kNone;
  }

  const BenchScene& scene_;
  const BenchPair& pair_;
  detection::BodyPair bodies_;
  double seconds_;
  const BenchStep& step_;
};

}  // namespace

std::optional<std::array<BenchRow, 2>> measure_pair(const BenchScene& scene, const BenchPair& pair,
                                                    double seconds_per_measure, const BenchStep& step) {
  try {
    return PairBench(scene, pair, seconds_per_measure, step).rows();
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

}  // namespace treadmark::app
