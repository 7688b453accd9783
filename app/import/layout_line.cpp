// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/layout_line.hpp"

#include <memory>

#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/track_path.hpp"

namespace treadmark::app {

LayoutLine layout_line(const std::filesystem::path& file) {
  const auto path = std::make_shared<const vehicle::TrackPath>(io::read_track_layout(file));
  return {[path](double along) { return path->at(along).X_LT(); }, path->length()};
}

}  // namespace treadmark::app
