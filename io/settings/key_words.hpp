// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/io/settings/key_list.hpp"

namespace treadmark::io {

/// A key as people read it: "wheelset.vertical_force_N" is "wheelset: vertical force" in "N", "cant_deg" "cant" in "°".
struct KeyWords {
  std::string name, unit;
};
KeyWords words_of_key(std::string_view path);

/// Names and values with their units, as people read them.
using Inputs = std::vector<std::pair<std::string, std::string>>;

/// What a key was given, TOML texts, each once; of keys that exclude each other the one with fewer letters is kept.
/// Thread-compatible.
class InputList {
 public:
  void add(const KeyInfo& key, const std::string& path, const std::vector<std::string>& values);
  Inputs words() const;

 private:
  struct Input {
    std::string path, group, alternative;
    std::vector<std::string> values;
    std::size_t length = 0;
  };
  std::vector<Input> inputs_;
};

/// The value as a file writes it, as TOML; empty where there is none.
template <class Root>
std::string value_of(const SettingKey<Root>& key, const Root& root, const std::filesystem::path& folder) {
  return key.written ? key.written(root, folder) : key.text ? key.text(root) : std::string();
}

}  // namespace treadmark::io
