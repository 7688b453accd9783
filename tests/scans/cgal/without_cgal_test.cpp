// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <functional>

#include "treadmark/core/error.hpp"
#include "treadmark/scans/cgal/free_mesh.hpp"
#include "treadmark/scans/cgal/plane_triangulation.hpp"

namespace treadmark::scans {
namespace {

TEST(WithoutCgal, EveryRequestNamesTheOptionAndThePackage) {
  const std::function<void()> requests[] = {
      [] { triangulate_plane({}, 1.0); },
      [] { decimate_plane({}, {}, 1.0); },
      [] { mesh_points({}, {}, {}); },
  };
  for (const auto& request : requests) try {
      request();
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::configuration);
      EXPECT_NE(error.advice().find("-DTREADMARK_WITH_CGAL=ON"), std::string::npos);
      EXPECT_NE(error.advice().find("libcgal-dev"), std::string::npos);
    }
}

}  // namespace
}  // namespace treadmark::scans
