// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/case_schema.hpp"

#include <nlohmann/json.hpp>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/settings/key_schema.hpp"

namespace treadmark::io {

std::string case_file_schema() {
  using Json = nlohmann::ordered_json;
  const std::vector<KeyInfo> keys = infos_of(case_keys());
  const auto tables = [&](bool sweep) { return Json::parse(tables_schema(keys, kExclusiveSections, sweep)); };
  Json schema{{"$schema", kSchemaDialect}, {"title", "Treadmark case file"}};
  schema.update(tables(false));
  Json& properties = schema["properties"];
  properties["title"] = {{"type", "string"}, {"description", "name of the study; without it the name of the file"}};
  properties["cases"] = {{"type", "array"},
                         {"minItems", 1},
                         {"items", tables(true)},
                         {"description",
                          "cases; each overrides some keys, and a list where one value is expected makes one case for "
                          "each of its values"}};
  return schema.dump(2) + '\n';
}

std::string case_key_table() { return key_table(infos_of(case_keys())); }

}  // namespace treadmark::io
