// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/lzf.hpp"

#include <cstdint>
#include <cstring>

namespace treadmark::io::scans {

// A control byte below 32 says how many bytes less one follow as they are. Else its upper three bits are the length
// less two of a copy (7: add the next byte), its lower five and the next byte how far back less one it begins.
bool unpack_lzf(std::string_view packed, std::string& out) {
  std::size_t at = 0, done = 0;
  const auto next = [&] { return static_cast<std::uint8_t>(packed[at++]); };
  while (at < packed.size()) {
    const unsigned control = next();
    if (control < 32) {
      const std::size_t count = control + 1;
      if (count > packed.size() - at || count > out.size() - done) return false;
      std::memcpy(out.data() + done, packed.data() + at, count);
      at += count;
      done += count;
      continue;
    }
    std::size_t count = control >> 5;
    if (packed.size() - at < (count == 7 ? 2u : 1u)) return false;
    if (count == 7) count += next();
    const std::size_t back = ((control & 31u) << 8 | next()) + 1u;
    count += 2;
    if (back > done || count > out.size() - done) return false;
    // source and target may overlap: then the copy repeats itself
    for (std::size_t k = 0; k < count; ++k, ++done) out[done] = out[done - back];
  }
  return done == out.size();
}

}  // namespace treadmark::io::scans
