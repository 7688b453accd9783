// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/profiles/profile_source.hpp"
#include "treadmark/io/profiles/raw_points.hpp"

namespace treadmark::io::profiles {

/// A line that is kept, with its number, for messages.
class KeptLine : public TextLine {
 public:
  KeptLine(const std::string& file, int number, std::string text) : TextLine(file, number), text_(std::move(text)) {
    line_ = text_;
  }
  KeptLine(const KeptLine& other) : TextLine(other), text_(other.text_) { line_ = text_; }
  KeptLine& operator=(const KeptLine&) = delete;

 private:
  std::string text_;
};

/// What stands in front of the numbers of a line: quotes round numbers and comments are gone.
std::string plain_line(std::string_view line);

/// Which columns (from 0) hold y and z, and what the others are.
struct ColumnRoles {
  int y = 0, z = 1;
  bool named = false;
  double radius_factor = 0.0;  ///< z holds radii (1) or diameters (0.5); 0: heights
  std::optional<LengthUnit> unit;
  std::optional<points::UnknownUnit> unknown_unit;
  std::string own_words;  ///< "yL, zL"
  std::string in_words;   ///< of those that are not used
};

/// The profiles of names such as "y", "z [mm]", "x": one, or several side by side as in "yL, zL, yR, zR" or "y, z left,
/// z right", in the order of the names. None where two coordinates of one thing are not among them.
/// Error(input_data) for a coordinate that is named twice, or for different units.
std::vector<ColumnRoles> profiles_of(const std::vector<std::string>& names, const TextLine& line);

/// How many of these names are those of a coordinate and nothing else.
std::size_t coordinates_among(const std::vector<std::string>& names);

/// Whether a name is that of a height and nothing else.
bool is_height(std::string_view name);

/// The names in a line of words or in a comment that has `columns` of them; empty: there are fewer or more.
std::vector<std::string> names_for(std::string_view text, char separator, std::size_t columns);

/// Of those names the profile with this number (from 1); 0: the only one. Error(input_data) where there are several, or
/// none of this number.
std::optional<ColumnRoles> roles_in(const TextLine& line, std::string_view text, char separator, std::size_t columns,
                                    int profile);

/// Lines of numbers that belong to one profile.
class ColumnTable {
 public:
  explicit ColumnTable(std::string file) : file_(std::move(file)) {}

  void add(int line, std::string text) { rows_.push_back({line, std::move(text)}); }
  /// Leaves out a first line that says how many lines (and columns) follow, with a note.
  void drop_count(std::vector<std::string>& notes);
  bool empty() const { return rows_.empty(); }
  std::size_t size() const { return rows_.size(); }

  /// Two long lines, all y and then all z, as lines of two numbers, with a note.
  void turn_two_lines(const points::FieldStyle& style, std::vector<std::string>& notes);

  /// How numbers are told apart, judged by the first lines.
  points::FieldStyle style() const;
  std::size_t columns(char separator) const;  ///< of the first line

  /// The points. numbers_only: nothing but numbers may stand in the other columns. Points of which y or z was not
  /// measured are left out, with a note. Error(input_data) where more than three tenths of those between the first and
  /// the last one are.
  RawPoints points(const ColumnRoles& roles, const points::FieldStyle& style, bool numbers_only,
                   std::vector<std::string>& notes) const;

  /// Error(input_data) where commas may separate numbers or be decimal, which names of the columns would tell.
  void refuse_ambiguous_commas(const points::FieldStyle& style) const;

  /// Columns without names: y and z unless the first one counts the lines. Error(input_data) where it seems to.
  ColumnRoles assume_roles(const points::FieldStyle& style, std::vector<std::string>& notes) const;

  /// What else than y and z is there, by its numbers.
  struct Others {
    std::vector<int> varying;   ///< columns whose numbers are not all the same
    std::optional<int> like_z;  ///< one of them that runs as z does, as that of another profile
  };
  Others others(const ColumnRoles& roles, const points::FieldStyle& style) const;

 private:
  struct Row {
    int line;
    std::string text;
  };
  std::string file_;
  std::vector<Row> rows_;
};

}  // namespace treadmark::io::profiles
