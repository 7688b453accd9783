// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/backends/resampling.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark {

/// Where slopes of a representation jump: nowhere, between cells that are curved, across from chord to chord, or
/// everywhere between flat facets, whose curvatures are 0.
enum class Creases { none, cells, chords, facets };

/// One representation of surfaces: all that the rest of Treadmark knows of it.
struct Backend {
  std::string name;     ///< for case files and the command line, see is_backend_name; Surface::backend() says the same
  std::string summary;  ///< what it is, in one line
  double order = 0.0;   ///< heights of smooth surfaces are off by about resolution^order; infinite: exact
  bool over_base = false;  ///< made of an undamaged surface and what is added to it, see undamaged_base

  /// Makes it from another surface, sampled by the resampling in its natural view. Empty: not from samples. Called
  /// from any thread. Errors: Error(configuration) for a body or shape that it cannot represent.
  std::function<std::shared_ptr<const Surface>(Resampling&)> resample{};
  /// The splines that resample would make, for files of splines. Empty: it has none.
  std::function<SplineSurface(Resampling&)> tell_splines{};
  std::string needs{};   ///< without resample: what it is made from, as in "the backend 'x' needs ..."
  std::string advice{};  ///< without resample: what to do instead

  /// Whether shapes like this are given in this representation, and the surface with its defects, without samples;
  /// repairs are added to the note. Both or neither. Of several backends that say yes the first one registered counts.
  std::function<bool(const SurfaceSpec&)> natural_for{};
  std::function<std::shared_ptr<const Surface>(const SurfaceSpec&, std::string& note)> make_natural{};

  std::string
      part{};  ///< of parts() (core/parts.hpp) that it needs; a build without that refuses it by name. Empty: none

  /// Made for one place, the middle of the region: cases at different places get surfaces of their own.
  bool one_place = false;

  Creases creases = Creases::none;  ///< what conformance (backends/conformance/promises.hpp) does not ask of it
};

/// Adds a representation; from then on it is a choice wherever names of backends are read, and last in every list.
/// Backends are never removed. Safe from any thread, but a comparison or benchmark that has begun goes on with the list
/// that it took: register before. Errors: Error(configuration) for a name that is taken or that no case file could
/// hold, a row without a summary, and one that makes nothing.
void register_backend(Backend backend);

/// All of them: the built-in ones, then those added, in their order. The rows live as long as the program.
std::vector<const Backend*> backends();
/// Those that this build leaves out.
std::vector<const Backend*> left_out_backends();

/// Errors: Error(configuration) that lists the representations if the name is none of them, or says how one that this
/// build leaves out is put in.
const Backend& backend_of(std::string_view name);

/// The one that shapes like this are given in. Errors: Error(configuration) if there is none, or it is left out.
const Backend& natural_backend(const SurfaceSpec& spec);

/// A surface without samples. Errors: those of natural_backend and of the backend.
std::shared_ptr<const Surface> make_natural(const SurfaceSpec& spec);

/// What a comparison of representations asks for.
struct BackendChoice {
  std::string backend;
  double resolution = 0.0;  ///< [m] 0 = as given
};

/// The named representations (none named: all that the shapes allow) at every resolution. A backend in which all of the
/// surfaces are given already comes first without a resolution; one that is not made from samples comes without one
/// only. Errors: those of backend_of.
std::vector<BackendChoice> backend_choices(const std::vector<std::string>& names,
                                           const std::vector<double>& resolutions,
                                           const std::vector<const NaturalSurface*>& surfaces);

/// The error of represent for a resolution where nothing is sampled.
[[noreturn]] void refuse_idle_resolution(const SourcePosition& where = {});

}  // namespace treadmark
