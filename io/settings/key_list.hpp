// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "treadmark/io/settings/exact_text.hpp"
#include "treadmark/io/settings/key_function.hpp"
#include "treadmark/io/settings/key_info.hpp"

namespace treadmark::io {

/// One key with the way to its place in a Root: a case, the settings of an import, a table of a simulation.
template <class Root>
struct SettingKey {
  KeyInfo info;
  /// value has been checked against info; relative paths count from folder.
  KeyFunction<void(Root&, const CaseValue& value, const std::filesystem::path& folder)> set = {};
  /// Numbers that are stored as they are: the value in the unit of the key. Empty for all other keys.
  KeyFunction<double(const Root&)> get = {};
  /// table_list only: changes some keys of the element with this index (which exists, or Error). A key of a nested list
  /// has the rest of its path as name: "waves.1.phase_deg".
  KeyFunction<void(Root&, std::size_t index, const CaseTable& entries, const SourcePosition& where)> set_element = {};
  /// The value as TOML, for flags, texts and directions.
  KeyFunction<std::string(const Root&)> text = {};
  /// The value as a file writes it, as TOML, from which the reader makes this value; empty text where the key
  /// says nothing of this Root. Relative paths count from folder. Without it text is written.
  KeyFunction<std::string(const Root&, const std::filesystem::path& folder)> written = {};
  /// The member that the key sets, by its address: so readers find the key of a member, whose name stands here only.
  KeyFunction<const void*(const Root&)> member = {};
  /// The numbers of a number or a triple, which factors change.
  KeyFunction<std::span<double>(Root&)> numbers = {};
  /// Which factors change it, as bits that the reader of the table knows.
  unsigned factors = 0;
};

template <class Root>
std::vector<KeyInfo> infos_of(std::span<const SettingKey<Root>> keys) {
  std::vector<KeyInfo> infos;
  for (const SettingKey<Root>& key : keys) infos.push_back(key.info);
  return infos;
}

/// Numbers as a TOML list, in the unit given.
inline std::string exact_list(const std::vector<double>& values, double unit) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + exact_text(value, unit);
  return '[' + text + ']';
}

/// A file as seen from a folder.
inline std::filesystem::path relative_to(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto whole = [](const std::filesystem::path& p) {
    return (p.empty() ? std::filesystem::current_path() : std::filesystem::absolute(p)).lexically_normal();
  };
  return whole(file).lexically_proximate(whole(folder));
}
/// The same as TOML; empty text for none.
inline std::string written_path(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return file.empty() ? std::string() : toml_text(relative_to(file, folder).generic_string());
}

/// The part of a Root that keys of one scope live in: the Root itself, or one alternative of its member `content`.
template <class Content, class Root>
Content& content_of(Root& root) {
  if constexpr (std::is_same_v<Content, Root>)
    return root;
  else
    return std::get<Content>(root.content);
}
template <class Content, class Root>
KeyScope scope_of() {
  if constexpr (std::is_same_v<Content, Root>)
    return KeyScope::any;
  else
    return static_cast<KeyScope>(1 + decltype(Root::content)(std::in_place_type<Content>).index());
}

/// The type that is read into a member.
template <class Member>
struct ValueOf {
  using type = Member;
};
template <class Value>
struct ValueOf<std::optional<Value>> {
  using type = Value;
};

/// A list of keys under construction: a line for each member of a Root. place: Content& -> member&, or a pointer to the
/// member.
template <class Root>
class SettingKeys {
 public:
  using Key = SettingKey<Root>;
  using Folder = const std::filesystem::path&;

  enum class Numbers { si, as_written };
  /// as_written: the Root has its numbers in the units of their keys.
  explicit SettingKeys(Numbers numbers = Numbers::si) : numbers_(numbers) {}

  std::vector<Key> keys;

  Key& add(KeyInfo info) {
    keys.push_back({std::move(info)});
    return keys.back();
  }

  template <class Content = Root, class Place>
  KeyInfo& number(std::string path, KeyLimits limits, std::string doc, Place place) {
    KeyInfo info = key_info(std::move(path), KeyType::number, std::move(doc), limits);
    info.scope = scope_of<Content, Root>();
    return number_at(std::move(info), std::invoke(place, fresh<Content>()),
                     [place](Root& c) -> double& { return std::invoke(place, content_of<Content>(c)); });
  }

  template <class Content = Root, class Place>
  KeyInfo& number_list(std::string path, std::string doc, Place place, KeyLimits limits = kAnyNumber,
                       KeyType type = KeyType::number_list) {
    const double unit = unit_of(path);
    Key& key = add<Content>(key_info(std::move(path), type, std::move(doc), limits));
    key.set = [place, unit](Root& c, const CaseValue& v, Folder) {
      std::invoke(place, content_of<Content>(c)) = numbers_of(v, unit);
    };
    key.written = [place, unit](const Root& c, Folder) {
      const std::vector<double>& values = std::invoke(place, content_of<Content>(const_cast<Root&>(c)));
      return values.empty() ? std::string() : exact_list(values, unit);
    };
    key.member = member_at<Content>(place);
    return key.info;
  }

  /// place: -> std::vector<double>&, three numbers or none.
  template <class Place>
  KeyInfo& direction(std::string path, std::string doc, Place place) {
    KeyInfo& info = number_list(std::move(path), std::move(doc), place, kAnyNumber, KeyType::direction);
    info.default_text = "[]";
    keys.back().text = [place](const Root& c) { return fmt::format("[{}]", fmt::join(std::invoke(place, c), ", ")); };
    return info;
  }

