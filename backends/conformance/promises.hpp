// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "treadmark/backends/registry.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::conformance {

struct Shape;

/// How closely a surface follows the formula of its shape, and itself.
struct Tolerance {
  double height = 1e-5;  ///< greatest error normal to the surface [m]
  double slope = 3e-2;   ///< greatest error of the normal's direction against the formula [rad]
  double curvature =
      5e-2;  ///< of principal curvatures against second differences of heights, relative, for most points
};

/// A surface that is held to the promises of core/surface.hpp, and where it is looked at.
struct Subject {
  std::shared_ptr<const Surface> surface{};  ///< never null
  std::vector<Pose> planes{};                ///< near it, in its frame; at least one, the first one not rolled
  std::string backend{};                     ///< what it should call itself; empty: anything
  Tolerance tolerance{};                     ///< of promises that formulas and differences judge
  Creases creases = Creases::none;           ///< as its backend has it
  bool exact = false;                        ///< it has the kinks of its shape
  const Shape* shape = nullptr;              ///< what it should be; null: no formula is known. Outlives this
  bool brief = false;  ///< few points, of which some may be wrong: milliseconds, and nobody is blamed for grazing lines
};

/// As Finding::compared: of such a surface this is not asked.
inline constexpr std::size_t kNotAsked = static_cast<std::size_t>(-1);

/// How a promise was kept.
struct Finding {
  double worst = 0.0;        ///< the worst violation over what is allowed: above 1 the promise is broken
  std::string where{};       ///< of the worst, with numbers
  std::size_t compared = 0;  ///< numbers that were held against others
  /// Whether it was.
  bool kept() const { return worst <= 1.0; }
};

/// One thing that every surface promises.
struct Promise {
  const char* name;   ///< one word
  const char* says;   ///< what is promised
  std::size_t least;  ///< of a surface with a shape so much must be there to be compared, unless in brief
  bool of_shape;      ///< judged by Subject::shape
  bool in_brief;      ///< part of the short form
  Finding (*worst)(const Subject&);  ///< the worst violation that is found; deterministic
};

/// All of them.
std::span<const Promise> promises();

/// The worst violation of a promise. A surface that fails with an Error has broken it. of_shape: the subject needs one.
Finding hold(const Promise& promise, const Subject& subject);

/// The first promise that is broken of all that can be asked (in brief: of the short form), in words: "breaks the
/// promise 'bounds' (...): ..."; empty: none.
std::string broken_promise(const Subject& subject);

/// A surface whose shape is not known, looked at about the station u (as SurfacePoint::u) where it is seen, in brief.
/// backend: that it is represented by; empty: what it calls itself.
Subject look_at(std::shared_ptr<const Surface> surface, double u = 0.0, const std::string& backend = {});

/// What a representation of a shape must keep. The shape outlives it.
Subject subject_of(const Shape& shape, std::shared_ptr<const Surface> surface, const Backend& backend);

/// How one promise was kept by several subjects.
struct Kept {
  const Promise* promise = nullptr;  ///< which
  int held = 0, kept = 0;            ///< subjects that were held to it, and that kept it
  Finding worst{};                   ///< of all subjects
  std::string subject{};             ///< whose that is
};

/// Which promises were kept.
struct Record {
  std::vector<Kept> rows{};          ///< as promises(), once something was added
  std::vector<std::string> notes{};  ///< what could not be held, and why

  /// Holds a subject to every promise that can be asked of it.
  void add(const std::string& name, const Subject& subject);
  /// Whether all were, and something was held.
  bool kept() const;
  /// For people: a line a promise, the notes, and which promise is broken where.
  std::string text() const;
};

/// A backend by its name, held to every promise with all of shapes(), from samples so far apart [m], 0 = its own; with
/// tolerances for chords of that length. What it cannot represent is a note. Stops early where the progress says so.
/// Errors: Error(configuration) if there is no such backend.
Record hold_backend(const std::string& name, double resolution, const Progress& progress = {});

}  // namespace treadmark::conformance
