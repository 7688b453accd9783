// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/results/quantities.hpp"

namespace treadmark::io {

template <class T>
void read_rows(const Hdf5GroupReader& group, std::span<const Quantity<T>> rows, T& item) {
  const auto& [get, put, has, whole] = rows.front().access;
  const std::string name(rows.front().stored.name);
  if (rows.front().stored.component < 0) {
    put(item, whole ? group.integer(name) : group.number(name));
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

/// The same where the group has the first attribute of the block; temperatures are known each for itself.
template <class T>
void read_block_if_there(const Hdf5GroupReader& group, Block block, T& item) {
  bool first = true, there = false;
  for_each_stored<T>(block, [&](auto rows) {
    if (first || block == Block::heat) there = group.has_attribute(std::string(rows.front().stored.name));
    first = false;
    if (there) read_rows<T>(group, rows, item);
  });
  if (const auto flag = flag_of<T>(block); flag != nullptr && there) item.*flag = true;
}

}  // namespace treadmark::io
