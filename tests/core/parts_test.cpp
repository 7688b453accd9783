// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

TEST(Parts, AreNamedOnceAndHaveAnOption) {
  std::set<std::string_view> keys, names, options;
  for (const Part& part : parts()) {
    EXPECT_TRUE(keys.insert(part.key).second) << part.key;
    EXPECT_TRUE(names.insert(part.name).second) << part.name;
    EXPECT_TRUE(options.insert(part.option).second) << part.option;
    EXPECT_TRUE(part.option.starts_with("TREADMARK_")) << part.option;
    EXPECT_EQ(has_part(part.key), part.built);
  }
  for (const char* key : {"embree", "openvdb", "nanovdb", "hdf5", "tbb", "fftw", "cgal", "vehicle", "scans", "report"})
    EXPECT_TRUE(keys.contains(key)) << key;
}

TEST(Parts, WhatIsLeftOutNamesOptionAndPackage) {
  try {
    left_out("openvdb", "the backend 'level-set'");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_STREQ(error.what(),
                 "this build leaves out the backend 'level-set' (OpenVDB) (configure with -DTREADMARK_WITH_OPENVDB=ON, "
                 "Debian package libopenvdb-dev and libboost-iostreams-dev)");
  }
  EXPECT_EQ(left_out_advice("vehicle"), "configure with -DTREADMARK_VEHICLE=ON");
  for (const Part& part : parts())
    if (part.built) {
      EXPECT_NO_THROW(require_part(part.key, "something"));
    } else {
      EXPECT_THROW(require_part(part.key, "something"), Error);
    }
  EXPECT_THROW(has_part("imbree"), std::invalid_argument);
}

}  // namespace
}  // namespace treadmark
