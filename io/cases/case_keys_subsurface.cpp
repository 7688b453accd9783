// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include "treadmark/io/cases/element_keys.hpp"

namespace treadmark::io {

namespace {

using Block = SubsurfaceInput::Block;

/// Columns or rows of elements, counted from 0.
ElementKey<Block> element_indices(const std::string& name, std::string doc, std::vector<int> Block::*member) {
  constexpr double kMost = 4e6;
  KeyInfo info = key_info(name, KeyType::number_list, std::move(doc));
  info.at_least = 0.0;
  info.at_most = kMost;
  info.group = "subsurface points";
  info.alternative = "elements";
  return {info, [name, member](Block& b, const CaseValue& v) {
            std::vector<int> list;
            for (const CaseValue& one : v.list()) {
              if (one.number() != std::floor(one.number()))
                throw Error(ErrorKind::configuration, name + " must be a list of integers", one.where);
              list.push_back(static_cast<int>(one.number()));
            }
            b.*member = std::move(list);
          }};
}

ElementKey<Block> element_lengths(const std::string& name, std::string doc, std::vector<double> Block::*member,
                                  bool free) {
  KeyInfo info = key_info(name, KeyType::number_list, std::move(doc));
  if (free) {
    info.group = "subsurface points";
    info.alternative = "free";
  }
  return {info, [member, free, unit = unit_of_key(name)](Block& b, const CaseValue& v) {
            b.*member = numbers_of(v, unit);
            if (free) b.at_elements = false;
          }};
}

SubsurfaceInput& subsurface(Case& c) {
  return std::visit([](auto& content) -> SubsurfaceInput& { return content.subsurface; }, c.content);
}

}  // namespace

void add_subsurface_keys(KeyList& list) {
  std::vector<ElementKey<Block>> keys{
      element_indices("columns", "under the elements of these columns, counted from 0; without it of all",
                      &Block::columns),
      element_indices("rows", "under the elements of these rows, counted from 0; without it of all", &Block::rows),
      element_lengths("x_mm", "free points instead: their x; with y_mm a grid", &Block::x, true),
      element_lengths("y_mm", "free points instead: their y", &Block::y, true),
      required(element_lengths("z_mm", "depths, positive in body 1, negative in body 2", &Block::z, false))};
  KeyInfo blocks = key_info("subsurface.blocks", KeyType::table_list,
                            "grids of points at which stresses below the surface are computed");
  add_list<Block, Case>(list, std::move(blocks), std::move(keys), [](Case& c, bool) { return &subsurface(c).blocks; });

  KeyInfo table = key_info("subsurface.text_table", KeyType::choice,
                           "text table of them (.subs): none, stress invariants, or all stresses too");
  table.choices = {"none", "invariants", "tensor"};
  table.default_text = "\"none\"";
  list.add(table).set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    SubsurfaceInput& s = subsurface(c);
    s.text_table = v.text() != "none";
    s.full_tensor = v.text() == "tensor";
  };
}

}  // namespace treadmark::io
