// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/results/quantities.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// The run in a file of write_hdf5, as far as that writes it: run, cases in the order of their numbers, patches with
/// fields and blocks below the surface, sampled surfaces. Not in such files, and left as they are in an empty result:
/// times of the parts of a solution, force iterations, the list of representations, what asks for text files, and
/// sensitivities. What older files lack stays empty, too. Errors: Error(input_data) for files of another kind or
/// version, that are cut off or whose parts do not fit together.
/// Not to be called from two threads at once.
RunResult read_hdf5(const std::filesystem::path& path);

/// All groups case_0001 ... below a group, of any file that holds such groups. Errors as above, here and below.
std::vector<CaseResult> read_cases(const Hdf5GroupReader& parent);
/// One of them.
CaseResult read_case(const Hdf5GroupReader& group);
/// The surfaces below a group.
std::vector<SampledSurface> read_surfaces(const Hdf5GroupReader& parent);

/// Throws Error(input_data) unless the file says that it holds this.
void require_format(const Hdf5GroupReader& root, const std::string& format);
/// Throws Error(input_data) unless all surfaces that cases name are there.
void check_surface_names(const Hdf5GroupReader& where, std::span<const CaseResult> cases,
                         std::span<const SampledSurface> surfaces);

/// Throws Error(input_data): the file is none of ours. what goes on from "the file of results ...".
[[noreturn]] void refuse_result(const Hdf5GroupReader& where, const std::string& what);

/// A patch with its fields and blocks from the group of a file of results. Errors: Error(input_data).
PatchResult read_patch(const Hdf5GroupReader& group);

/// Loads of a case or patch; none where they are not known. Errors: Error(input_data).
std::optional<Loads> read_loads(const Hdf5GroupReader& group);

/// One value, or the components of a vector, from the attribute that these rows share. Errors: Error(input_data).
template <class T>
void read_rows(const Hdf5GroupReader& group, std::span<const Quantity<T>> rows, T& item) {
  const Access<T>& access = rows.front().access;
  const std::string name(rows.front().stored.name);
  if (rows.front().stored.component < 0) {
    access.put(item, access.whole ? group.integer(name) : group.number(name));
    return;
  }
  const Vec3 vector = group.vector(name);
  for (const Quantity<T>& row : rows) row.access.put(item, vector[row.stored.component]);
}

/// The rows of a block from the attributes of a group. Errors: Error(input_data), also where one is missing.
template <class T>
void read_block(const Hdf5GroupReader& group, Block block, T& item) {
  for_each_stored<T>(block, [&](auto rows) { read_rows<T>(group, rows, item); });
}

/// The same where the group has the first attribute of the block; temperatures and curvatures are known each for
/// itself.
template <class T>
void read_block_if_there(const Hdf5GroupReader& group, Block block, T& item) {
  bool first = true, there = false;
  for_each_stored<T>(block, [&](auto rows) {
    if (first || block == Block::heat || block == Block::shape || block == Block::refined)
      there = group.has_attribute(std::string(rows.front().stored.name));
    first = false;
    if (there) read_rows<T>(group, rows, item);
  });
  if (const auto flag = flag_of<T>(block); flag != nullptr && there) item.*flag = true;
}

/// Names in files of results that writer and reader share.
inline constexpr const char* kResultFormat = "treadmark result 1";
inline constexpr const char* kAxes = "x forward, y right, z down; forces and tractions act on the rail";
inline constexpr const char* kSurfaces = "surfaces";
inline constexpr const char* kSurfaceNames = "names";  // attribute of that group: its surfaces in their order

}  // namespace treadmark::io
