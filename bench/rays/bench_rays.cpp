// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Who finds fastest which of many triangles a line meets first: our own rasteriser, which takes grids alone, our own
// tree, or Embree. The triangles and lines are the same, and nothing is timed before the heights are.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/bench_scene.hpp"
#include "treadmark/app/bench/machine.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/backends/mesh/grid_heights.hpp"
#include "treadmark/backends/mesh/line_caster.hpp"
#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/backends/mesh/ray_scene.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/parallel.hpp"

namespace {

using namespace treadmark;

constexpr const char* kUsage =
    "usage: bench_rays [--short] [--into FILE]\n"
    "       --short       few lines and triangles, for tests\n"
    "       --into FILE   writes the table between the marks in this file, too\n";
constexpr std::string_view kBegin = "<!-- bench_rays -->\n", kEnd = "<!-- end of bench_rays -->";

struct RaysOptions {
  bool brief = false;
  std::string into;
};

/// Triangles of a body, with what finds them.
class Contest {
 public:
  Contest(const TriangleMesh& triangles, Body body)
      : facing_(body == Body::wheel ? Facing::down : Facing::up),
        mesh_(mesh::prepare(triangles, body, repair_)),
        bvh_(mesh_),
        scene_(mesh::ray_scene(mesh_)) {}

  const mesh::PreparedMesh& prepared() const { return mesh_; }
  const mesh::Bvh& tree() const { return bvh_; }
  const mesh::RayScene* embree() const { return scene_.get(); }
  Facing facing() const { return facing_; }

  void rasterise(const Pose& X_SP, const Grid2& grid, std::vector<double>& z) const {
    const HeightsOut out{z, {}, {}};
    mesh::grid_heights(mesh_, bvh_, nullptr, {mesh_, X_SP, facing_}, grid, mesh::Results(out));
  }

  /// Parallel lines; scene: null for our own tree.
  void cast(const mesh::RayScene* scene, const Pose& X_SP, std::span<const Vec2> points, std::span<double> z) const {
    constexpr std::size_t kPacket = mesh::LineCaster::kPacket;
    mesh::LineCaster caster(mesh_, bvh_, scene, {mesh_, X_SP, facing_});
    std::array<Vec2, kPacket> packet;
    std::array<mesh::LineHit, kPacket> hits;
    for (std::size_t i = 0; i < points.size(); i += kPacket) {
      const std::size_t count = std::min(kPacket, points.size() - i);
      std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(i), count, packet.begin());
      caster.cast(packet, count, hits);
      for (std::size_t k = 0; k < count; ++k) z[i + k] = hits[k].cover == mesh::Cover::front ? hits[k].z : kNaN;
    }
  }

  /// Lines that each have a plane of their own.
  void cast(const mesh::RayScene* scene, std::span<const Pose> planes, std::span<double> z) const {
    const Vec2 here(0.0, 0.0);
    for (std::size_t i = 0; i < planes.size(); ++i) cast(scene, planes[i], {&here, 1}, z.subspan(i, 1));
  }

 private:
  Facing facing_;
  mesh::MeshRepair repair_;
  mesh::PreparedMesh mesh_;
  mesh::Bvh bvh_;
  std::unique_ptr<const mesh::RayScene> scene_;
};

std::vector<Vec2> points_of(const Grid2& g) {
  std::vector<Vec2> points;
  points.reserve(g.size());
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) points.emplace_back(g.x(ix), g.y(iy));
  return points;
}

/// Planes along the beams from a place to what the lines of another plane meet.
std::vector<Pose> beams(const Contest& contest, const Pose& X_SP, std::span<const Vec2> points) {
  constexpr double kUp = 0.3, kAside = 0.2;  // [m]
  const double out = contest.facing() == Facing::down ? 1.0 : -1.0;
  const Vec3 place = X_SP.apply({0.1 * kUp, kAside, out * kUp});
  std::vector<double> z(points.size());
  contest.cast(nullptr, X_SP, points, z);
  std::vector<Pose> planes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isnan(z[i])) continue;
    Pose X;
    X.origin = X_SP.apply({points[i].x(), points[i].y(), z[i]});
    const Vec3 z_axis = out * (place - X.origin).normalized(), x_axis = z_axis.unitOrthogonal();
    X.rotation << x_axis, z_axis.cross(x_axis), z_axis;
    planes.push_back(X);
  }
  return planes;
}

