// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/report/page_reader.hpp"

#include <stdexcept>

namespace treadmark::testing {
namespace {

using namespace report;

/// The first block of a kind that a test accepts; nullptr without one.
template <class Kind, class Test>
const Kind* find(const Page& page, const Test& test) {
  for (const Section& section : page.sections)
    for (const Block& block : section.blocks)
      if (const auto* found = std::get_if<Kind>(&block); found != nullptr && test(*found)) return found;
  return nullptr;
}

std::size_t column_of(const Table& table, const std::string& label) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (table.columns[i].label == label) return i;
  throw std::runtime_error("the table " + table.id + " has no column " + label);
}

}  // namespace

const Table& table_of(const Page& page, const std::string& id) {
  if (const auto* table = find<Table>(page, [&](const Table& t) { return t.id == id; })) return *table;
  throw std::runtime_error("no table " + id);
}

const Figure& figure_of(const Page& page, const std::string& id) {
  if (const auto* figure = find<Figure>(page, [&](const Figure& f) { return f.id == id; })) return *figure;
  throw std::runtime_error("no figure " + id);
}

bool has_figure(const Page& page, const std::string& id) {
  return find<Figure>(page, [&](const Figure& f) { return f.id == id; }) != nullptr;
}

std::vector<std::string> section_ids(const Page& page) {
  std::vector<std::string> out;
  for (const Section& section : page.sections) out.push_back(section.id);
  return out;
}

std::string fact_of(const Page& page, const std::string& label) {
  std::string value = "no fact " + label;
  find<Facts>(page, [&](const Facts& facts) {
    for (const auto& [name, text] : facts.entries)
      if (name == label) value = text;
    return false;
  });
  return value;
}

std::string card_of(const Page& page, const std::string& label) {
  std::string value = "no card " + label;
  find<Cards>(page, [&](const Cards& cards) {
    for (const auto& card : cards.cards)
      if (card.label == label) value = card.value + " | " + card.note;
    return false;
  });
  return value;
}

std::string banners_of(const Page& page) {
  std::string out;
  find<Banner>(page, [&](const Banner& banner) {
    out += banner.kind == Banner::Kind::failed    ? "failed: "
           : banner.kind == Banner::Kind::warning ? "warning: "
                                                  : "note: ";
    out += banner.heading + " " + banner.text + "\n";
    return false;
  });
  return out;
}

std::vector<double> numbers_in(const Table& table, const std::string& column) {
  std::vector<double> out;
  for (const Table::Row& row : table.rows)
    out.push_back(std::get<Number>(row.cells.at(column_of(table, column))).value);
  return out;
}

std::vector<std::string> texts_in(const Table& table, const std::string& column) {
  std::vector<std::string> out;
  for (const Table::Row& row : table.rows) out.push_back(std::get<std::string>(row.cells.at(column_of(table, column))));
  return out;
}

}  // namespace treadmark::testing
