// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cctype>
#include <string>

#include "treadmark/app/version.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::app {

std::string version_json() {
  io::Json out{{"version", version()}, {"git", git_revision()}, {"licence", licence()}};
  for (const Part& part : parts()) out["parts"][std::string(part.key)] = part.built;
  for (const LinkedLibrary& library : linked_libraries())
    out["libraries"].push_back({{"name", library.name},
                                {"version", library.version},
                                {"licence", library.licence},
                                {"linked", library.script           ? "script"
                                           : library.shared.empty() ? "headers"
                                                                    : "shared"}});
  return io::dumped(out, 2) + '\n';
}

std::string version_spdx() {
  using io::Json;
  const std::string url = "https://treadmark.invalid/spdx/treadmark-" + version() + '-' + git_revision();
  const auto package = [](const std::string& id, const std::string& name, const std::string& number,
                          const std::string& licence) {
    return Json{{"SPDXID", id},
                {"name", name},
                {"versionInfo", number},
                {"downloadLocation", "NOASSERTION"},
                {"filesAnalyzed", false},
                {"licenseConcluded", licence},
                {"licenseDeclared", licence},
                {"copyrightText", "NOASSERTION"}};
  };
  const std::string self = "SPDXRef-treadmark";
  Json packages = Json::array({package(self, "treadmark", version() + '+' + git_revision(), licence())});
  packages[0]["licenseDeclared"] = "Apache-2.0";
  packages[0]["licenseComments"] = "declared: of its own sources; concluded: of the program with what it is linked to";
  packages[0]["copyrightText"] = "Copyright Treadmark contributors";
  Json relations = Json::array(
      {{{"spdxElementId", "SPDXRef-DOCUMENT"}, {"relationshipType", "DESCRIBES"}, {"relatedSpdxElement", self}}});
  for (const LinkedLibrary& library : linked_libraries()) {
    std::string id = "SPDXRef-";
    for (const char c : library.name) id += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
    packages.push_back(package(id, library.name, library.version, library.licence));
    if (library.script)
      packages.back()["externalRefs"] =
          Json::array({{{"referenceCategory", "PACKAGE-MANAGER"},
                        {"referenceType", "purl"},
                        {"referenceLocator", "pkg:npm/" + library.name + '@' + library.version}}});
    relations.push_back({{"spdxElementId", self},
                         {"relationshipType", library.script           ? "CONTAINS"
                                              : library.shared.empty() ? "STATIC_LINK"
                                                                       : "DYNAMIC_LINK"},
                         {"relatedSpdxElement", id}});
  }
  const Json out{{"spdxVersion", "SPDX-2.3"},
                 {"dataLicense", "CC0-1.0"},
                 {"SPDXID", "SPDXRef-DOCUMENT"},
                 {"name", "treadmark-" + version()},
                 {"documentNamespace", url},
                 {"creationInfo", {{"created", source_time()}, {"creators", {"Tool: treadmark-" + version()}}}},
                 {"packages", packages},
                 {"relationships", relations}};
  return io::dumped(out, 2) + '\n';
}

}  // namespace treadmark::app