/// A row of the table: the same numbers by the three ways.
struct RaysRow {
  std::string what;
  double raster = kNaN, tree = kNaN, embree = kNaN;
};

std::string cell(double number) {
  return std::isnan(number) ? "-" : number < 100.0 ? fmt::format("{:.1f}", number) : fmt::format("{:.0f}", number);
}

/// The share of heights in which two answers differ.
double differing(std::span<const double> a, std::span<const double> b) {
  constexpr double kSame = 1e-9;  // [m]: another triangle is farther off, but for its neighbours at their edge
  std::size_t other = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    other += !(std::fabs(a[i] - b[i]) <= kSame) && !(std::isnan(a[i]) && std::isnan(b[i])) ? 1 : 0;
  return static_cast<double>(other) / static_cast<double>(a.size());
}

using Way = std::function<void(std::vector<double>&)>;

/// Times ways that have been found to agree: nanoseconds a line. raster: empty where it cannot.
RaysRow raced(const std::string& what, std::size_t lines, double seconds, const Way& raster, const Way& tree,
              const Way& embree) {
  constexpr double kFolds = 1e-4;  // lines that graze a fold, which single precision may place on its other side
  std::vector<double> expected(lines), found(lines);
  tree(expected);
  if (std::all_of(expected.begin(), expected.end(), [](double z) { return std::isnan(z); }))
    throw std::runtime_error(what + ": no line meets anything");
  RaysRow row{fmt::format("{}, {} lines: ns a line", what, lines)};
  const auto measure = [&](const char* name, const Way& way, double allowed) {
    if (!way) return kNaN;
    way(found);
    if (const double share = differing(found, expected); share > allowed)
      throw std::runtime_error(
          fmt::format("{}: {} differs from our own tree in {:.2g} % of the lines", what, name, 1e2 * share));
    return 1e9 * app::median_time([&] { way(found); }, seconds) / static_cast<double>(lines);
  };
  row.raster = measure("the rasteriser", raster, 0.0);
  row.tree = measure("our own tree", tree, 0.0);
  row.embree = measure("Embree", embree, kFolds);
  return row;
}

void race(const Contest& contest, const app::BenchView& view, double seconds, std::vector<RaysRow>& rows) {
  const std::vector<Vec2> grid = points_of(view.grid);
  const auto parallel = [&](const mesh::RayScene* scene, const Pose& X_SP, const std::vector<Vec2>& points) -> Way {
    return [&contest, scene, X_SP, &points](std::vector<double>& z) { contest.cast(scene, X_SP, points, z); };
  };
  const auto by_embree = [&](const Way& way) { return contest.embree() != nullptr ? way : Way(); };
  for (const auto& [name, X_SP] :
       {std::pair{"grid, level", view.level.X_SP}, std::pair{"grid, tilted", view.tilted.X_SP}}) {
    const Way raster = [&contest, &view, X = X_SP](std::vector<double>& z) { contest.rasterise(X, view.grid, z); };
    rows.push_back(raced(name, grid.size(), seconds, raster, parallel(nullptr, X_SP, grid),
                         by_embree(parallel(contest.embree(), X_SP, grid))));
  }
  std::vector<Vec2> scattered = grid;
  std::shuffle(scattered.begin(), scattered.end(), std::mt19937(7));
  scattered.resize(scattered.size() / 4);
  const Pose& tilted = view.tilted.X_SP;
  rows.push_back(raced("scattered, tilted", scattered.size(), seconds, {}, parallel(nullptr, tilted, scattered),
                       by_embree(parallel(contest.embree(), tilted, scattered))));
  const std::vector<Pose> planes = beams(contest, tilted, scattered);
  const auto along_beams = [&](const mesh::RayScene* scene) -> Way {
    return [&contest, &planes, scene](std::vector<double>& z) { contest.cast(scene, planes, z); };
  };
  rows.push_back(raced("beams from a place", planes.size(), seconds, {}, along_beams(nullptr),
                       by_embree(along_beams(contest.embree()))));
}

