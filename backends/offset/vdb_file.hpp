// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/backends/offset/vdb_messages.hpp"

namespace treadmark::offset {

/// Starts the program that holds OpenVDB, treadmark-openvdb. file: for messages; longest_silence [s]. Errors: those of
/// start_helper; Error(configuration) where the part is left out.
std::unique_ptr<Channel> start_openvdb(const std::string& file, int longest_silence = 120);

/// What a reader calls the values that it looks for, and where such files come from: for messages.
struct VdbWords {
  const char *values, *advice;
};

/// What is on the voxels of a grid.
struct VdbContent {
  float background = 0.0f;
  std::vector<VdbLeaf> leaves;  ///< no place twice
};

/// A VDB file that OpenVDB's own reader has read, in a process of its own. Takes some 20 times the size of the file at
/// most. One thread. Errors of all: Error(input_data) where OpenVDB cannot read the file, or breaks down over it.
/// Cancelled within a tenth of a second.
class VdbFile {
 public:
  static constexpr int kFarthest = 1 << 29;  ///< voxels from the origin

  /// size: of the VDB data in the file [bytes]. words must outlive it.
  VdbFile(std::unique_ptr<Channel> channel, const std::filesystem::path& file, std::uint64_t size,
          const VdbWords& words);

  /// At least one, in their order.
  const std::vector<VdbGrid>& grids() const { return grids_; }

  /// Of one grid, once. Errors also: a grid of other numbers, one that is bent or far away, active tiles.
  VdbContent content(std::size_t number);

  [[noreturn]] void refuse(const std::string& why, const std::string& advice) const;
  [[noreturn]] void refuse(const std::string& why) const { refuse(why, words_->advice); }
  [[noreturn]] void refuse_far() const;

 private:
  template <class Talk>
  void ask(Talk talk);

  std::unique_ptr<Channel> channel_;
  std::string file_;
  const VdbWords* words_;
  std::vector<VdbGrid> grids_;
};

/// Errors also: Error(input_data) for a file that is missing, empty, no VDB file, or damaged since write_vdb wrote it.
VdbFile open_vdb(const std::filesystem::path& file, const VdbWords& words);

/// Its name in quotes, shortened, for a message.
std::string title_of(const VdbGrid& grid);
/// What it calls itself, "level set"; empty: nothing.
std::string kind_of(const VdbGrid& grid);
/// A grid that is none of those wanted, in words.
std::string what_is(const VdbGrid& grid);
/// The beginning of a text, which may be long, for a message.
std::string shortened(std::string text, std::size_t most = 30);

/// visit(index of a voxel) for each active voxel.
template <class Visit>
void for_each_active(const VdbLeaf& leaf, Visit visit) {
  for (unsigned word = 0; word < leaf.active.size(); ++word)
    for (std::uint64_t rest = leaf.active[word]; rest != 0; rest &= rest - 1)
      visit(64 * word + static_cast<unsigned>(std::countr_zero(rest)));
}

}  // namespace treadmark::offset
