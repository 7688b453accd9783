// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/stability/response_run.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::app {
namespace {

using vehicle::Eigenmode;
using vehicle::Multibody;

constexpr std::size_t kMostDrawn = 16;
constexpr double kMostDamped = 0.7;  // of what is drawn
constexpr double kShown = 0.4;       // largest displacement in a picture [m]

/// Points of a body: its centre and where springs and dampers hold it; of a wheelset its tape circles.
std::vector<Vec3> points_of(const Multibody& system, std::size_t body) {
  std::vector<Vec3> points;
  for (const Multibody::Link& link : system.links)
    for (const int end : {link.a, link.b})
      if (end == static_cast<int>(body) && std::find(points.begin(), points.end(), link.point) == points.end())
        points.push_back(link.point);
  const Multibody::Body& b = system.bodies[body];
  if (b.wheelset >= 0)
    for (const double side : {-1.0, 1.0}) points.emplace_back(b.position + Vec3(0.0, side * vehicle::kHalfGauge, 0.0));
  return points;
}

/// Of a point of a body in a mode; what turns with a wheelset is not seen.
Eigen::Vector3cd moved(const Multibody::Body& body, const Eigenmode& mode, const Vec3& point) {
  const auto of = [&](Freedom f) -> std::complex<double> {
    const int c = body.coordinate[static_cast<std::size_t>(f)];
    return c < 0 || (f == Freedom::pitch && body.wheelset >= 0) ? 0.0 : mode.shape[c];
  };
  const Vec3 arm = point - body.position;
  const std::complex<double> roll = of(Freedom::roll), pitch = of(Freedom::pitch), yaw = of(Freedom::yaw);
  return {of(Freedom::x) + pitch * arm.z() - yaw * arm.y(), of(Freedom::y) + yaw * arm.x() - roll * arm.z(),
          of(Freedom::z) + roll * arm.y() - pitch * arm.x()};
}

/// Bodies as stars about their centres, in two directions of space. size: of the largest displacement [m]; 0: at rest.
/// phase [rad]
pictures::Curve drawn(const Multibody& system, const Eigenmode& mode, double size, double phase, int across) {
  pictures::Curve curve;
  const std::complex<double> turn = size * std::exp(std::complex<double>(0.0, phase));
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Multibody::Body& body = system.bodies[b];
    const auto add = [&](const Vec3& point) {
      const Vec3 at = point + Vec3((turn * moved(body, mode, point)).real());
      curve.push_back({at.x(), at[across]});
    };
    add(body.position);
    for (const Vec3& point : points_of(system, b)) {
      add(point);
      add(body.position);
    }
    curve.push_back({kNaN, kNaN});  // a line for each
  }
  return curve;
}

pictures::ChartSeries series_of(pictures::Curve curve, std::string name, std::string colour, std::string dashes) {
  pictures::ChartSeries series;
  series.curve = std::move(curve);
  series.name = std::move(name);
  series.colour = std::move(colour);
  series.dashes = std::move(dashes);
  return series;
}

}  // namespace

std::string modes_svg(const ResponseRun& run) {
  const Multibody& system = run.system;
  pictures::ChartSheet sheet;
  for (const Eigenmode& mode : run.modes) {
    if (!(mode.damping_ratio < kMostDamped) || sheet.charts.size() == 2 * kMostDrawn) continue;
    double most = 0.0;
    for (std::size_t b = 0; b < system.bodies.size(); ++b)
      for (const Vec3& point : points_of(system, b)) most = std::max(most, moved(system.bodies[b], mode, point).norm());
    constexpr double kLeast = 1e-6;  // [m]; less moves only the track
    if (!(most > kLeast)) continue;
    for (const int across : {2, 1}) {
      pictures::Chart chart;
      const bool side = across == 2;
      chart.title = side ? fmt::format("{:.3g} Hz, damping {:.3g}: {}", mode.frequency, mode.damping_ratio,
                                       vehicle::describe(mode, system, 2))
                         : "from above";
      chart.x_label = "x [m]";
      chart.y_label = side ? "z [m]" : "y [m]";
      chart.y_down = true;
      const double size = kShown / most;
      chart.series = {series_of(drawn(system, mode, 0.0, 0.0, across), "at rest", "#bbbbbb", ""),
                      series_of(drawn(system, mode, size, 0.0, across), "moved", "#1f77b4", ""),
                      series_of(drawn(system, mode, size, 0.5 * kPi, across), "a quarter later", "#d62728", "4 3")};
      sheet.charts.push_back(std::move(chart));
    }
  }
  if (sheet.charts.empty()) return {};
  sheet.title = fmt::format("{}, {:g} m/s: vibrations up to {:g} Hz", run.title, run.speed, run.request.to);
  sheet.columns = 2;
  sheet.width = 420.0;
  sheet.height = 130.0;
  sheet.gap_x = 80.0;
  sheet.gap_y = 62.0;
  sheet.top = 58.0;
  sheet.legend = pictures::ChartSheet::Legend::common;
  sheet.series = sheet.charts.front().series;
  sheet.legend_width = 130.0;
  sheet.remarks.push_back(
      fmt::format("displacements are drawn larger than they are, the largest as {:g} m; left from the side", kShown));
  return pictures::draw_sheet(sheet);
}

}  // namespace treadmark::app