/// What it costs to have a tree of either kind.
void weigh(const Contest& contest, std::vector<RaysRow>& rows) {
  const double triangles = static_cast<double>(contest.prepared().triangles.size());
  RaysRow time{"building: ns a triangle"}, memory{"memory: bytes a triangle"};
  const auto build_tree = [&] {
    mesh::PreparedMesh again = contest.prepared();
    const mesh::Bvh tree(again);
  };
  time.tree = 1e9 * app::median_time(build_tree, 0.0) / triangles;
  memory.tree = static_cast<double>(contest.tree().memory_bytes()) / triangles;
  if (contest.embree() != nullptr) {
    time.embree = 1e9 * app::median_time([&] { mesh::ray_scene(contest.prepared()); }, 0.0) / triangles;
    memory.embree = static_cast<double>(contest.embree()->memory_bytes()) / triangles;
  }
  rows.insert(rows.end(), {time, memory});
}

std::string table_of(const RaysOptions& options) {
  const double seconds = options.brief ? 1e-3 : 0.3;
  const app::BenchScene scene = app::make_bench_scene(
      app::bench_case(), options.brief ? app::BenchGrid{0.5e-3, 6000} : app::BenchGrid{0.2e-3, 40000});
  std::string text = fmt::format(
      "`bench_rays`, {}, {}, {}, one thread:\n\n| triangles | lines | rasteriser | own tree "
      "| Embree |\n|---|---|--:|--:|--:|\n",
      app::date_now().substr(0, 10), app::machine_name(), app::compiler_name());
  for (const Body body : {Body::rail, Body::wheel})
    for (const double mm : options.brief ? std::vector{2.0} : std::vector{1.0, 0.5}) {
      const Region& region = body == Body::rail ? scene.regions.rail : scene.regions.wheel;
      const Contest contest(to_triangles(scene.natural(body), {"", 1e-3 * mm, region}), body);
      std::vector<RaysRow> rows;
      race(contest, scene.view(body), seconds, rows);
      weigh(contest, rows);
      const std::string triangles = fmt::format("{}, {:g} mm, {}", body == Body::rail ? "rail" : "wheel", mm,
                                                contest.prepared().triangles.size());
      for (const RaysRow& row : rows)
        text += fmt::format("| {} | {} | {} | {} | {} |\n", triangles, row.what, cell(row.raster), cell(row.tree),
                            cell(row.embree));
    }
  return text;
}

void write_into(const std::string& file, const std::string& table) {
  std::ostringstream held;
  held << std::ifstream(file).rdbuf();
  std::string text = held.str();
  const std::size_t begin = text.find(kBegin), end = text.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin + kBegin.size())
    throw std::runtime_error(fmt::format("{} has no place for the table: '{}' and '{}'", file, kBegin, kEnd));
  text.replace(begin + kBegin.size(), end - begin - kBegin.size(), '\n' + table + '\n');
  std::ofstream out(file);
  if (!(out << text).flush()) throw std::runtime_error("cannot write " + file);
}

}  // namespace

int main(int argc, char** argv) {
  RaysOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--short") {
      options.brief = true;
    } else if (word == "--into" && i + 1 < argc) {
      options.into = argv[++i];
    } else {
      return std::fputs(kUsage, stderr), 2;
    }
  }
  try {
    const ThreadLimit one(1);
    const std::string table = table_of(options);
    std::fputs(table.c_str(), stdout);
    if (!options.into.empty()) write_into(options.into, table);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_rays: %s\n", e.what());
    return 1;
  }
}
