// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/tests/representation/kinds.hpp"

namespace treadmark::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

void expect_refused(ErrorKind kind, const char* words, const std::function<void()>& build) {
  try {
    build();
    ADD_FAILURE() << "accepted, expected: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

void expect_refused(const SurfaceSpec& spec, const char* words) {
  expect_refused(ErrorKind::configuration, words, [&] { create_natural(spec); });
}

constexpr const char* kAll =
    "available: analytic, spline, nurbs, thb, thb-quadratic, mesh, mesh-flat, offset, offset-quadratic, "
    "offset-bilinear, chords, prismatic";

TEST(CreateSurface, ListsWhatThereIs) {
  EXPECT_THAT(backend_names(), ElementsAre("analytic", "spline", "nurbs", "thb", "thb-quadratic", "mesh", "mesh-flat",
                                           "offset", "offset-quadratic", "offset-bilinear", "chords", "prismatic"));
