// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_case.hpp"

namespace treadmark::io {

SurfaceSource read_profile(ContactReader& r, std::string_view body) {
  ContactText& text = r.text;
  text.begin_record(fmt::format("the {} profile line", body));
  GeometryFile source;
  ProfileOptions& options = source.options;
  const std::string name = text.quoted("the file name");
  const SourcePosition where = text.where();
  if (name.empty()) text.fail(fmt::format("the {} profile has no file name", body));
  source.file = resolve_name(r.folder, name);

  const long mirror_y = text.integer("MIRRORY");
  if (mirror_y < -1 || mirror_y > 1) text.fail("MIRRORY must be -1, 0 or 1");
  options.mirror_y = mirror_y == 1 ? 1 : 0;
  options.scale = text.real("SCALE");
  constexpr double kSmallestScale = 1e-6;
  if (options.scale < kSmallestScale) text.fail(fmt::format("SCALE must be at least {}", kSmallestScale));
  const double strength = text.real("SMOOTH");
  if (strength < 0.0) text.fail("SMOOTH must not be negative");

  long further = 0;
  if (const auto mirror_z = text.optional_integer()) {
    if (*mirror_z < -1 || *mirror_z > 1) text.fail("MIRRORZ must be -1, 0 or 1");
    options.mirror_z = static_cast<int>(*mirror_z);
    further = text.optional_integer().value_or(0);
    if (further < 0 || further > 2) text.fail("PRFOPT must be 0, 1 or 2");
  }

  SmoothingOptions& smoothing = options.smoothing;
  if (further >= 1) {
    text.begin_record("the profile option line ISMOOTH");
    const long method = text.integer("ISMOOTH");
    if (method < 0 || method > 2) text.fail("ISMOOTH must be 0, 1 or 2");
    smoothing.method = static_cast<SmoothingOptions::Method>(method);
    constexpr double kLeastZigzag = std::numbers::pi / 4.0;
    options.zigzag_threshold = std::max(kLeastZigzag, text.angle("ZIGTHRS"));
    smoothing.kink_high = text.angle("KINKHIGH");
    smoothing.kink_low = text.angle("KINKLOW");
    if (!(smoothing.kink_high > 0.0) || !(smoothing.kink_low > 0.0) || smoothing.kink_low > smoothing.kink_high)
      text.fail("the kink thresholds must satisfy 0 < KINKLOW <= KINKHIGH");
    smoothing.kink_width = text.real("KINKWID") * kMillimetre;
    if (!(smoothing.kink_width > 0.0)) text.fail("KINKWID must be positive");
  }
  if (further == 2) {
    text.begin_record("the profile option line ERRHND");
    options.error_handling = static_cast<int>(std::clamp(text.integer("ERRHND"), -100L, 100L));
    options.max_omit = text.real("MAXOMIT");
    if (options.max_omit < 0.0 || options.max_omit > 1.0) text.fail("MAXOMIT must lie in 0 ... 1");
    if (options.error_handling != 0)
      r.note(fmt::format("ERRHND = {} at {}: read, but errors in a profile always stop the run", options.error_handling,
                         text.where().to_string()));
  }
  // lambda is a volume in the unweighted method and a wavelength in the others.
  const bool wavelength = smoothing.method != SmoothingOptions::Method::spline;
  smoothing.strength = strength * (wavelength ? kMillimetre : kMillimetre * kMillimetre * kMillimetre);

  SurfaceSource surface;
  source.open_seam = true;  // as in the reference program
  surface.geometry = source;
  surface.where = where;
  return surface;
}

}  // namespace treadmark::io
