// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as a JSON file of results, every value of which is asked for.
#include "treadmark/core/error.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/temporary_file.hpp"

namespace {

/// Whether asking ends without an Error.
template <class Ask>
bool answers(Ask ask) {
  try {
    ask();
    return true;
  } catch (const treadmark::Error&) {
    return false;
  }
}

void ask_all(const treadmark::io::JsonTree& tree) {
  answers([&] { tree.number(); });
  answers([&] { tree.count(); });
  answers([&] { tree.integer(); });
  answers([&] { tree.text(); });
  answers([&] { tree.flag(); });
  answers([&] { tree.numbers(); });
  answers([&] { tree.texts(); });
  answers([&] { tree.one_of({"wheel", "rail"}); });
  answers([&] {
    for (const auto& item : tree.items()) ask_all(item);
  });
  answers([&] {
    for (const auto& [key, item] : tree.entries()) ask_all(item);
  });
}

}  // namespace

TREADMARK_FUZZ_TARGET(fuzz_json) {
  static const treadmark::fuzz::TemporaryFile file("fuzz_json", ".json");
  const auto& path = file.hold(treadmark::fuzz::as_text(data, size));
  answers([&] { ask_all(treadmark::io::read_json_file(path)); });
  return 0;
}
