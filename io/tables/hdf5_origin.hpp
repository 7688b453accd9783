// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/model/origin.hpp"

namespace treadmark::io {

using Pairs = std::vector<std::pair<std::string, std::string>>;

inline void add_pairs(std::vector<Attribute>& list, const Pairs& pairs, const char* firsts, const char* seconds) {
  std::vector<std::string> first, second;
  for (const auto& [one, other] : pairs) {
    first.push_back(one);
    second.push_back(other);
  }
  list.push_back({firsts, first});
  list.push_back({seconds, second});
}

/// None where there is no such attribute.
inline Pairs read_pairs(const Hdf5GroupReader& root, const char* firsts, const char* seconds) {
  Pairs pairs;
  if (!root.has_attribute(firsts)) return pairs;
  const std::vector<std::string> first = root.texts(firsts), second = root.texts(seconds);
  if (first.size() != second.size())
    throw Error(ErrorKind::input_data, std::string("there are more or fewer ") + firsts + " than " + seconds,
                {root.file(), 0, 0});
  for (std::size_t i = 0; i < first.size(); ++i) pairs.emplace_back(first[i], second[i]);
  return pairs;
}

/// What stores say at their top: format, and what the result comes from.
inline std::vector<Attribute> origin_attributes(const char* format, const Origin& origin) {
  std::vector<Attribute> list{{"format", std::string(format)}, {"units", "SI"},
                              {"version", origin.version},     {"git", origin.git},
                              {"input", origin.input_file},    {"sha256", origin.input_sha256},
                              {"title", origin.title},         {"settings", origin.settings}};
  add_pairs(list, origin.geometry_sha256, "geometry_files", "geometry_sha256");
  add_pairs(list, origin.inputs, "input_names", "input_values");
  return list;
}

inline void read_origin(const Hdf5GroupReader& root, Origin& origin) {
  origin.version = root.text("version");
  origin.git = root.text("git");
  origin.input_file = root.text("input");
  origin.input_sha256 = root.text("sha256");
  if (root.has_attribute("title")) origin.title = root.text("title");
  origin.settings = root.texts("settings");
  origin.geometry_sha256 = read_pairs(root, "geometry_files", "geometry_sha256");
  origin.inputs = read_pairs(root, "input_names", "input_values");
}

}  // namespace treadmark::io
