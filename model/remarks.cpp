// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/remarks.hpp"

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {

std::optional<RemarkKind> remark_named(std::string_view name) {
  for (const RemarkRow& row : kRemarkRows)
    if (row.name == name) return row.kind;
  return std::nullopt;
}

bool any_grave(std::span<const Remark> remarks) {
  return ranges::any_of(remarks, [](const Remark& r) { return r.grave(); });
}

std::string with_grave(std::string message, std::span<const Remark> remarks) {
  for (const Remark& remark : remarks)
    if (remark.grave()) message += (message.empty() ? "" : "; ") + remark.text;
  return message;
}

std::string to_line(const Remark& remark) {
  return fmt::format("{}: {}{}", remark.grave() ? "warning" : "minor warning",
                     remark.patch > 0 ? fmt::format("patch {}: ", remark.patch) : "", remark.text);
}

}  // namespace treadmark
