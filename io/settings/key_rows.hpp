// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/io/settings/key_list.hpp"

namespace treadmark::io {

/// What is published of the keys of a table.
using TableKeys = std::vector<KeyInfo>;

/// The keys of one table, each with the member of a Root that it is: reader (io/simulations/table_of.hpp), writer,
/// factors, schemas and documents come from them. Immutable; safe to use from several threads.
template <class Root>
struct KeyTable {
  std::vector<SettingKey<Root>> rows;
  TableKeys infos;
};

/// Marks of a key; those from kFirstFactor on are factors (see scale).
inline constexpr unsigned kNeeded = 1, kNoDefault = 2, kFirstFactor = 4;

/// The same under construction: a line a key. place: pointer to the member, or Root& -> member&. marks: of these
/// and factors. missing: what to do where the key is not there but must be.
template <class Root>
class KeyRows : private SettingKeys<Root> {
  using List = SettingKeys<Root>;
  using Folder = const std::filesystem::path&;
  template <class Place>
  using MemberOf = std::remove_cvref_t<std::invoke_result_t<Place, Root&>>;

 public:
  /// The key that was added last, to say more of it.
  struct Row {
    SettingKey<Root>& key;

    Row marked(unsigned marks, std::string_view missing) const {
      key.info.required = (marks & kNeeded) != 0;
      key.info.missing = missing;
      if ((marks & (kNeeded | kNoDefault)) != 0) key.info.default_text.clear();
      key.factors = marks;
      return *this;
    }
    Row shown(std::string_view default_text) const {
      key.info.default_text = default_text;
      return *this;
    }
    /// Of a setting of a verb: name and value on the command line, where they do not follow from the key.
    Row option(std::string_view words) const {
      key.info.option = words;
      return *this;
    }
    Row written(KeyFunction<std::string(const Root&)> text) const {
      key.text = std::move(text);
      key.written = {};
      return *this;
    }
    Row read_by(KeyFunction<void(Root&, const CaseValue&)> set) const {
      key.set = [set = std::move(set)](Root& root, const CaseValue& value, Folder) { set(root, value); };
      return *this;
    }
  };

