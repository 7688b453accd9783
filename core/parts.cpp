// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"

#include <stdexcept>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

const Part& part_of(std::string_view key) {
  const auto all = parts();
  const auto found = ranges::find(all, key, &Part::key);
  if (found == all.end()) throw std::invalid_argument("no part of Treadmark: " + std::string(key));
  return *found;
}

}  // namespace

bool has_part(std::string_view key) { return part_of(key).built; }

std::string left_out_message(std::string_view key, std::string_view what) {
  return "this build leaves out " + std::string(what) + " (" + std::string(part_of(key).name) + ")";
}

std::string left_out_advice(std::string_view key) {
  const Part& part = part_of(key);
  std::string text = "configure with -D" + std::string(part.option) + "=ON";
  if (!part.packages.empty()) text += ", Debian package " + std::string(part.packages);
  return text;
}

void left_out(std::string_view key, std::string_view what) {
  throw Error(ErrorKind::configuration, left_out_message(key, what), {}, left_out_advice(key));
}

void require_part(std::string_view key, std::string_view what) {
  if (!has_part(key)) left_out(key, what);
}

}  // namespace treadmark
