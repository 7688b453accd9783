// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "treadmark/backends/conformance/promises.hpp"
#include "treadmark/backends/conformance/shapes.hpp"
#include "treadmark/tests/consumer/project/chebyshev_backend.hpp"

namespace treadmark::conformance {
namespace {

/// How a backend joins the suite, and what it promises.
struct Contestant {
  std::string backend;
  double resolution;            ///< of its samples [m], 0 = its own
  Tolerance constant, damaged;  ///< for shapes of one cross-section, and with defects
};

// Where the promises come from. analytic: closed form, rounding only; the published joints of S1002 are steps of up to
// 0.12 um. spline: a cubic spline rounds off the jumps of curvature between the arcs: up to 77/m over a spacing h =
// 0.25 mm, that is about 77 h^2/12 = 0.4 um and 77 h/5 = 4 mrad; slices are fitted at h = 0.5 mm. nurbs, mesh: the same
// at 0.5 mm. mesh-flat: h^2/(8 r) and h/r on the arc of r = 12 mm. offset: exact where nothing is damaged. The ends of
// the fresh flat turn by k = 44 mrad: facets and bilinear offsets cut up to k h/4 = 5.4 um off there, splines up to
// about k h/8 = 2.7 um. chords: h^2/(8 r) = 2.6 um and h/(2 r) on the arc of r = 12 mm, and splines along. prismatic:
// as spline at 0.5 mm, against the shape that has the section in the middle of the region everywhere. level-set:
// triangles and splines both at 0.5 mm, each of which rounds the joints off as mesh does. chebyshev: as offset; its
// waves near the joints of curvature die away slowly.
std::vector<Contestant> contestants() {
  [[maybe_unused]] static const bool registered = (register_chebyshev(), true);
  return {
#define TREADMARK_CONTESTANT(backend, resolution, constant, damaged) {backend, resolution, constant, damaged},
#include "treadmark/tests/conformance/contestants.def"
#undef TREADMARK_CONTESTANT
  };
}

struct Contest {
  Shape shape;
  Contestant contestant;
};

std::ostream& operator<<(std::ostream& out, const Contest& c) {
  return out << c.contestant.backend << '_' << c.shape.name;
}

std::vector<Contest> contests() {
  std::vector<Contest> all;
  for (const Contestant& contestant : contestants())
    for (const Backend* backend : backends())  // this build may leave some out
      if (backend->name == contestant.backend)
        for (const Shape& shape : shapes()) all.push_back({shape_for(*backend, shape), contestant});
  return all;
}

class Conformance : public ::testing::TestWithParam<Contest> {};

INSTANTIATE_TEST_SUITE_P(Backends, Conformance, ::testing::ValuesIn(contests()), [](const auto& which) {
  std::string name = which.param.shape.name + "__" + which.param.contestant.backend;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(Conformance, KeepsEveryPromise) {
  const auto& [shape, contestant] = GetParam();
  Subject subject =
      subject_of(shape, represented(shape, contestant.backend, contestant.resolution), backend_of(contestant.backend));
  subject.tolerance = shape.constant() ? contestant.constant : contestant.damaged;
  for (const Promise& promise : promises()) {
    const Finding found = hold(promise, subject);
    EXPECT_TRUE(found.kept()) << promise.name << ": " << promise.says << ": " << found.where;
  }
  // and the short form finds nothing wrong with what is right
  EXPECT_EQ(broken_promise(look_at(subject.surface)), "");
}

}  // namespace
}  // namespace treadmark::conformance
