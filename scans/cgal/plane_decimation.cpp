// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/cgal/plane_points.hpp"
#include "treadmark/scans/cgal/plane_triangulation.hpp"

namespace treadmark::scans {

namespace {

constexpr const char* kWhat = "decimation of points in a plane";
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct VertexInfo {
  std::uint32_t rank = 0;
  int shift = 0;  // periods
};
/// The points that are not inserted and lie in the face, as a linked list, and when they were last judged.
struct FaceInfo {
  std::uint32_t first = kNone;
  std::uint64_t stamp = 0;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Face = Delaunay::Face_handle;
using Vertex = Delaunay::Vertex_handle;

/// Greedy insertion (Garland and Heckbert 1995): every point that is not yet inserted is kept with the triangle it lies
/// in, every triangle with its worst point, and only the triangles round a new vertex are judged again. On a cylinder
/// the vertices are inserted three times, one period apart, and the points to judge lie in the middle.
class GreedyInsertion {
 public:
  GreedyInsertion(const PlanePoints& points, std::span<const double> heights)
      : period_(points.period),
        chosen_(points.at.size(), false),
        next_(points.at.size(), kNone),
        copies_(points.at.size()) {
    for (std::size_t rank = 0; rank < points.at.size(); ++rank) {
      at_.emplace_back(points.at[rank].x(), points.at[rank].y());
      height_.push_back(heights[points.input[rank]]);
    }
    for (const std::uint32_t rank : seeds()) choose(rank, Face());
    if (delaunay_.dimension() < 2) throw_on_a_line(kWhat);
    distribute_all();
  }

  void run(double tolerance) {
    while (!worst_.empty() && worst_.top().error > tolerance) {
      const Entry entry = worst_.top();
      worst_.pop();
      if (entry.face->info().stamp == entry.stamp) choose(entry.rank, entry.face);
    }
  }

  const std::vector<bool>& chosen() const { return chosen_; }

 private:
  struct Entry {
    double error;
    std::uint32_t rank;
    Face face;
    std::uint64_t stamp;
    bool operator<(const Entry& other) const { return error != other.error ? error < other.error : rank > other.rank; }
  };

  Kernel::Point_2 moved(std::uint32_t rank, int shift) const {
    return {at_[rank].x() + shift * period_, at_[rank].y()};
  }

  /// Points whose triangulation covers all others: the corners of the convex hull (of three copies, on a cylinder). On
  /// a cylinder also the rims, sector by sector, so that no triangle reaches far round it.
  std::vector<std::uint32_t> seeds() const {
    std::vector<VertexInfo> order;
    for (int shift = period_ > 0.0 ? -1 : 0; shift <= (period_ > 0.0 ? 1 : 0); ++shift)
      for (std::uint32_t rank = 0; rank < at_.size(); ++rank) order.push_back({rank, shift});
    std::vector<bool> seed(at_.size(), false);
    for (const CGAL::Orientation outside :
         {CGAL::RIGHT_TURN, CGAL::LEFT_TURN}) {  // lower and upper chain (Andrew 1979)
      std::vector<VertexInfo> chain;
      for (const VertexInfo& v : order) {
        const auto turns_outside = [&] {
          const VertexInfo &a = chain[chain.size() - 2], &b = chain.back();
          const auto turn = CGAL::orientation(moved(a.rank, a.shift), moved(b.rank, b.shift), moved(v.rank, v.shift));
          return turn == outside || turn == CGAL::COLLINEAR;
        };
        while (chain.size() >= 2 && turns_outside()) chain.pop_back();
        chain.push_back(v);
      }
      for (const VertexInfo& v : chain) seed[v.rank] = true;
    }
    if (period_ > 0.0) {
      constexpr int kSectors = 12;
      std::array<std::uint32_t, kSectors> low, high;
      low.fill(kNone);
      high.fill(kNone);
      for (std::uint32_t rank = 0; rank < at_.size(); ++rank) {
        const auto sector = to_whole<std::size_t>(at_[rank].x() / period_ * kSectors);
        if (low[sector] == kNone || at_[rank].y() < at_[low[sector]].y()) low[sector] = rank;
        if (high[sector] == kNone || at_[rank].y() > at_[high[sector]].y()) high[sector] = rank;
      }
      for (std::size_t s = 0; s < kSectors; ++s)
        if (low[s] != kNone) seed[low[s]] = seed[high[s]] = true;
    }
    std::vector<std::uint32_t> ranks;
    for (std::uint32_t rank = 0; rank < at_.size(); ++rank)
      if (seed[rank]) ranks.push_back(rank);
    return ranks;
  }

  /// Inserts a point and its copies. face: where it lies, or none.
  void choose(std::uint32_t rank, Face face) {
    chosen_[rank] = true;
    const VertexInfo near =
        face == Face() || delaunay_.is_infinite(face->vertex(0)) ? VertexInfo{kNone, 0} : face->vertex(0)->info();
    insert(rank, 0, face);
    if (!(period_ > 0.0)) return;
    for (const int shift : {-1, 1}) {
      const int twin = near.shift + shift;
      const bool known = near.rank != kNone && std::abs(twin) <= 1;
      insert(rank, shift, known ? copies_[near.rank][static_cast<std::size_t>(twin + 1)]->face() : Face());
    }
  }

