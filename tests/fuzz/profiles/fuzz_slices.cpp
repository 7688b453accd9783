// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <string_view>

#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

namespace {

/// Every slice is the same short straight profile: the files that a set names are fuzzed by themselves.
treadmark::SliceSet parse(std::string_view text, treadmark::Body body) {
  return treadmark::io::parse_slices(text, "fuzz", body,
                                     [&](const std::string& name, const treadmark::SourcePosition&) {
                                       treadmark::Profile profile;
                                       profile.body = body;
                                       profile.y = {-0.02, 0.02};
                                       profile.z = {0.0, 0.0};
                                       profile.name = name;
                                       return profile;
                                     });
}

}  // namespace

TREADMARK_FUZZ_TARGET(fuzz_slices) {
  const std::string_view text = treadmark::fuzz::as_text(data, size);
  for (const treadmark::Body body : {treadmark::Body::rail, treadmark::Body::wheel}) {
    try {
      parse(text, body);
    } catch (const treadmark::Error&) {
    }
  }
  return 0;
}
