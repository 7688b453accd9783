// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/strays/neighbours.hpp"

#include <algorithm>
#include <nanoflann.hpp>
#include <vector>

#include "treadmark/core/parallel_blocks.hpp"

namespace treadmark::scans {

namespace {

/// The points as nanoflann asks for them.
struct Searched {
  std::span<const Vec3> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // none is known
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Searched>, Searched, 3, std::uint32_t>;

constexpr std::size_t kPoints = 2048;  // of a task

}  // namespace

void for_each_neighbourhood(std::span<const Vec3> points, int count,
                            const std::function<void(std::uint32_t, std::span<const Neighbour>)>& visit) {
  const Searched searched{points};
  const Tree tree(3, searched);
  // One more than wanted: the point itself is among them, or, of many equal points, others in its place.
  const std::size_t wanted = static_cast<std::size_t>(count) + 1;
  parallel_blocks(points.size(), kPoints, [&](std::size_t from, std::size_t to) {
    std::vector<std::uint32_t> index(wanted);
    std::vector<double> squared(wanted);
    std::vector<Neighbour> found;
    for (std::size_t i = from; i < to; ++i) {
      const auto self = static_cast<std::uint32_t>(i);
      found.clear();
      const std::size_t size = tree.knnSearch(points[i].data(), wanted, index.data(), squared.data());
      for (std::size_t k = 0; k < size; ++k)
        if (index[k] != self) found.push_back({index[k], squared[k]});
      std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
        return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance : a.index < b.index;
      });
      if (found.size() > static_cast<std::size_t>(count)) found.resize(static_cast<std::size_t>(count));
      visit(self, found);
    }
  });
}

}  // namespace treadmark::scans
