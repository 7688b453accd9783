// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"

namespace treadmark::io {

namespace {

constexpr long kMostPlanes = 100000;
constexpr long kMostColumns = 4000000;

class BlockReader {
 public:
  explicit BlockReader(ContactText& text) : text_(text) {}

  SubsurfaceInput::Block read(long kind) {
    SubsurfaceInput::Block block;
    block.at_elements = kind != 9;
    if (kind == 2 || kind == 6) {
      block.columns = range("IXL", "IXINC", "IXH");
      block.rows = range("IYL", "IYINC", "IYH");
    } else if (kind == 3 || kind == 7) {
      text_.begin_record("the line NX");
      const long nx = count("NX"), ny = count("NY");
      block.columns = indices("IX", nx);
      block.rows = indices("IY", ny);
    } else if (kind == 9) {
      text_.begin_record("the line NX");
      const long nx = count("NX"), ny = count("NY"), nz = count("NZ");
      block.x = lengths("X", nx);
      block.y = lengths("Y", ny);
      block.z = lengths("Z", nz);
    }
    if (kind <= 3) {
      block.z = planes();
    } else if (kind <= 7) {
      text_.begin_record("the line NZ");
      block.z = lengths("Z", count("NZ"));
    }
    return block;
  }

 private:
  long count(std::string_view name) {
    const long value = text_.integer(name);
    if (value < 1) text_.fail(fmt::format("{} must be positive", name));
    return value;
  }

  /// Element numbers count from 1 in the file.
  int index(std::string_view name) {
    const long value = text_.integer(name);
    if (value < 1 || value > kMostColumns)
      text_.fail(fmt::format("{} = {} is not the number of a column or row", name, value));
    return static_cast<int>(value - 1);
  }

  std::vector<int> range(std::string_view first_name, std::string_view step_name, std::string_view last_name) {
    text_.begin_record(fmt::format("the line {}", first_name));
    const int first = index(first_name);
    const long step = std::min(count(step_name), kMostColumns);
    const int last = index(last_name);
    if (last < first) text_.fail(fmt::format("{} must not be less than {}", last_name, first_name));
    std::vector<int> list;
    for (long i = first; i <= last; i += step) list.push_back(static_cast<int>(i));
    return list;
  }

  std::vector<int> indices(std::string_view name, long count) {
    text_.begin_record(name);
    std::vector<int> list;
    for (long i = 0; i < count; ++i) list.push_back(index(name));
    return list;
  }

  std::vector<double> lengths(std::string_view name, long count) {
    text_.begin_record(name);
    std::vector<double> list;
    for (long i = 0; i < count; ++i) list.push_back(text_.real(name) * kMillimetre);
    return list;
  }

  std::vector<double> planes() {
    text_.begin_record("the line NZ");
    const long number = count("NZ");
    if (number > kMostPlanes) text_.fail(fmt::format("NZ = {} is more than {}", number, kMostPlanes));
    const double first = text_.real("ZL") * kMillimetre, step = text_.real("DZ") * kMillimetre;
    std::vector<double> list;
    for (long i = 0; i < number; ++i) list.push_back(first + static_cast<double>(i) * step);
    return list;
  }

  ContactText& text_;
};

}  // namespace

void ContactReader::read_subsurface() {
  const int stress = (*problem)["STRESS"];
  if (stress < 2) return;
  text.begin_record("the subsurface output line");
  const long table = text.integer("MATFIL");
  if (table < 0 || table > 2)
    text.fail(fmt::format("MATFIL = {} of the subsurface output does not exist: expected 0, 1 or 2", table));
  kept.subsurface.text_table = table >= 1;
  kept.subsurface.full_tensor = table == 2;
  text.integer("OUTPUT");
  if (stress < 3) return;
  std::vector<SubsurfaceInput::Block> blocks;
  while (true) {
    text.begin_record("the subsurface block ISUBS");
    const long kind = text.integer("ISUBS");
    if (kind == 0) break;
    if (!(kind >= 1 && kind <= 3) && !(kind >= 5 && kind <= 7) && kind != 9)
      text.fail(fmt::format("ISUBS = {} does not exist", kind));
    blocks.push_back(BlockReader(text).read(kind));
  }
  kept.subsurface.blocks = std::move(blocks);
}

SubsurfaceInput ContactReader::effective_subsurface() const {
  if ((*problem)["STRESS"] == 0) return {};
  if (kept.subsurface.blocks.empty())
    fail_at(*problem, "STRESS", "uses subsurface points of an earlier case, but there are none",
            "use S = 3 and give blocks of points");
  return kept.subsurface;
}

}  // namespace treadmark::io
