// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// A surface ready for contact analysis.
struct StoredSurface {
  std::shared_ptr<const NaturalSurface> natural;  ///< as given
  RepresentedSurface represented;                 ///< as asked for; used in the analysis
  /// Prismatic rail (so no roller), round wheel; as given, or made so.
  bool constant_profile() const { return natural->constant_profile() || represented.surface->constant_profile(); }
  Body body() const { return natural->spec.body; }
};

/// Reads every distinct geometry once, and builds every distinct representation of it once. Not thread-safe.
class SurfaceStore {
 public:
  /// region: what has to be sampled if the representation needs samples.
  /// Errors of the readers and backends pass through, with the place in the case file that asked for the geometry.
  /// radius: nominal radius of a wheel, or of a roller in place of a rail [m]; 0 = it is a rail.
  const StoredSurface& get(const io::SurfaceSource& source, Body body, double radius, const Region& region);

  /// The surface itself, whatever it is represented by.
  std::shared_ptr<const NaturalSurface> natural(const io::SurfaceSource& source, Body body, double radius);

  /// The surface that a source stands for from now on, in place of what it names. For sources that nobody has asked
  /// for yet.
  void put(const io::SurfaceSource& source, Body body, double radius, std::shared_ptr<const NaturalSurface> surface);
  /// Whether put() was called.
  bool replaced() const { return replaced_; }

  /// Tells the natural surface of a source from others in any store: what describes it, and the contents of its files.
  /// Defects do not show in it.
  std::string content_key(const io::SurfaceSource& source, Body body, double radius);

  /// What get() has handed out since begin_run(), in the order of the first requests, with fit errors of sampled
  /// surfaces.
  std::vector<io::SurfaceUse> uses();
  void begin_run() { used_.clear(); }
  /// Gives back the memory of surfaces that were sampled; what get() handed out of them is gone.
  void forget_sampled();

  /// (file, SHA-256) of every geometry file read so far.
  const std::vector<std::pair<std::string, std::string>>& hashes() const { return hashes_; }

 private:
  struct Natural {
    std::string key;
    Defects defects;
    std::shared_ptr<const NaturalSurface> surface;
  };
  struct Stored {
    const NaturalSurface* natural;
    Representation representation;
    std::unique_ptr<StoredSurface> surface;
    SurfaceDifference fit;
    bool fit_known = false;
  };

  void note_hashes(const io::SurfaceSource& source);

  std::vector<Natural> naturals_;
  std::vector<std::unique_ptr<Stored>> stored_;
  std::vector<Stored*> used_;
  std::vector<std::pair<std::string, std::string>> hashes_;
  bool replaced_ = false;
};

}  // namespace treadmark::app
