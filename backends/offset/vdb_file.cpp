// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/vdb_file.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/check_point.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/helper_process.hpp"

namespace treadmark::offset {

namespace {

void require(bool sense) {
  if (!sense) throw Broken{};
}

}  // namespace

std::string shortened(std::string text, std::size_t most) {
  if (text.size() > most) text.replace(most, std::string::npos, "...");
  return text;
}

std::string title_of(const VdbGrid& grid) { return '\'' + shortened(grid.name) + '\''; }

std::string kind_of(const VdbGrid& grid) {
  const auto given = grid.metadata.find("class");
  return given == grid.metadata.end() ? std::string() : given->second;
}

std::string what_is(const VdbGrid& grid) {
  const std::string kind = kind_of(grid);
  if (kind == "level set")
    return "a level set " + title_of(grid) + " (distances from a surface: cases take it in shape.solids)";
  if (kind == "fog volume") return "a fog volume " + title_of(grid) + " (densities in space: make triangles of it)";
  return "a grid " + title_of(grid) + " without the entries that say over which base its values lie";
}

void VdbFile::refuse(const std::string& why, const std::string& advice) const {
  throw Error(ErrorKind::input_data, why, {file_}, advice);
}

void VdbFile::refuse_far() const {
  refuse(fmt::format("{} lie too far from the origin of their grid", words_->values));
}

template <class Talk>
void VdbFile::ask(Talk talk) {
  talk_to(channel_, talk, [this] {
    return Error(ErrorKind::input_data, "OpenVDB broke down over the VDB file", {file_},
                 "is it damaged? write or copy it again");
  });
}

VdbFile::VdbFile(std::unique_ptr<Channel> channel, const std::filesystem::path& file, std::uint64_t size,
                 const VdbWords& words)
    : channel_(std::move(channel)), file_(file.string()), words_(&words) {
  // A leaf has 2 kB, of which at least two masks of 64 bytes stand in the file; texts stand there as they are.
  constexpr std::uint64_t kPerByte = 20, kAlways = 1 << 20;
  std::string fault;
  ask([&](Channel& c) {
    c.allow(kAlways + kPerByte * size);
    c.put(VdbTask::read);
    c.put_list(file_);
    c.put(size);
    fault = c.take_list<std::string>();
    if (!fault.empty()) return;
    for (auto left = c.take<std::int64_t>(); left > 0; --left) grids_.push_back(take_grid(c));
  });
  constexpr std::size_t kMostSaid = 120;
  if (!fault.empty()) refuse("the VDB file cannot be read: " + shortened(std::move(fault), kMostSaid));
  if (grids_.empty()) refuse("the VDB file holds no grid");
}

VdbContent VdbFile::content(std::size_t number) {
  const VdbGrid& grid = grids_[number];
  if (grid.type != "Tree_float_5_4_3" && grid.type != "Tree_double_5_4_3")
    refuse(fmt::format("{} of a VDB file must be single, half or double precision numbers, not {}", words_->values,
                       shortened(grid.type)));
  if (grid.linear == 0) refuse(fmt::format("the transform of {} must be linear", words_->values));
  VdbContent out;
  bool tiles = false;
  ask([&](Channel& c) {
    c.put(static_cast<std::int64_t>(number));
    out.background = c.take<float>();
    tiles = c.take<std::int64_t>() != 0;
    out.leaves = c.take_list<std::vector<VdbLeaf>>();
    std::vector<std::array<std::int32_t, 3>> places;
    for (const VdbLeaf& leaf : out.leaves) {
      for (const std::int32_t x : leaf.first) require(x % 8 == 0);
      places.push_back(leaf.first);
    }
    sort_many(places);
    require(std::adjacent_find(places.begin(), places.end()) == places.end());
  });
  channel_.reset();
  if (tiles) refuse(fmt::format("{} must not contain tiles", words_->values));
  for (const VdbLeaf& leaf : out.leaves)
    for (const std::int32_t x : leaf.first)
      if (x < -kFarthest || x > kFarthest) refuse_far();
  return out;
}

}  // namespace treadmark::offset
