// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/read_limits.hpp"

#include <fmt/format.h>

#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/settings/toml_value.hpp"
#include "treadmark/io/simulations/limit_keys.hpp"
#include "treadmark/io/simulations/table_of.hpp"

namespace treadmark::io {

RunningLimits parse_limits_text(std::string_view text, const std::string& name) {
  const CaseTable tables = parse_toml(text, name);
  const TableOf document(tables, {name, 1, 1}, "", limit_file_keys());
  RunningLimits out = document.read();
  document.need(&RunningLimits::limits);
  using L = RunningLimit;
  for (const CaseValue* one : document.tables(&RunningLimits::limits)) {
    const TableOf table(*one, document.path_of(&RunningLimits::limits), limit_keys());
    L& limit = out.limits.emplace_back(table.read());
    limit.where = table.where();
    if (!(limit.constant > 0.0) && !(limit.by_load > 0.0) && !(limit.by_curvature > 0.0))
      table.fail(fmt::format("the limit of {} is nowhere positive", limit.quantity),
                 "give value, by_load or by_curvature");
    if (limit.to_radius && !(*limit.to_radius > limit.from_radius))
      table.refuse(&L::to_radius,
                   fmt::format("no radius lies from {:.6g} to {:.6g} m", limit.from_radius, *limit.to_radius));
  }
  return out;
}

RunningLimits read_limits_file(const std::filesystem::path& file) {
  return parse_limits_text(read_text(file), file.string());
}

}  // namespace treadmark::io
