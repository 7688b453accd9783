// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "treadmark/backends/offset/file.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"
#include "treadmark/tests/fuzz/offset/sound_offsets.hpp"
#include "treadmark/tests/fuzz/temporary_file.hpp"

namespace {

/// A sound file with one block: nodes are large and nearly all zeros, so the bytes are edits of it.
const std::string& sound_file() {
  static const std::string bytes = [] {
    const treadmark::fuzz::TemporaryFile file("fuzz_nvdb_sound", ".nvdb");
    const auto offsets = std::make_shared<treadmark::offset::SparseOffsets>();
    treadmark::offset::Block block{};
    block[5] = 1e-5f;
    offsets->frame.du = offsets->frame.dy = 1e-3;
    offsets->grid.insert({0, 0}, block, 0.0f);
    treadmark::SurfaceSpec base;
    base.shape = treadmark::StandardProfile{"60E1"};
    base.body = treadmark::Body::rail;
    treadmark::offset::write_vdb(file.path(), {offsets, base});
    std::ifstream in(file.path(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }();
  return bytes;
}

}  // namespace

/// Six bytes an edit: a place, three of them, and what is put there; the check sum fits.
TREADMARK_FUZZ_TARGET(fuzz_nvdb) {
  constexpr std::size_t kEdit = 6, kSumAt = 224 + 664;
  static const treadmark::fuzz::TemporaryFile file("fuzz_nvdb", ".nvdb");
  std::string bytes = sound_file();
  for (; size >= kEdit; data += kEdit, size -= kEdit) {
    const std::size_t at = data[0] | data[1] << 8 | data[2] << 16;
    for (std::size_t k = 0; k < 3; ++k) bytes[(at + k) % bytes.size()] = static_cast<char>(data[3 + k]);
  }
  bytes.replace(kSumAt, 8, 8, '\0');
  const std::uint64_t sum = treadmark::offset::sum_of(bytes.data(), bytes.size());
  std::memcpy(bytes.data() + kSumAt, &sum, sizeof(sum));
  try {
    treadmark::fuzz::require_sound(treadmark::offset::read_vdb(file.hold(bytes)));
  } catch (const treadmark::Error&) {
  }
  return 0;
}
