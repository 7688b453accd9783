// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/contact_program/write_subs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/io/results/sample_block.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/io/results/text_reader.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using ::testing::ElementsAre;

TEST(WriteSubs, BlocksReadBack) {
  const std::vector<io::SubsurfaceBlock> blocks{testing::sample_block(3, 2, 4), testing::sample_block(1, 1, 2)};
  for (const bool tensor : {false, true}) {
    const testing::NumberText text = testing::read_numbers(io::blocks_to_subs(blocks, tensor));
    ASSERT_EQ(text.names.size(), 4u);
    EXPECT_THAT(text.names[2], ElementsAre("NX", "NY", "NZ"));
    if (tensor)
      EXPECT_THAT(text.names[1], ElementsAre("X", "Y", "Z", "UX", "UY", "UZ", "SIGHYD", "SIGVM", "SIGXX", "SIGXY",
                                             "SIGXZ", "SIGYY", "SIGYZ", "SIGZZ"));
    else
      EXPECT_THAT(text.names[1], ElementsAre("X", "Y", "Z", "UX", "UY", "UZ", "SIGHYD", "SIGVM"));
    ASSERT_EQ(text.rows.size(), 1u + 24u + 1u + 2u);
    EXPECT_THAT(text.rows[0], ElementsAre(3, 2, 4));
    EXPECT_THAT(text.rows[25], ElementsAre(1, 1, 2));
    for (std::size_t i = 0; i < 24; ++i) {
      const io::SubsurfaceValue& v = blocks[0].values[i];
      std::vector<double> expected{v.point.x() * 1e3,        v.point.y() * 1e3,        v.point.z() * 1e3,
                                   v.displacement.x() * 1e3, v.displacement.y() * 1e3, v.displacement.z() * 1e3,
                                   v.hydrostatic * 1e-6,     v.von_mises * 1e-6};
      if (tensor)
        for (const auto& [row, column] : {std::pair{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}})
          expected.push_back(v.stress(row, column) * 1e-6);
      const std::vector<double>& read = text.rows[1 + i];
      ASSERT_EQ(read.size(), expected.size());
      for (std::size_t k = 0; k < read.size(); ++k)
        EXPECT_NEAR(read[k], expected[k], 1e-12 * std::abs(expected[k])) << i << ' ' << k;
    }
  }
}

TEST(WriteSubs, RefusesBlocksThatAreNotFull) {
  const testing::TemporaryFolder folder;
  std::vector<io::SubsurfaceBlock> blocks{testing::sample_block(3, 2, 4)};
  io::write_subs(folder.path() / "a.subs", blocks, true);
  blocks[0].values.pop_back();
  EXPECT_THROW(io::write_subs(folder.path() / "a.subs", blocks, true), Error);
  EXPECT_EQ(testing::read_numbers(testing::read_text(folder.path() / "a.subs")).rows.size(), 25u);
  EXPECT_EQ(folder.count_files(), 1u);
}

}  // namespace
}  // namespace treadmark
