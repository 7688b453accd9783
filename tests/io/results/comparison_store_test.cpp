// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_store.hpp"

#include <gtest/gtest.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/tests/io/results/comparison_sample.hpp"
#include "treadmark/tests/io/results/same_run.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

TEST(ComparisonStore, FieldsOfAllCandidatesComeBack) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "fields.h5";
  io::Comparison written = testing::sample_comparison();
  written.settings = {"bodies=wheel"};
  written.complete = false;
  io::ComparisonCandidate& truth = written.candidates.front();
  truth.surfaces = testing::sample_surfaces();
  ASSERT_FALSE(truth.results.empty());
  truth.results[0].wheel_surface = "wheel_1";
  for (io::ComparisonCandidate& c : written.candidates)
    for (io::CaseResult& result : c.results)
      for (io::PatchResult& patch : result.patches) patch.npot = static_cast<int>(patch.fields.grid.size());
  io::write_comparison_fields(path, written);
  const io::Comparison read = io::read_comparison_fields(path);
  EXPECT_EQ(read.version, written.version);
  EXPECT_EQ(read.git, written.git);
  EXPECT_EQ(read.title, written.title);
  EXPECT_EQ(read.input_file, written.input_file);
  EXPECT_EQ(read.input_sha256, written.input_sha256);
  EXPECT_EQ(read.settings, written.settings);
  EXPECT_EQ(read.truth, written.truth);
  EXPECT_FALSE(read.complete);
  ASSERT_EQ(read.candidates.size(), written.candidates.size());
  for (std::size_t i = 0; i < read.candidates.size(); ++i) {
    const io::ComparisonCandidate &a = read.candidates[i], &b = written.candidates[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.resolution, b.resolution);
    EXPECT_EQ(a.failure, b.failure);
    ASSERT_EQ(a.results.size(), b.results.size());
    for (std::size_t k = 0; k < a.results.size(); ++k) testing::expect_same_case(a.results[k], b.results[k]);
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    for (std::size_t k = 0; k < a.surfaces.size(); ++k) testing::expect_same_surface(a.surfaces[k], b.surfaces[k]);
  }
  EXPECT_THROW(io::read_hdf5(path), Error);
}

TEST(ComparisonStore, FilesOfRunsAreRefused) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "fields.h5";
  io::write_hdf5(path, testing::sample_run());
  EXPECT_THROW(io::read_comparison_fields(path), Error);
}

}  // namespace
}  // namespace treadmark
