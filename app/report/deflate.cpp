// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/deflate.hpp"

#include <zlib.h>

#include "treadmark/core/error.hpp"

namespace treadmark::app::report {

std::vector<std::byte> deflated(std::span<const std::byte> bytes) {
  constexpr int kLevel = 9;
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::byte> out(size);
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), kLevel);
  if (status != Z_OK) throw Error(ErrorKind::numerical, "the data of the report could not be compressed");
  out.resize(size);
  return out;
}

}  // namespace treadmark::app::report
