// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/section_bridges.hpp"

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"

namespace treadmark::app {

std::vector<SectionBridge> section_bridges(const SliceSet& slices) {
  // A border of the surface that runs more across than along is none: wings move aside by 1:4 at most.
  constexpr double kLeast = 5e-3, kSteepest = 1.0;
  std::vector<SectionBridge> out;
  if (slices.body != Body::rail || !slices.features.empty()) return out;
  for (std::size_t i = 0; i + 1 < slices.profiles.size(); ++i) {
    const Profile &a = slices.profiles[i], &b = slices.profiles[i + 1];
    const auto bridge = [&](bool begins) {
      const auto end = [&](const Profile& p) {
        return begins ? Vec2(p.y.front(), p.z.front()) : Vec2(p.y.back(), p.z.back());
      };
      return SectionBridge{i, slices.u[i], slices.u[i + 1], begins, end(a), end(b)};
    };
    const SectionBridge begin = bridge(true), end = bridge(false);
    const auto apart = [](const SectionBridge& one) { return (one.to - one.from).norm(); };
    const SectionBridge& wider = apart(begin) > apart(end) ? begin : end;
    if (apart(wider) > kLeast && apart(wider) > kSteepest * (wider.u_to - wider.u_from)) out.push_back(wider);
  }
  return out;
}

std::string to_text(const SectionBridge& b) {
  return fmt::format(
      "slices {} and {} (x = {:.6g} and {:.6g} mm) {} at y = {:.4g}, z = {:.4g} mm and y = {:.4g}, z = {:.4g} mm: the "
      "surface between them joins what is not the same part; give features in the file of slices",
      b.first + 1, b.first + 2, kMilli * b.u_from, kMilli * b.u_to, b.begins ? "begin" : "end", kMilli * b.from.x(),
      kMilli * b.from.y(), kMilli * b.to.x(), kMilli * b.to.y());
}

}  // namespace treadmark::app
