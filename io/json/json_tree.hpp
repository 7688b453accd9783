// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treadmark::io {

/// A value in a JSON file that knows its file and its place there. Cheap to copy; keeps the whole file's values alive.
/// Thread-safe. Errors of everything that asks for more than is there: Error(input_data) that names the file and the
/// place ("rows[3].pmax_MPa").
class JsonTree {
 public:
  /// Of an object: whether it has the key; a key whose value is null is there.
  bool has(std::string_view key) const;
  bool is_null() const;

  JsonTree at(std::string_view key) const;
  std::optional<JsonTree> find(std::string_view key) const;       ///< nothing where the key is missing or null
  std::vector<JsonTree> items() const;                            ///< of a list
  std::vector<std::pair<std::string, JsonTree>> entries() const;  ///< of an object, in the order of the file

  double number() const;      ///< null = NaN
  std::size_t count() const;  ///< a whole number that is not negative
  int integer() const;
  std::string text() const;
  bool flag() const;
  std::vector<double> numbers() const;     ///< of a list
  std::vector<std::string> texts() const;  ///< of a list

  double number(std::string_view key) const { return at(key).number(); }
  std::size_t count(std::string_view key) const { return at(key).count(); }
  std::string text(std::string_view key) const { return at(key).text(); }
  bool flag(std::string_view key) const { return at(key).flag(); }

  /// The name among these that the text is ("rows[3].body is "axle" where wheel or rail is expected"): its index.
  std::size_t one_of(const std::vector<std::string_view>& names) const;

  /// Throws the error: place and what is wrong with it.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  struct Document;
  friend JsonTree read_json_file(const std::filesystem::path& file);
  JsonTree(std::shared_ptr<const Document> document, const void* value, std::string place)
      : document_(std::move(document)), value_(value), place_(std::move(place)) {}
  [[noreturn]] void refuse_kind(const char* wanted) const;

  std::shared_ptr<const Document> document_;
  const void* value_;  ///< in the document
  std::string place_;
};

/// The object in a result file. Errors: Error(input_data) for files that are missing, no JSON (with the line), nested
/// too deeply, or no object.
JsonTree read_json_file(const std::filesystem::path& file);

}  // namespace treadmark::io
