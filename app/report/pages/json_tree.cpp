// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/json_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/read_text.hpp"

namespace treadmark::app::report {

/// Objects have as many keys as items.
struct JsonNode {
  enum class Kind { nothing, flag, number, text, list, object };
  Kind kind = Kind::nothing;
  bool flag = false;
  double number = 0.0;
  std::string text;
  std::vector<std::string> keys;
  std::vector<JsonNode> items;
};

namespace {

using Kind = JsonNode::Kind;
using Json = nlohmann::json;

constexpr const char* kAdvice = "give a folder that this program wrote, with complete files";

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::nothing:
      return "null";
    case Kind::flag:
      return "true or false";
    case Kind::number:
      return "a number";
    case Kind::text:
      return "a text";
    case Kind::list:
      return "a list";
    case Kind::object:
      return "an object";
  }
  return "something else";
}

/// Builds nodes from what the parser finds. Nodes are moved into the ones around them when they are complete.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  JsonNode root;
  std::size_t error_at = 0;  ///< byte, from 1; 0 = none
  bool too_deep = false;

  bool null() override { return add({}); }
  bool boolean(bool value) override { return add({Kind::flag, value, 0.0, {}, {}, {}}); }
  bool number_integer(number_integer_t value) override { return add_number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return add_number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
  bool string(string_t& value) override { return add({Kind::text, false, 0.0, std::move(value), {}, {}}); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Kind::object); }
  bool start_array(std::size_t) override { return open(Kind::list); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    open_.back().keys.push_back(std::move(name));
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
    error_at = std::max<std::size_t>(1, position);
    return false;
  }

 private:
  static constexpr std::size_t kDeepest = 100;

  bool add_number(double value) { return add({Kind::number, false, value, {}, {}, {}}); }
  bool add(JsonNode node) {
    if (open_.empty())
      root = std::move(node);
    else
      open_.back().items.push_back(std::move(node));
    return true;
  }
  bool open(Kind kind) {
    too_deep = open_.size() == kDeepest;
    open_.push_back({kind, false, 0.0, {}, {}, {}});
    return !too_deep;
  }
  bool close() {
    JsonNode node = std::move(open_.back());
    open_.pop_back();
    return add(std::move(node));
  }

  std::vector<JsonNode> open_;
};

SourcePosition position(const std::string& file, const std::string& text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte - 1, text.size()));
  const auto line = std::count(text.begin(), end, '\n');
  const auto last = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
  return {file, static_cast<int>(line) + 1, static_cast<int>(end - last) + 1};
}

}  // namespace

void JsonTree::fail(const std::string& what) const {
  throw Error(ErrorKind::input_data, what, {*file_, 0, 0}, kAdvice);
}

void JsonTree::refuse(const std::string& what) const {
  fail(fmt::format("{} {}", place_.empty() ? "the file" : place_, what));
}

JsonTree JsonTree::child(const JsonNode& node, std::string place) const {
  return {std::shared_ptr<const JsonNode>(node_, &node), file_, std::move(place)};
}

namespace {

std::string named(const std::string& place) { return place.empty() ? "the file" : place; }

std::string wrong_kind(const JsonNode& node, const std::string& place, const char* wanted) {
  return fmt::format("{} is {} where {} is expected", named(place), name_of(node.kind), wanted);
}

const JsonNode* find_in(const JsonNode& node, std::string_view key) {
  for (std::size_t i = node.keys.size(); i-- > 0;)
    if (node.keys[i] == key) return &node.items[i];
  return nullptr;
}

std::string joined(const std::string& place, std::string_view key) {
  return place.empty() ? std::string(key) : fmt::format("{}.{}", place, key);
}

}  // namespace

bool JsonTree::has(std::string_view key) const {
  if (node_->kind != Kind::object) fail(wrong_kind(*node_, place_, "an object"));
  return find_in(*node_, key) != nullptr;
}

bool JsonTree::is_null() const { return node_->kind == Kind::nothing; }

