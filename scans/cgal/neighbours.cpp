// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/neighbours.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "treadmark/core/parallel.hpp"

namespace treadmark::scans {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Indexed = std::pair<Kernel::Point_3, std::uint32_t>;
using Traits =
    CGAL::Search_traits_adapter<Indexed, CGAL::First_of_pair_property_map<Indexed>, CGAL::Search_traits_3<Kernel>>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;

constexpr std::size_t kChunk = 2048;  // points a task

}  // namespace

void for_each_neighbourhood(std::span<const Vec3> points, int count,
                            const std::function<void(std::uint32_t, std::span<const Neighbour>)>& visit) {
  std::vector<Indexed> indexed;
  indexed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    indexed.emplace_back(Kernel::Point_3(points[i].x(), points[i].y(), points[i].z()), static_cast<std::uint32_t>(i));
  Search::Tree tree(indexed.begin(), indexed.end());
  if (!indexed.empty()) tree.build();  // now: otherwise the first query builds it, which is no work for several threads

  const std::size_t chunks = (points.size() + kChunk - 1) / kChunk;
  parallel_for(chunks, [&](std::size_t chunk) {
    std::vector<Neighbour> found;
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const auto self = static_cast<std::uint32_t>(i);
      found.clear();
      // One more than wanted: the point itself is among them, or, of many equal points, others in its place.
      for (const auto& [point, squared] : Search(tree, indexed[i].first, static_cast<unsigned>(count) + 1))
        if (point.second != self) found.push_back({point.second, squared});
      std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
        return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance : a.index < b.index;
      });
      if (found.size() > static_cast<std::size_t>(count)) found.resize(static_cast<std::size_t>(count));
      visit(self, found);
    }
  });
}

}  // namespace treadmark::scans
