// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

/// A surface ready for contact analysis.
struct StoredSurface {
  std::shared_ptr<const Surface> surface;
  bool constant_profile = true;  ///< prismatic rail or round wheel
};

/// Reads every distinct geometry of a run once and builds its surface. Not thread-safe.
class SurfaceStore {
 public:
  /// Errors of the readers and backends pass through, with the place in the case file that asked for the geometry.
  const StoredSurface& get(const io::SurfaceSource& source, Body body, double nominal_radius);

  /// (file, SHA-256) of every geometry file asked for so far.
  const std::vector<std::pair<std::string, std::string>>& hashes() const { return hashes_; }

 private:
  void note_hash(const std::string& file);
  std::map<std::string, StoredSurface> surfaces_;
  std::vector<std::pair<std::string, std::string>> hashes_;
};

}  // namespace treadmark::app
