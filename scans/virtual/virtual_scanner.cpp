// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/virtual/virtual_scanner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/virtual/check_settings.hpp"
#include "treadmark/scans/virtual/draws.hpp"
#include "treadmark/scans/virtual/first_look.hpp"
#include "treadmark/scans/virtual/holes.hpp"
#include "treadmark/scans/virtual/scan_line.hpp"
#include "treadmark/scans/virtual/scan_pass.hpp"

namespace treadmark::scans {
namespace {

using namespace scanner;

constexpr std::size_t kBlock = 256;  // lines between two looks at the clock and the request to stop
constexpr double kPiece = 0.5;       // of the step: in such pieces the length of a line is measured
constexpr double kFarthest = 1.0;    // [m] of a random frame

Pose random_pose(std::uint64_t seed) {
  Draws draws(seed, Purpose::frame);
  // four normal numbers point anywhere in space with the same chance
  const Vec3 v = draws.gaussian3();
  const double w = draws.gaussian();
  Pose X;
  X.rotation = Eigen::Quaterniond(w, v.x(), v.y(), v.z()).normalized().toRotationMatrix();
  do {
    const double x = draws.uniform(-1.0, 1.0), y = draws.uniform(-1.0, 1.0), z = draws.uniform(-1.0, 1.0);
    X.origin = kFarthest * Vec3(x, y, z);
  } while (X.origin.norm() > kFarthest);
  return X;
}

/// How the lines of all passes lie.
struct Plan {
  double spacing = 0.0, step = 0.0;  ///< wanted on the surface; along the lines [m]
  std::vector<std::size_t> lines;    ///< of each pass
  double points = 0.0;
  std::size_t total_lines = 0;
};

Plan plan_lines(const FirstLook& part, const std::vector<Pass>& passes, const ScannerSettings& settings) {
  double area = 0.0, scanned = 0.0;
  for (const Pass& pass : passes) area += pass.area;
  if (!(area > 0.0)) throw Error(ErrorKind::configuration, "there is no surface in the range to be scanned");
  Plan plan;
  plan.spacing = settings.spacing > 0.0 ? settings.spacing : std::sqrt(area / static_cast<double>(settings.points));
  plan.points = settings.spacing > 0.0 ? area / (plan.spacing * plan.spacing) : static_cast<double>(settings.points);
  if (plan.points > kMostPoints)
    throw Error(ErrorKind::configuration, "a virtual scan has 200 million points at most", {},
                "ask for a wider spacing or a smaller part");
  for (const Pass& pass : passes) {
    const double width = (pass.u_max - pass.u_min) * part.metres_per_u;
    plan.lines.push_back(std::max<std::size_t>(1, to_whole<std::size_t>(std::round(width / plan.spacing))));
    plan.total_lines += plan.lines.back();
    scanned += static_cast<double>(plan.lines.back()) * pass.nominal_area / width;
  }
  plan.step = scanned / plan.points;
  return plan;
}

class Scan {
 public:
  Scan(const Surface& surface, const ScannerSettings& settings, const Progress& progress)
      : surface_(surface),
        settings_(settings),
        progress_(progress),
        part_(look(surface, settings, progress)),
        passes_(plan_passes(part_, settings)),
        plan_(plan_lines(part_, passes_, settings)) {
    if (settings.holes > 0.0) holes_ = Holes(part_, settings.body, settings.holes, settings.hole_size, settings.seed);
    around_ = surroundings(part_, settings.seed);
    part_.patches = {};  // their room is needed for the cloud
  }

  VirtualScan run() {
    ScannerTruth& truth = scan_.truth;
    truth.X_CS = settings_.random_frame ? random_pose(settings_.seed) : settings_.X_CS;
    truth.spacing = plan_.spacing;
    truth.area = part_.area;
    scan_.cloud.name = "virtual scan";
    // counts differ by what the ends of lines add; what is lost needs no room
    const double left = plan_.points * (1.0 - settings_.holes) * (1.0 - settings_.drop_outs);
    const auto room = to_whole<std::size_t>(1.01 * left) + 1000;
    scan_.cloud.points.reserve(room);
    if (passes_.size() > 1) scan_.cloud.passes.reserve(room);
    for (std::size_t i = 0; i < passes_.size(); ++i) run_pass(i);
    if (scan_.cloud.points.empty())
      throw Error(ErrorKind::configuration, "not one point is left of the scan", {},
                  "ask for more points or lose fewer");
    return std::move(scan_);
  }

 private:
  void run_pass(std::size_t i) {
    const Pass& pass = passes_[i];
    ScannerTruth& truth = scan_.truth;
    truth.X_pass.push_back(truth.X_CS * pass.error_S * truth.X_CS.inverse());
    truth.passes.push_back(
        {pass.u_min, pass.u_max, pass.y_min, pass.y_max, truth.X_CS.apply(pass.middle_S), plan_.lines[i], 0});

    const double longest = kPiece * plan_.step;
    const std::vector<double> looked_at =
        raster(surface_, settings_.body, part_.spread, pass.y_min, pass.y_max, longest);
    LineJob job{surface_,   settings_, holes_,  around_, pass, i, truth.X_CS * pass.error_S,
                plan_.step, looked_at, longest, nullptr};
    const std::size_t lines = plan_.lines[i];
    Draws draws(settings_.seed, Purpose::positions, i, lines);
    const double distance = (pass.u_max - pass.u_min) / static_cast<double>(lines),
                 first = pass.u_min + draws.uniform() * distance;
    Station common;
    if (surface_.constant_profile()) {
      common = Station(surface_, settings_.body, first, looked_at, longest);
      job.common = &common;
    }
    const std::size_t before = scan_.cloud.points.size();
    std::vector<Line> block;
    for (std::size_t begin = 0; begin < lines; begin += kBlock) {
      if (progress_.stop_requested()) throw Error(ErrorKind::numerical, "the scan was stopped");
      block.assign(std::min(kBlock, lines - begin), {});
      parallel_for(block.size(), [&](std::size_t k) {
        block[k] = scan_line(job, begin + k, first + distance * static_cast<double>(begin + k));
      });
      for (const Line& line : block) keep(line, i);
      lines_done_ += block.size();
      if (progress_.report) progress_.report(lines_done_, plan_.total_lines, "lines");
    }
    truth.passes.back().points = scan_.cloud.points.size() - before;
  }

  void keep(const Line& line, std::size_t pass) {
    PointCloud& cloud = scan_.cloud;
    cloud.points.insert(cloud.points.end(), line.points_C.begin(), line.points_C.end());
    if (passes_.size() > 1) cloud.passes.resize(cloud.points.size(), static_cast<std::uint16_t>(pass));
    ScannerTruth& truth = scan_.truth;
    truth.on_surface += line.on_surface;
    truth.outliers += line.outliers;
    truth.lost_holes += line.lost_holes;
    truth.lost_drop_outs += line.lost_drop_outs;
    truth.lost_occlusion += line.lost_occlusion;
    truth.lost_shadow += line.lost_shadow;
  }

  const Surface& surface_;
  const ScannerSettings& settings_;
  const Progress& progress_;
  FirstLook part_;
  std::vector<Pass> passes_;
  Plan plan_;
  Holes holes_;
  Surroundings around_;
  VirtualScan scan_;
  std::size_t lines_done_ = 0;
};

}  // namespace

VirtualScan scan_surface(const Surface& surface, const ScannerSettings& settings, const Progress& progress) {
  check_settings(settings);
  return Scan(surface, settings, progress).run();
}

}  // namespace treadmark::scans
