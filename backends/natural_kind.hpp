// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/create.hpp"

namespace treadmark {

/// How a natural surface is represented, compared and written: what create.hpp promises of these functions. This class
/// does it for one surface, from samples in its natural view; surfaces made of others override what they pass on.
/// Immutable, thread-safe. natural is the surface that has this kind.
class NaturalKind {
 public:
  virtual ~NaturalKind() = default;
  virtual RepresentedSurface represent(const NaturalSurface& natural, const Representation& wanted) const;
  virtual SurfaceDifference fit_error(const NaturalSurface& natural, const RepresentedSurface& represented) const;
  virtual TriangleMesh to_triangles(const NaturalSurface& natural, const Representation& wanted,
                                    Sampled* sampled) const;
  virtual SliceSet to_slices(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled) const;
  virtual std::vector<SplineSurface> to_splines(const NaturalSurface& natural, const Representation& wanted,
                                                Sampled* sampled) const;
  virtual void write_offsets(const std::filesystem::path& file, const NaturalSurface& natural,
                             const Representation& wanted, Sampled* sampled, const SurfaceSpec* base,
                             const std::string& notes) const;
};

/// The splines of a surface that is given by them, where all of it is wanted and nothing has to be sampled; else null.
const SplineSurface* given_splines(const NaturalSurface& natural, const Representation& wanted);

/// Rollers, which are wheels turned over, and rings, which are rails bent upwards; spec.roller_radius says which.
/// Errors: those of create_natural.
NaturalSurface create_roller(SurfaceSpec spec);
NaturalSurface create_ring(SurfaceSpec spec);

}  // namespace treadmark
