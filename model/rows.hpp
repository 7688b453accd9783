// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "treadmark/core/to_whole.hpp"

namespace treadmark {

/// A number of a result is one row of a table: files, terminal and pages walk the rows (io/tables/) and name no number
/// by themselves.

/// Significant digits of numbers in files: those of times, of measures of sections, of results, and all there are.
enum class Digits { six = 6, twelve = 12, all = 17 };

/// A unit of JSON, CSV and tables, and of SI, in which HDF5 has the number; "1": dimensionless.
struct FileUnit {
  std::string_view name = "1";
  double per_si = 1.0;  ///< so many are one of SI
  std::string_view si = name;
};

namespace unit {
inline constexpr FileUnit kOne, kN{"N"}, kJ{"J"}, kM{"m"}, kK{"K"}, kCelsius{"degC"}, kMm{"mm", 1e3, "m"},
    kKm{"km", 1e-3, "m"}, kMm3{"mm3", 1e9, "m3"}, kMPa{"MPa", 1e-6, "Pa"};
}  // namespace unit

/// How a number of a Row is reached, or a text.
template <class Row>
struct Access {
  double (*get)(const Row&) = nullptr;
  void (*put)(Row&, double) = nullptr;        ///< nullptr: follows from others
  bool (*has)(const Row&) = nullptr;          ///< nullptr: always known; NaN is null in JSON
  bool whole = false;                         ///< a whole number
  std::string (*word)(const Row&) = nullptr;  ///< a text in place of a number
  void (*put_word)(Row&, const std::string&) = nullptr;
  double (*uncertainty)(const Row&) = nullptr;  ///< of the number, in its unit; NaN, nullptr: not known
  std::string (*reason)(const Row&) = nullptr;  ///< why the number is not known
  bool flag = false;  ///< 0 or 1, in JSON false or true; of a text: null in JSON where it is empty
  /// Its derivatives by what was given are those along the tangent of the solution (wheelrail::PairNeighbours): get()
  /// of both neighbours, differenced.
  bool smooth = false;
};

namespace access {

template <class Member>
struct Parts;
template <class R, class V>
struct Parts<V R::*> {
  using Whole = R;
  using Value = V;
};
template <auto Member>
using WholeOf = typename Parts<decltype(Member)>::Whole;
template <auto Member>
using ValueOf = typename Parts<decltype(Member)>::Value;

/// A number as a member of a row keeps it.
template <class V>
constexpr V as_member(double v) {
  if constexpr (std::is_integral_v<V>)
    return to_whole<V>(v);
  else
    return static_cast<V>(v);
}

/// A text, a number, a count, or a number that may not be known.
template <auto Member>
constexpr Access<WholeOf<Member>> of() {
  using R = WholeOf<Member>;
  using V = ValueOf<Member>;
  if constexpr (std::is_same_v<V, std::string>)
    return {nullptr,
            nullptr,
            nullptr,
            false,
            [](const R& r) { return r.*Member; },
            [](R& r, const std::string& word) { r.*Member = word; }};
  else if constexpr (std::is_same_v<V, std::optional<double>>)
    return {[](const R& r) { return *(r.*Member); }, [](R& r, double v) { r.*Member = v; },
            [](const R& r) { return (r.*Member).has_value(); }};
  else
    return {[](const R& r) { return static_cast<double>(r.*Member); },
            [](R& r, double v) { r.*Member = as_member<V>(v); }, nullptr, std::is_integral_v<V>};
}

/// True or false in JSON.
template <auto Member>
constexpr Access<WholeOf<Member>> flag() {
  Access<WholeOf<Member>> access = of<Member>();
  access.whole = false, access.flag = true;
  return access;
}

/// A number that has derivatives by what was given.
template <class Row>
constexpr Access<Row> smooth(Access<Row> access) {
  access.smooth = true;
  return access;
}

/// A text that follows from others.
template <class Row>
constexpr Access<Row> word(std::string (*text)(const Row&)) {
  Access<Row> access;
  access.word = text;
  return access;
}

/// A text that is null in JSON where it is empty.
template <class Row>
constexpr Access<Row> word_or_null(std::string (*text)(const Row&)) {
  Access<Row> access = word(text);
  access.flag = true;
  return access;
}

/// A component of a vector.
template <auto Member, int I>
constexpr Access<WholeOf<Member>> part() {
  using R = WholeOf<Member>;
  return {[](const R& r) { return (r.*Member)[I]; }, [](R& r, double v) { (r.*Member)[I] = v; }};
}

/// A number of a member, or of one that may not be known.
template <auto Outer, auto Inner>
constexpr Access<WholeOf<Outer>> within() {
  using R = WholeOf<Outer>;
  using V = ValueOf<Inner>;
  if constexpr (std::is_same_v<ValueOf<Outer>, WholeOf<Inner>>)
    return {[](const R& r) { return static_cast<double>(r.*Outer.*Inner); },
            [](R& r, double v) { r.*Outer.*Inner = as_member<V>(v); }, nullptr, std::is_integral_v<V>};
  else
    return {[](const R& r) { return (*(r.*Outer)).*Inner; },
            [](R& r, double v) {
              auto& outer = r.*Outer;
              if (!outer) outer = WholeOf<Inner>{};
              (*outer).*Inner = v;
            },
            [](const R& r) { return (r.*Outer).has_value(); }};
}

}  // namespace access

/// Where people are shown a number, apart from files.
enum Shown : unsigned {
  kOnlyInFiles = 0,
  kInTable = 1,  ///< on the terminal
  kInChart = 2,  ///< of a report
  kInCards = 4,  ///< at the top of a report
};

template <class Row>
struct Column {
  std::string_view key;     ///< in JSON, CSV and tables, with its unit at its end; empty: not there. "a.b": b of a
  FileUnit unit;            ///< of the key
  std::string_view stored;  ///< in HDF5, in SI; empty: not there
  Access<Row> access;
  std::string_view meaning = {};
  unsigned shown = kOnlyInFiles;  ///< of Shown
  std::string_view label = {};    ///< where people read it; empty: they do not
  int decimals = -1;              ///< there; negative: five digits
  std::string_view listed = {};   ///< its name in lists of many results (app/lists/); empty: not there

  bool known(const Row& row) const { return access.has == nullptr || access.has(row); }
  double in_file(const Row& row) const { return unit.per_si * access.get(row); }
};

/// The rows of a table, specialised beside the struct.
template <class Row>
std::span<const Column<Row>> columns();

}  // namespace treadmark
