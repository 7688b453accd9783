// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/sampling/region.hpp"

namespace treadmark {

/// One surface on its way into another representation: what is given, what is wanted, and samples of it in its natural
/// view. A backend may put down what it really did. Not thread-safe; lives only while a surface is made.
class Resampling {
 public:
  /// Errors: Error(configuration) for a resolution that is negative or not finite.
  Resampling(const NaturalSurface& natural, const Representation& wanted);

  const NaturalSurface& natural() const { return natural_; }
  const Surface& surface() const { return *natural_.surface; }
  const SurfaceSpec& spec() const { return natural_.spec; }
  bool asked() const { return asked_; }  ///< whether a resolution was asked for

  /// Spacing of samples [m]; 0 = put down by a backend that needed none.
  double resolution() const { return resolution_; }
  void set_resolution(double resolution) { resolution_ = resolution; }

  /// What is sampled, and what the result stands for. limit_rail() makes that of a rail finite along the track.
  const Region& region() const { return region_; }
  void limit_rail();

  /// For people: sentences, each with a space after it.
  const std::string& note() const { return note_; }
  void set_note(std::string note) { note_ = std::move(note); }
  void add_note(const std::string& note) { note_ += note; }

  /// Samples of the region at the resolution, in different shapes. points: see sampling::SampleSettings. section: that
  /// of a surface with one cross-section. triangles: those that are given if nothing else is asked for. Errors: those
  /// of sampling.
  sampling::PointGrid points(bool common, bool staggered = false);
  Profile section() const;
  SliceSet slices();
  TriangleMesh triangles();
  /// The median section of all the region, for a rail or wheel of unknown origin: undamaged, if most of it is.
  Profile median_section();

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
