// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/sampling/region.hpp"

namespace treadmark {

/// One surface on its way into another representation: what is given, what is wanted, and samples of it in its natural
/// view. A backend may record what it really did. Not thread-safe; lives only while a surface is made.
class Resampling {
 public:
  /// Errors: Error(configuration) for a resolution that is negative or not finite.
  Resampling(const NaturalSurface& natural, const Representation& wanted);

  const NaturalSurface& natural() const { return natural_; }    ///< what is given
  const Surface& surface() const { return *natural_.surface; }  ///< its surface
  const SurfaceSpec& spec() const { return natural_.spec; }     ///< what that was made from
  bool asked() const { return asked_; }                         ///< whether a resolution was asked for

  /// Spacing of samples [m]; 0 = a backend recorded that it needed none.
  double resolution() const { return resolution_; }
  /// For a backend whose spacing turned out to be another one [m].
  void set_resolution(double resolution) { resolution_ = resolution; }

  /// What is sampled, and what the result stands for.
  const Region& region() const { return region_; }
  /// Makes the region of a rail finite along the track.
  void limit_rail();

  /// For people: sentences, each with a space after it.
  const std::string& note() const { return note_; }
  void set_note(std::string note) { note_ = std::move(note); }  ///< instead of what was noted
  void add_note(const std::string& note) { note_ += note; }     ///< one more sentence

  /// Samples of the region at the resolution: points on stations times lateral nodes. common: only the lateral range
  /// that all sections have; staggered: as PointGrid::stagger, for triangles. Errors: those of sampling, here and
  /// below.
  sampling::PointGrid points(bool common, bool staggered = false);
  /// That of a surface with one cross-section.
  Profile section() const;
  /// That at one station u [m] or [rad]. Errors: Error(input_data) if it has gaps or hardly any points.
  Profile section_at(double u) const;
  /// Cross-sections at stations.
  SliceSet slices();
  /// Those that are given if nothing else is asked for, else made of points.
  TriangleMesh triangles();
  /// The median section of all the region, for a rail or wheel of unknown origin: undamaged, if most of it is.
  Profile median_section();

  /// What was recorded so far.
  Sampled sampled() const { return {resolution_, region_, note_}; }

 private:
  std::string name_of_samples() const;
  sampling::PointGrid kept(sampling::PointGrid grid);

  const NaturalSurface& natural_;
  Region region_;
  double resolution_;
  bool asked_;
  std::string note_;
};

}  // namespace treadmark
