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

namespace treadmark::app::report {

struct JsonNode;
struct JsonFile;

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

  /// NaN where the key is missing.
  double number_or_nan(std::string_view key) const;

  /// Throws the error: place and what is wrong with it.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  friend JsonFile read_json_file(const std::filesystem::path& file);
  JsonTree(std::shared_ptr<const JsonNode> node, std::shared_ptr<const std::string> file, std::string place)
      : node_(std::move(node)), file_(std::move(file)), place_(std::move(place)) {}
  [[noreturn]] void fail(const std::string& what) const;
  JsonTree child(const JsonNode& node, std::string place) const;

  std::shared_ptr<const JsonNode> node_;
  std::shared_ptr<const std::string> file_;
  std::string place_;
};

struct JsonFile {
  JsonTree root;     ///< an object
  std::string text;  ///< the file as it is
};

/// Reads a result file. Errors: Error(input_data) for files that are missing, no JSON (with the line), nested too
/// deeply, or no object.
JsonFile read_json_file(const std::filesystem::path& file);

}  // namespace treadmark::app::report