  /// Two keys, base_deg and base_rad, that exclude each other.
  template <class Content, class Place>
  void angle(const std::string& base, KeyLimits limits_deg, const std::string& doc, Place place) {
    for (const std::string unit : {"deg", "rad"}) {
      KeyInfo& info = number<Content>(fmt::format("{}_{}", base, unit), limits_deg, doc, place);
      const double factor = unit == "rad" ? unit_of_key("x_deg") : 1.0;
      for (auto* limit : {&info.above, &info.at_least, &info.at_most})
        if (*limit) *limit = **limit * factor;
      info.group = base;
      info.alternative = unit;
    }
  }

  template <class Content = Root, class Place>
  KeyInfo& integer(std::string path, double least, double most, std::string doc, Place place) {
    KeyInfo info = key_info(std::move(path), KeyType::integer, std::move(doc), {{}, least, most});
    using Member = std::remove_cvref_t<std::invoke_result_t<Place, Content&>>;
    if constexpr (std::is_integral_v<Member>) info.default_text = std::to_string(std::invoke(place, fresh<Content>()));
    Key& key = add<Content>(std::move(info));
    key.set = [place](Root& c, const CaseValue& v, Folder) {
      std::invoke(place, content_of<Content>(c)) = static_cast<typename ValueOf<Member>::type>(v.integer());
    };
    if constexpr (std::is_integral_v<Member>)
      key.written = [place](const Root& c, Folder) {
        return std::to_string(std::invoke(place, content_of<Content>(const_cast<Root&>(c))));
      };
    key.member = member_at<Content>(place);
    return key.info;
  }

  /// place takes a const Root, too.
  template <class Place>
  KeyInfo& flag(std::string path, std::string doc, Place place) {
    Key& key = add(key_info(std::move(path), KeyType::flag, std::move(doc)));
    key.set = [place](Root& c, const CaseValue& v, Folder) { std::invoke(place, c) = v.flag(); };
    key.text = [place](const Root& c) { return std::string(std::invoke(place, c) ? "true" : "false"); };
    key.member = member_at<Root>(place);
    key.info.default_text = key.text(Root{});
    return key.info;
  }

  /// place: -> std::string&, of a const Root, too. choices: empty = any text.
  template <class Place>
  KeyInfo& word(std::string path, std::vector<std::string> choices, std::string doc, Place place) {
    KeyInfo info = key_info(std::move(path), choices.empty() ? KeyType::text : KeyType::choice, std::move(doc));
    info.choices = std::move(choices);
    Key& key = add(std::move(info));
    key.set = [place](Root& c, const CaseValue& v, Folder) { std::invoke(place, c) = v.text(); };
    key.text = [place](const Root& c) { return toml_text(std::invoke(place, c)); };
    key.member = member_at<Root>(place);
    const Root fresh;
    key.info.default_text = '"' + std::invoke(place, fresh) + '"';
    return key.info;
  }

  /// choices: word and enumerator.
  template <class Content, class Enum, class Place>
  KeyInfo& choice(std::string path, std::vector<std::pair<std::string, Enum>> choices, std::string doc, Place place) {
    KeyInfo info = key_info(std::move(path), KeyType::choice, std::move(doc));
    for (const auto& [word, value] : choices) {
      info.choices.push_back(word);
      if (std::invoke(place, fresh<Content>()) == value) info.default_text = '"' + word + '"';
    }
    Key& key = add<Content>(std::move(info));
    key.set = [place, choices](Root& c, const CaseValue& v, Folder) {
      for (const auto& [word, value] : choices)
        if (word == v.text()) std::invoke(place, content_of<Content>(c)) = value;
    };
    key.written = [place, choices](const Root& c, Folder) {
      for (const auto& [word, value] : choices)
        if (std::invoke(place, content_of<Content>(const_cast<Root&>(c))) == value) return toml_text(word);
      return std::string();
    };
    key.member = member_at<Content>(place);
    return key.info;
  }

  /// A number that at finds; compiled once, not once a key. fresh: the default in SI units.
  KeyInfo& number_at(KeyInfo info, double fresh, KeyFunction<double&(Root&)> at) {
    const double unit = unit_of(info.path);
    info.default_text = fmt::format("{:.10g}", fresh / unit);
    Key& key = add(std::move(info));
    // at only finds the member: reading through it changes nothing.
    key.get = [at, unit](const Root& c) { return at(const_cast<Root&>(c)) / unit; };
    key.written = [at, unit](const Root& c, Folder) { return exact_text(at(const_cast<Root&>(c)), unit); };
    key.member = [at](const Root& c) { return static_cast<const void*>(&at(const_cast<Root&>(c))); };
    key.numbers = [at](Root& c) { return std::span(&at(c), 1); };
    key.set = [at = std::move(at), unit](Root& c, const CaseValue& v, Folder) { at(c) = v.number() * unit; };
    return key.info;
  }

 private:
  template <class Content>
  static Content& fresh() {
    static Content content;
    return content;
  }
  template <class Content>
  Key& add(KeyInfo info) {
    info.scope = scope_of<Content, Root>();
    return add(std::move(info));
  }
  template <class Content, class Place>
  static KeyFunction<const void*(const Root&)> member_at(Place place) {
    return [place](const Root& c) -> const void* {
      return &std::invoke(place, content_of<Content>(const_cast<Root&>(c)));
    };
  }
  double unit_of(std::string_view path) const { return numbers_ == Numbers::si ? unit_of_key(path) : 1.0; }

  Numbers numbers_;
};

}  // namespace treadmark::io