  void insert(std::uint32_t rank, int shift, Face start) {
    const Vertex v = delaunay_.insert(moved(rank, shift), start);
    v->info() = {rank, shift};
    copies_[rank][static_cast<std::size_t>(shift + 1)] = v;
    if (delaunay_.dimension() < 2) return;

    // All triangles that changed meet at the new vertex. Insertion splits and flips them in place, so together they
    // still hold the points of before.
    star_.clear();
    moving_.clear();
    auto f = delaunay_.incident_faces(v);
    const auto end = f;
    do {
      for (std::uint32_t p = f->info().first; p != kNone; p = next_[p])
        if (p != rank) moving_.push_back(p);
      f->info() = {kNone, ++stamp_};
      if (!delaunay_.is_infinite(f)) star_.push_back(f);
    } while (++f != end);
    for (const std::uint32_t p : moving_) {
      std::size_t i = 0;  // the wedge round v that holds p: it lies in one of them, so the last one needs no test
      while (i + 1 < star_.size() && !in_wedge(star_[i], v, at_[p])) ++i;
      put(p, star_[i]);
    }
    if (!moving_.empty())
      for (const Face& face : star_) judge(face);
  }

  static bool in_wedge(const Face& face, const Vertex& v, const Kernel::Point_2& p) {
    const int i = face->index(v);
    return CGAL::orientation(v->point(), face->vertex(Delaunay::ccw(i))->point(), p) != CGAL::RIGHT_TURN &&
           CGAL::orientation(v->point(), face->vertex(Delaunay::cw(i))->point(), p) != CGAL::LEFT_TURN;
  }

  void put(std::uint32_t rank, const Face& face) {
    next_[rank] = face->info().first;
    face->info().first = rank;
  }

  void distribute_all() {
    Face hint;
    for (std::uint32_t rank = 0; rank < at_.size(); ++rank) {
      if (chosen_[rank]) continue;
      hint = delaunay_.locate(at_[rank], hint);
      if (delaunay_.is_infinite(hint)) hint = hint->neighbor(hint->index(delaunay_.infinite_vertex()));  // on the hull
      put(rank, hint);
    }
    for (auto f = delaunay_.finite_faces_begin(); f != delaunay_.finite_faces_end(); ++f) judge(f);
  }

  /// Finds the worst point of a face and queues it.
  void judge(const Face& face) {
    if (face->info().first == kNone) return;
    std::array<Vec2, 3> p;
    std::array<double, 3> h;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      p[k] = {face->vertex(i)->point().x(), face->vertex(i)->point().y()};
      h[k] = height_[face->vertex(i)->info().rank];
    }
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
    const Vec2 b = p[1] - p[0], c = p[2] - p[0];
    const double area = cross(b, c);
    Entry worst{-1.0, kNone, face, face->info().stamp};
    for (std::uint32_t rank = face->info().first; rank != kNone; rank = next_[rank]) {
      const Vec2 d = Vec2(at_[rank].x(), at_[rank].y()) - p[0];
      const double plane = h[0] + cross(d, c) / area * (h[1] - h[0]) + cross(b, d) / area * (h[2] - h[0]);
      double error = std::abs(height_[rank] - plane);
      if (!std::isfinite(error))
        error = std::numeric_limits<double>::infinity();  // too flat to interpolate in: split it
      if (error > worst.error || (error == worst.error && rank < worst.rank)) {
        worst.error = error;
        worst.rank = rank;
      }
    }
    worst_.push(worst);
  }

  double period_;
  std::vector<Kernel::Point_2> at_;  // these four by rank
  std::vector<double> height_;
  std::vector<bool> chosen_;
  std::vector<std::uint32_t> next_;
  std::vector<std::array<Vertex, 3>> copies_;
  Delaunay delaunay_;
  std::priority_queue<Entry> worst_;
  std::uint64_t stamp_ = 0;
  std::vector<Face> star_;  // scratch
  std::vector<std::uint32_t> moving_;
};

}  // namespace

std::vector<std::uint32_t> decimate_plane(std::span<const Vec2> points, std::span<const double> heights,
                                          double tolerance, double period) {
  if (!(tolerance > 0.0))
    throw Error(ErrorKind::configuration, std::string(kWhat) + ": the tolerance must be positive");
  const PlanePoints prepared = plane_points(points, period, kWhat);
  if (heights.size() != points.size())
    throw Error(ErrorKind::input_data, std::string(kWhat) + ": there must be one height a point");
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (!std::isfinite(heights[i]))
      throw Error(ErrorKind::input_data,
                  std::string(kWhat) + ": height " + std::to_string(i) + " is not a finite number");

  GreedyInsertion greedy(prepared, heights);
  greedy.run(tolerance);
  std::vector<std::uint32_t> kept;
  for (std::size_t rank = 0; rank < prepared.input.size(); ++rank)
    if (greedy.chosen()[rank]) kept.push_back(prepared.input[rank]);
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace treadmark::scans
