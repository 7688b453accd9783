// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slice_kinks.hpp"

#include <string>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::spline {

std::vector<SliceSet> split_at_kinks(const SliceSet& slices) {
  if (slices.kinks.empty()) return {slices};
  const int last = slices.features.empty() ? 0 : static_cast<int>(slices.features.front().size()) - 1;
  std::vector<SliceSet> parts;
  int from = 0;
  const auto add_until = [&](int to) {
    SliceSet part = slices;
    part.kinks.clear();
    for (auto& row : part.features) {
      if (static_cast<int>(row.size()) != last + 1)
        throw Error(ErrorKind::input_data, "the slices of '" + slices.name + "' have different numbers of features");
      row = {row.begin() + from, row.begin() + to + 1};
    }
    parts.push_back(std::move(part));
    from = to;
  };
  for (const int kink : slices.kinks) {
    if (kink <= from || kink >= last)
      throw Error(ErrorKind::input_data, "the kinks of '" + slices.name + "' must be increasing inner features, " +
                                             std::to_string(kink) + " is not");
    add_until(kink);
  }
  add_until(last);
  return parts;
}

}  // namespace treadmark::spline
