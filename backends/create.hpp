// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/moving_section.hpp"
#include "treadmark/model/shape/surface_difference.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark {

using sampling::Region;

/// The representations there are, see registry.hpp: "analytic", "spline", "nurbs", "mesh" (smooth over the triangles),
/// "mesh-flat" (the triangles themselves), "offset" (bicubic), "offset-quadratic", "offset-bilinear", "level-set", and
/// what the program has registered. The texts live as long as the program.
std::vector<std::string_view> backend_names();

/// Errors: Error(configuration) that lists the representations if this is none of them.
void require_backend(std::string_view name);

/// Standard profiles that StandardProfile::name may name: "60E1", "S1002".
std::span<const std::string_view> standard_profile_names();

class NaturalKind;
/// The kind of a single surface.
std::shared_ptr<const NaturalKind> plain_kind();

/// A surface in the representation it is given in: formulas stay formulas, points and slices become splines, triangles
/// a mesh.
struct NaturalSurface {
  SurfaceSpec spec;  ///< what it was made from; for a file of offsets body and radius only
  std::shared_ptr<const Surface> surface;
  std::string note;                                        ///< repairs worth knowing; may be empty
  std::shared_ptr<const NaturalKind> kind = plain_kind();  ///< one surface, or made of others; never null
  /// As Surface::constant_profile().
  bool constant_profile() const { return surface->constant_profile(); }
};

/// Errors: Error(configuration) for a wheel without a positive nominal radius, a shape or defect that belongs to the
/// other body, defects that make no sense; Error(input_data) when points, slices or triangles cannot be used.
NaturalSurface create_natural(SurfaceSpec spec);

/// Offsets over their base from a .vdb or .nvdb file. Errors: Error(input_data) for a file that is not one of ours.
NaturalSurface read_offset_surface(const std::filesystem::path& file);

/// Which representation, at what resolution, where.
struct Representation {
  std::string backend;  ///< of backend_names(); "" = the natural one
  double resolution =
      0.0;        ///< spacing of the samples [m]; 0 = none where the data serve directly, else kDefaultResolution
  Region region;  ///< sampled part (of a roller u is the arc length); a rail without ends is limited to
                  ///< +-kDefaultHalfLength if this does not limit it
};
inline constexpr double kDefaultResolution = 0.5e-3;  ///< [m]
inline constexpr double kDefaultHalfLength = 0.5;     ///< [m]

/// Arc-length step at which formulas are sampled for splines when no resolution is asked for [m].
inline constexpr double kResampleStep = 0.25e-3;

/// One of several surfaces that make up a body.
struct SurfacePart {
  std::shared_ptr<const NaturalSurface> natural;
  Vec3 offset = Vec3::Zero();  ///< of its frame in that of the body [m]
  std::string backend;         ///< of backend_names(), overrides that of the whole body; "" = not set
  double resolution = 0.0;     ///< [m] 0 = not set
};

/// Several surfaces as one: the outermost one counts, see assembly::outermost_of. Represented, every part is sampled by
/// itself; triangles and slices are those of the outer skin. Errors: Error(configuration) without parts, or for rails
/// and wheels mixed, wheels out of their axle, or different nominal radii.
NaturalSurface join_surfaces(std::vector<SurfacePart> parts);

/// A surface in a representation that was asked for.
struct RepresentedSurface {
  std::shared_ptr<const Surface> surface;
  bool resampled = false;      ///< false: the natural surface itself
  double resolution = 0.0;     ///< [m] 0 = as given
  Region region;               ///< where the surface stands for the natural one
  double build_seconds = 0.0;  ///< as used_seconds() counts, sampling included
  std::string note;            ///< repairs and limits worth knowing; may be empty
};

/// A rail whose section moves along the track, as slices; section: points, a standard profile or a chain of arcs of a
/// rail. Errors: Error(configuration) for another shape, or a motion that makes no sense.
SliceSet move_section(const SurfaceSpec& section, const MovingSection& motion);

/// Turns a surface into a representation. Errors: Error(configuration) for an unknown backend, one that cannot
/// represent the shape, or a resolution where nothing is sampled; those of sampling and of the backends.
RepresentedSurface represent(const NaturalSurface& natural, const Representation& wanted);

/// How far the representation lies from what it was sampled from, over its region.
SurfaceDifference fit_error(const NaturalSurface& natural, const RepresentedSurface& represented);

/// The surface of one wheel or rail in a representation at the default resolution; errors as above.
std::shared_ptr<const Surface> create_surface(const SurfaceSpec& spec, std::string_view backend = "");

/// What a sampling covers.
struct Sampled {
  double resolution = 0.0;  ///< [m] 0 = as given
  Region region;
  std::string note;
};

/// A surface as triangles (io/meshes writes them), sampled as wanted says; wanted.backend is ignored. sampled: filled
/// in if not null. Errors: those of represent.
TriangleMesh to_triangles(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled = nullptr);
/// The same as slices (io/profiles writes them).
SliceSet to_slices(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled = nullptr);
/// The same as splines (io/splines writes them), one for each part. wanted.backend: one that has splines; empty: given
/// splines, else "nurbs". Given splines are not sampled unless a resolution or another backend is asked for.
std::vector<SplineSurface> to_splines(const NaturalSurface& natural, const Representation& wanted,
                                      Sampled* sampled = nullptr);
/// The same as offsets over their base in a .vdb or .nvdb file. base: what the offsets add to, a constant section of
/// the same body and radius; null: the section without defects, or the median one. notes: for the head of the file.
/// Errors also: Error(configuration) for a file that cannot be written.
void write_offsets(const std::filesystem::path& file, const NaturalSurface& natural, const Representation& wanted,
                   Sampled* sampled = nullptr, const SurfaceSpec* base = nullptr, const std::string& notes = {});

}  // namespace treadmark
