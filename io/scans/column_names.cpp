// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>

#include "treadmark/io/scans/column_layout.hpp"
#include "treadmark/io/scans/unit_words.hpp"

namespace treadmark::io::scans {

namespace {

struct Known {
  std::string_view name;  ///< small letters and digits only
  int value;
  bool loose = false;
};

constexpr Known kKnown[] = {{"x", 0},
                            {"xcoord", 0},
                            {"xcoordinate", 0},
                            {"coordx", 0},
                            {"xpos", 0},
                            {"posx", 0},
                            {"pointx", 0},
                            {"points0", 0},
                            {"y", 1},
                            {"ycoord", 1},
                            {"ycoordinate", 1},
                            {"coordy", 1},
                            {"ypos", 1},
                            {"posy", 1},
                            {"pointy", 1},
                            {"points1", 1},
                            {"z", 2},
                            {"zcoord", 2},
                            {"zcoordinate", 2},
                            {"coordz", 2},
                            {"zpos", 2},
                            {"posz", 2},
                            {"pointz", 2},
                            {"points2", 2},
                            {"nx", 3},
                            {"normalx", 3},
                            {"xnormal", 3},
                            {"normals0", 3},
                            {"ny", 4},
                            {"normaly", 4},
                            {"ynormal", 4},
                            {"normals1", 4},
                            {"nz", 5},
                            {"normalz", 5},
                            {"znormal", 5},
                            {"normals2", 5},
                            {"pass", 6},
                            {"passid", 6},
                            {"passno", 6},
                            {"passnumber", 6},
                            {"scan", 6},
                            {"scanid", 6},
                            {"scanno", 6},
                            {"scannumber", 6},
                            {"pointsourceid", 6},
                            {"line", 6, true},
                            {"lineid", 6, true},
                            {"lineno", 6, true},
                            {"linenumber", 6, true}};

}  // namespace

ColumnNames find_names(const std::vector<std::string>& names) {
  ColumnNames result;
  result.value.assign(names.size(), -1);
  std::array<int, ColumnLayout::kValues> count{};
  UnitFinder unit;
  int pass_column = -1;
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::string_view name = names[k];
    const std::optional<LengthUnit> own_unit = take_unit(name);
    std::string plain = profiles::lower(name);
    std::erase_if(plain, [](char c) { return !((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')); });
    const auto known =
        std::find_if(std::begin(kKnown), std::end(kKnown), [&](const Known& n) { return n.name == plain; });
    if (known == std::end(kKnown)) continue;
    if (known->value == ColumnLayout::kPass) {
      // the first that is certain counts, else the first that may be
      if (pass_column >= 0 && !(result.loose_pass && !known->loose)) continue;
      if (pass_column >= 0) result.value[static_cast<std::size_t>(pass_column)] = -1;
      pass_column = static_cast<int>(k);
      result.loose_pass = known->loose;
      ++result.passes;
    } else if (++count[static_cast<std::size_t>(known->value)] > 1) {
      result.twice = true;
    }
    result.value[k] = known->value;
    if (known->value < 3) unit.add(own_unit);
  }
  result.has_xyz = count[0] > 0 && count[1] > 0 && count[2] > 0;
  result.has_normals = count[3] > 0 && count[4] > 0 && count[5] > 0;
  if (!result.has_normals)
    for (int& v : result.value)
      if (v >= 3 && v < ColumnLayout::kPass) v = -1;
  result.unit = unit.unit();
  result.units_differ = unit.differ();
  return result;
}

std::vector<std::string> names_in(std::string_view line, char separator) {
  std::vector<std::string> names;
  bool open = false;
  for (const Field& field : fields_of(line, separator)) {
    std::string_view text = field.text;
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    const bool goes_on = separator == ' ' && !names.empty() && (open || text.starts_with('[') || text.starts_with('('));
    if (goes_on)
      names.back().append(" ").append(text);
    else
      names.emplace_back(text);
    open = (open || text.find_first_of("[(") != std::string_view::npos) &&
           text.find_first_of("])") == std::string_view::npos;
  }
  return names;
}

}  // namespace treadmark::io::scans