JsonTree JsonTree::at(std::string_view key) const {
  if (!has(key)) fail(fmt::format("{} is missing", joined(place_, key)));
  return child(*find_in(*node_, key), joined(place_, key));
}

std::optional<JsonTree> JsonTree::find(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  JsonTree found = at(key);
  if (found.is_null()) return std::nullopt;
  return found;
}

std::vector<JsonTree> JsonTree::items() const {
  if (node_->kind != Kind::list) fail(wrong_kind(*node_, place_, "a list"));
  std::vector<JsonTree> out;
  for (std::size_t i = 0; i < node_->items.size(); ++i)
    out.push_back(child(node_->items[i], fmt::format("{}[{}]", place_, i)));
  return out;
}

std::vector<std::pair<std::string, JsonTree>> JsonTree::entries() const {
  if (node_->kind != Kind::object) fail(wrong_kind(*node_, place_, "an object"));
  std::vector<std::pair<std::string, JsonTree>> out;
  for (std::size_t i = 0; i < node_->items.size(); ++i)
    out.emplace_back(node_->keys[i], child(node_->items[i], joined(place_, node_->keys[i])));
  return out;
}

double JsonTree::number() const {
  if (is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (node_->kind != Kind::number) fail(wrong_kind(*node_, place_, "a number"));
  return node_->number;
}

std::size_t JsonTree::count() const {
  constexpr double kMost = 9007199254740992.0;  // whole numbers are exact up to here
  if (node_->kind != Kind::number) fail(wrong_kind(*node_, place_, "a whole number"));
  if (!(node_->number >= 0.0 && node_->number <= kMost) || node_->number != std::floor(node_->number))
    fail(fmt::format("{} is {:g} where a whole number, not negative, is expected", named(place_), node_->number));
  return static_cast<std::size_t>(node_->number);
}

int JsonTree::integer() const {
  if (node_->kind != Kind::number) fail(wrong_kind(*node_, place_, "a whole number"));
  if (!(std::fabs(node_->number) <= 2147483647.0) || node_->number != std::floor(node_->number))
    fail(fmt::format("{} is {:g} where a whole number is expected", named(place_), node_->number));
  return static_cast<int>(node_->number);
}

std::string JsonTree::text() const {
  if (node_->kind != Kind::text) fail(wrong_kind(*node_, place_, "a text"));
  return node_->text;
}

bool JsonTree::flag() const {
  if (node_->kind != Kind::flag) fail(wrong_kind(*node_, place_, "true or false"));
  return node_->flag;
}

std::vector<double> JsonTree::numbers() const {
  std::vector<double> out;
  for (const JsonTree& item : items()) out.push_back(item.number());
  return out;
}

std::vector<std::string> JsonTree::texts() const {
  std::vector<std::string> out;
  for (const JsonTree& item : items()) out.push_back(item.text());
  return out;
}

double JsonTree::number_or_nan(std::string_view key) const {
  return has(key) ? at(key).number() : std::numeric_limits<double>::quiet_NaN();
}

JsonFile read_json_file(const std::filesystem::path& file) {
  std::string text = io::profiles::read_text(file, "result", {});
  Builder builder;
  const bool read = Json::sax_parse(text, &builder);
  if (builder.too_deep)
    throw Error(ErrorKind::input_data, "the file is nested too deeply", {file.string(), 0, 0}, kAdvice);
  if (!read || builder.error_at > 0)
    throw Error(ErrorKind::input_data, "the file is no JSON, or was cut off",
                position(file.string(), text, std::max<std::size_t>(1, builder.error_at)), kAdvice);
  if (builder.root.kind != Kind::object)
    throw Error(ErrorKind::input_data, wrong_kind(builder.root, {}, "an object"), {file.string(), 0, 0}, kAdvice);
  return {JsonTree(std::make_shared<const JsonNode>(std::move(builder.root)),
                   std::make_shared<const std::string>(file.string()), {}),
          std::move(text)};
}

}  // namespace treadmark::app::report
