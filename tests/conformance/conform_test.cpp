// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What the suite is worth: wrong surfaces are caught by the name of the promise that they break, right ones are not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "treadmark/backends/conformance/promises.hpp"
#include "treadmark/backends/conformance/shapes.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/conformance/wrong_backends.hpp"

namespace treadmark::conformance {
namespace {

using ::testing::HasSubstr;
using Names = std::set<std::string>;

TEST(Conform, CatchesWrongBackendsByThePromiseThatTheyBreak) {
  testing::register_wrong_backends();
  for (const auto& [backend, broken] : {std::pair{"narrow", Names{"bounds", "many-bounds"}},
                                        {"bent", Names{"curvatures", "parameters"}},
                                        {"analytic", Names{}}}) {
    const Record record = hold_backend(backend, 0.0);
    Names names;
    for (const Kept& row : record.rows) {
      EXPECT_EQ(row.held, static_cast<int>(shapes().size()));
      if (row.kept < row.held) names.insert(row.promise->name);
    }
    EXPECT_EQ(names, broken) << record.text();
    EXPECT_EQ(record.kept(), broken.empty());
    for (const Shape& shape : shapes()) {  // the short form
      const std::string words = broken_promise(look_at(represented(shape, backend, 0.0)));
      if (broken.empty()) {
        EXPECT_EQ(words, "") << shape.name;
      } else {
        EXPECT_THAT(words, HasSubstr("breaks the promise '" + *broken.begin() + "'")) << shape.name;
      }
    }
  }
}

TEST(Conform, ASurfaceThatFailsHasBrokenThePromise) {
  const Promise fails{"fails", "",    0,
                      false,   false, [](const Subject&) -> Finding { throw Error(ErrorKind::numerical, "no way"); }};
  EXPECT_FALSE(hold(fails, {}).kept());
  EXPECT_THAT(hold(fails, {}).where, HasSubstr("no way"));
  EXPECT_THROW(hold_backend("clay", 0.0), Error);
}

}  // namespace
}  // namespace treadmark::conformance
