// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/app/cases/section_heights.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/model/shape/surface_errors.hpp"
#include "treadmark/solvers/wheelrail/error_spread.hpp"

namespace treadmark::app {

/// The profile of which it is known what its curve may be off, by noise or between points; nullptr for other surfaces.
const Profile* noisy_profile(const NaturalSurface& natural);

/// What noise leaves uncertain of the surfaces of one pair. Immutable; safe from any thread.
class NoiseOfResults {
 public:
  NoiseOfResults(const NaturalSurface& rail, const NaturalSurface& wheel);

  /// Whether a profile of the pair has errors, by noise or between points, or one of its surfaces was imported with
  /// them.
  bool any() const { return rail_.known() || wheel_.known(); }
  /// Adds to each patch the uncertainty that noise leaves of its surfaces, and a remark where it is large: by solving
  /// the normal problem again for some of the errors that they may have, 16 of profiles and as many of surfaces, those
  /// nearest along them. Patches without fields, and those where nothing is uncertain, stay as they are.
  void add(const io::WheelRailCase& input, io::CaseResult& result) const;
  /// Of a body the errors that it may have, those nearest along a surface, as heights at places y of its section [m]: z
  /// of a rail, radius of a wheel. Each as probable as the others; none where nothing is known of it. The result has
  /// patches.
  std::vector<std::vector<double>> heights(Body body, const io::CaseResult& result, std::span<const double> y) const;
  /// The others, where the body was imported: by placement, passes, smoothing and so on, near the contact. surface: as
  /// it is used. The result has patches.
  std::vector<SourceOfErrors> sources(Body body, const io::CaseResult& result, const Surface& surface) const;

 private:
  struct Known {
    std::shared_ptr<const ProfileScatter> scatter;
    std::optional<measured::ErrorDraws> draws;
    std::shared_ptr<const SurfaceErrors> surface;
    std::vector<double> s, y, z;  ///< points, or places across, with their arc lengths [m]
    bool known() const { return draws || surface; }
    std::size_t draws_count() const;
    /// Across the surface at an arc length [m]; of a surface the draw is one of those near the contact.
    double error(std::size_t draw, std::span<const std::size_t> near, double arc) const;
    std::string in_words(const std::string& name) const;
    /// Along the body, of the most loaded patch of a result.
    static double station(Body body, const io::CaseResult& result);
    /// Numbers of the draws that count at the most loaded patch of a result; empty of a profile.
    std::vector<std::size_t> near_draws(Body body, const io::CaseResult& result) const;
  };
  static Known known_of(const NaturalSurface& natural);
  /// Errors of the gap in the rows of patches, draw by draw.
  void add_errors(const io::WheelRailCase& input, const io::CaseResult& result,
                  std::span<io::PatchResult* const> patches, std::span<wheelrail::UncertainPatch> uncertain) const;

  Known rail_, wheel_;
};

}  // namespace treadmark::app