  /// place: double or std::optional<double>.
  template <class Place>
  Row number(std::string name, KeyLimits limits, std::string doc, Place place, unsigned marks = 0,
             std::string_view missing = {}) {
    if constexpr (std::is_same_v<MemberOf<Place>, double>) {
      List::number(std::move(name), limits, std::move(doc), place);
      return last().marked(marks, missing);
    } else {
      const double unit = unit_of_key(name);
      return value(key_info(std::move(name), KeyType::number, std::move(doc), limits), place, marks, missing)
          .read_by([place, unit](Root& root, const CaseValue& v) { std::invoke(place, root) = v.number() * unit; });
    }
  }
  template <class Place>
  Row integer(std::string name, double least, double most, std::string doc, Place place, unsigned marks = 0,
              std::string_view missing = {}) {
    List::integer(std::move(name), least, most, std::move(doc), place);
    return last().marked(marks, missing);
  }
  template <class Place>
  Row flag(std::string name, std::string doc, Place place) {
    List::flag(std::move(name), std::move(doc), place);
    return last();
  }
  template <class Place>
  Row choice(std::string name, std::vector<std::pair<std::string, MemberOf<Place>>> words, std::string doc, Place place,
             unsigned marks = 0) {
    List::template choice<Root>(std::move(name), std::move(words), std::move(doc), place);
    return last().marked(marks, {});
  }
  /// words: of the enumerators, in their order.
  template <class Place, std::size_t count>
  Row choice(std::string name, const std::array<std::string_view, count>& words, std::string doc, Place place,
             unsigned marks = 0) {
    std::vector<std::pair<std::string, MemberOf<Place>>> pairs;
    for (std::size_t i = 0; i < count; ++i) pairs.emplace_back(words[i], static_cast<MemberOf<Place>>(i));
    return choice(std::move(name), std::move(pairs), std::move(doc), place, marks);
  }
  /// place: std::string or path, which is as it stands in the file.
  template <class Place>
  Row text(std::string name, std::string doc, Place place, unsigned marks = 0, std::string_view missing = {}) {
    return value(key_info(std::move(name), KeyType::text, std::move(doc)), place, marks, missing)
        .read_by([place](Root& root, const CaseValue& v) { std::invoke(place, root) = v.text(); })
        .written([place](const Root& root) {
          if constexpr (std::is_same_v<MemberOf<Place>, std::string>) return toml_text(std::invoke(place, root));
          return std::string();
        });
  }
  /// place: std::vector<std::string>.
  template <class Place>
  Row words(std::string name, std::string doc, Place place, unsigned marks = 0, std::string_view missing = {}) {
    return value(key_info(std::move(name), KeyType::text_list, std::move(doc)), place, marks, missing)
        .read_by([place](Root& root, const CaseValue& v) {
          for (const CaseValue& one : v.list()) std::invoke(place, root).push_back(one.text());
        });
  }
  /// place: std::vector<double>.
  template <class Place>
  Row number_list(std::string name, KeyLimits limits, std::string doc, Place place, unsigned marks = 0,
                  std::string_view missing = {}) {
    List::number_list(std::move(name), std::move(doc), place, limits);
    return last().marked(marks, missing);
  }
  /// place: std::vector<Vec3>.
  template <class Place>
  Row points(std::string name, std::string doc, Place place, unsigned marks = 0, std::string_view missing = {}) {
    const double unit = unit_of_key(name);
    return value(key_info(std::move(name), KeyType::triple_list, std::move(doc)), place, marks, missing)
        .read_by([place, unit](Root& root, const CaseValue& v) {
          for (const CaseValue& one : v.list()) {
            const std::vector<double> numbers = numbers_of(one, unit);
            std::invoke(place, root).push_back({numbers[0], numbers[1], numbers[2]});
          }
        })
        .written([place, unit](const Root& root) {
          std::string text;
          for (const Vec3& point : std::invoke(place, root))
            text += (text.empty() ? "" : ", ") + exact_list({point.begin(), point.end()}, unit);
          return text.empty() ? text : '[' + text + ']';
        });
  }
  /// place: Vec3, or the first of three numbers. Zeros are not written.
  template <class Place>
  Row triple(std::string name, KeyLimits limits, std::string doc, Place place, unsigned marks = 0,
             std::string_view missing = {}) {
    const double unit = unit_of_key(name);
    const auto numbers = [place](Root& root) -> std::span<double> {
      if constexpr (std::is_same_v<MemberOf<Place>, double>)
        return std::span(&std::invoke(place, root), 3);
      else
        return std::span(std::invoke(place, root).data(), 3);
    };
    const Row row = value(key_info(std::move(name), KeyType::triple, std::move(doc), limits), place, marks, missing);
    row.read_by(
        [numbers, unit](Root& root, const CaseValue& v) { ranges::copy(numbers_of(v, unit), numbers(root).begin()); });
    row.key.numbers = numbers;
    row.key.written = [numbers, unit](const Root& root, Folder) {
      const std::span<double> values = numbers(const_cast<Root&>(root));
      const bool none = ranges::all_of(values, [](double x) { return x == 0.0; });
      return none ? std::string() : exact_list({values.begin(), values.end()}, unit);
    };
    return row;
  }
  /// What its reader takes apart: only type and member are known.
  template <class Place>
  Row value(KeyInfo info, Place place, unsigned marks = 0, std::string_view missing = {}) {
    List::add(std::move(info)).member = [place](const Root& root) -> const void* {
      return &std::invoke(place, const_cast<Root&>(root));
    };
    return last().marked(marks, missing);
  }
  /// A table or a list of tables, which its reader reads.
  template <class Place>
  Row table(std::string name, KeyType type, std::string doc, TableKeys elements, Place place, unsigned marks = 0,
            std::string_view missing = {}) {
    KeyInfo info = key_info(std::move(name), type, std::move(doc));
    info.elements = std::move(elements);
    return value(std::move(info), place, marks, missing);
  }

  KeyTable<Root> done() && { return {List::keys, infos_of<Root>(List::keys)}; }

 private:
  Row last() { return {List::keys.back()}; }
};

/// add: KeyRows<Root>& -> the lines of the table.
template <class Root, class Add>
KeyTable<Root> key_table(Add add) {
  KeyRows<Root> rows;
  add(rows);
  return std::move(rows).done();
}

/// The numbers of a Root that go with a factor, times it.
template <class Root>
void scale(const KeyTable<Root>& keys, Root& root, unsigned factor, double by) {
  for (const SettingKey<Root>& key : keys.rows)
    if ((key.factors & factor) != 0)
      for (double& number : key.numbers(root)) number *= by;
}

/// The line that makes a member of this Root; empty where the key says nothing, or its reader takes it apart.
template <class Root>
std::string written_line(const SettingKey<Root>& key, const Root& root) {
  const std::string value = key.written ? key.written(root, {}) : key.text ? key.text(root) : std::string();
  return value.empty() ? value : fmt::format("{} = {}", key.info.path, value);
}
template <class Root>
std::string written_lines(const KeyTable<Root>& keys, const Root& root) {
  std::string lines;
  for (const SettingKey<Root>& key : keys.rows)
    if (const std::string line = written_line(key, root); !line.empty()) lines += line + '\n';
  return lines;
}

}  // namespace treadmark::io
