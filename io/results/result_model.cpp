// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/result_model.hpp"

#include <fmt/format.h>

#include <set>

#include "treadmark/core/error.hpp"

namespace treadmark::io {

void check_surfaces(std::span<const SampledSurface> surfaces) {
  std::set<std::string> seen;
  for (const SampledSurface& s : surfaces) {
    const auto refuse = [&](const std::string& why) {
      throw Error(ErrorKind::configuration, fmt::format("sampled surface {}: {}", s.name, why));
    };
    if (s.name.empty() || s.name == "." || s.name.find('/') != std::string::npos ||
        s.name.find('\0') != std::string::npos)
      refuse("this cannot be a name");
    if (!seen.insert(s.name).second) refuse("there are two of this name");
    if (s.body != "wheel" && s.body != "rail") refuse(fmt::format("\"{}\" is neither wheel nor rail", s.body));
    if (s.nu < 1 || s.nv < 1) refuse("it has no points");
    const std::size_t points = s.index(s.nu, 0);
    if (s.u.size() != static_cast<std::size_t>(s.nu) || s.x.size() != points || s.y.size() != points ||
        s.z.size() != points || (!s.deviation.empty() && s.deviation.size() != points))
      refuse(fmt::format("its lists do not have {} stations of {} points", s.nu, s.nv));
  }
}

int surface_index(std::span<const SampledSurface> surfaces, const std::string& name) {
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace treadmark::io
