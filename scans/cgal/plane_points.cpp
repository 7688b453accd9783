// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/plane_points.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel_sort.hpp"
#include "treadmark/scans/strays/point_checks.hpp"

namespace treadmark::scans {

namespace {

constexpr double kUnitsPerPeriod = 0x1p40;  // a wheel's circumference in steps of 3e-12 m
constexpr double kLargestWhole = 0x1p52;    // a period more than this is still exact

}  // namespace

void throw_on_a_line(const char* what) {
  throw Error(ErrorKind::input_data, std::string(what) + ": all points lie on a line", {},
              "check the direction along which the points are projected");
}

PlanePoints plane_points(std::span<const Vec2> points, double period, const char* what) {
  if (!(period >= 0.0) || !std::isfinite(period))
    throw Error(ErrorKind::configuration, std::string(what) + ": the period must be positive, or 0 for none");
  check_points(points, 3, what);

  struct Item {
    double x, y;
    std::uint32_t input;
  };
  PlanePoints result;
  result.unit = period > 0.0 ? period / kUnitsPerPeriod : 1.0;
  result.period = period > 0.0 ? kUnitsPerPeriod : 0.0;
  std::vector<Item> items(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    double x = points[i].x(), y = points[i].y();
    if (period > 0.0) {
      x = std::nearbyint(x / result.unit);
      y = std::nearbyint(y / result.unit);
      if (std::abs(x) > kLargestWhole || std::abs(y) > kLargestWhole)
        throw Error(ErrorKind::input_data,
                    std::string(what) + ": point " + std::to_string(i) + " is more than 4096 periods away");
      x -= std::floor(x / kUnitsPerPeriod) * kUnitsPerPeriod;
    }
    items[i] = {x + 0.0, y + 0.0, static_cast<std::uint32_t>(i)};  // + 0.0: no negative zeros
  }
  parallel_sort(items, [](const Item& a, const Item& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.input < b.input;
  });
  items.erase(
      std::unique(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.x == b.x && a.y == b.y; }),
      items.end());
  if (items.size() < 3) throw_on_a_line(what);
  const auto same_y = [&](const Item& item) { return item.y == items.front().y; };
  if (items.front().x == items.back().x || std::all_of(items.begin(), items.end(), same_y)) throw_on_a_line(what);
  result.at.reserve(items.size());
  result.input.reserve(items.size());
  for (const Item& item : items) {
    result.at.emplace_back(item.x, item.y);
    result.input.push_back(item.input);
  }
  return result;
}

}  // namespace treadmark::scans
