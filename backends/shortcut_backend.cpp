// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "treadmark/backends/assembly/renamed_surface.hpp"
#include "treadmark/backends/builtin.hpp"
#include "treadmark/backends/spline/chords.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

constexpr const char *kChords = "chords", *kPrismatic = "prismatic";

std::shared_ptr<const Surface> as_chords(Resampling& r) {
  const SurfaceSpec& spec = r.spec();
  std::shared_ptr<const Surface> made;
  const auto* given = std::get_if<Profile>(&spec.shape);
  if (given != nullptr && !r.asked() && spec.defects.empty()) {
    r.set_resolution(0.0);  // the points themselves are what is joined
    made = spline::make_chord_surface(*given, spec.nominal_radius);
  } else if (r.natural().constant_profile()) {
    made = spline::make_chord_surface(r.section(), spec.nominal_radius);
  } else {
    made = spline::make_chord_surface(r.points(false), spec.nominal_radius);
  }
  return assembly::rename_surface(std::move(made), kChords);
}

/// The section in the middle of the region, everywhere.
std::shared_ptr<const Surface> as_prismatic(Resampling& r) {
  const SurfaceSpec& spec = r.spec();
  const double middle = 0.5 * (r.region().u_min + r.region().u_max);
  const bool constant = r.natural().constant_profile();
  if (!constant && !std::isfinite(middle))
    throw Error(
        ErrorKind::configuration,
        fmt::format("the backend '{}' takes the section of one place for all, and no place is told", kPrismatic), {},
        "limit the range to that about one place, or use the backend 'spline'");
  if (!constant)
    r.add_note(spec.body == Body::wheel ? fmt::format("the section at {:.6g} degrees all round. ", middle * 180.0 / kPi)
                                        : fmt::format("the section at x = {:.6g} mm everywhere. ", 1e3 * middle));
  const Profile section = constant ? r.section() : r.section_at(middle);
  return assembly::rename_surface(spline::make_profile_surface(section, spec.nominal_radius), kPrismatic);
}

}  // namespace

std::vector<Backend> shortcut_backends() {
  Backend chords{kChords, "points of sections joined by straight lines, cubic along or round", 2.0, false, as_chords};
  chords.creases = Creases::chords;
  Backend prismatic{kPrismatic, "the section at the contact, the same along the track or all round", 4.0, false,
                    as_prismatic};
  prismatic.one_place = true;
  return {chords, prismatic};
}

}  // namespace treadmark
