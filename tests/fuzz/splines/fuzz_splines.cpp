// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/spline_gaps.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_splines) {
  using namespace treadmark;
  if (!has_part("expat")) return 0;
  try {
    const io::SplineFile file = io::parse_splines(fuzz::as_text(data, size), "fuzz.xml");
    for (const SplineSurface& s : file.surfaces)
      for (const Body body : {Body::rail, Body::wheel}) {
        try {
          spline::make_given_surface(s, body);
        } catch (const Error&) {
          // a fair answer, as below
        }
      }
    spline::spline_gaps(file.surfaces, file.interfaces);
  } catch (const Error&) {
  }
  return 0;
}
