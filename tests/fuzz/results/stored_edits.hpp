// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <hdf5.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace treadmark::fuzz {

/// Edits a sound HDF5 file, so that what is read of it is anything that the format can hold. A command a line:
///   drop PATH                    the group or dataset is gone
///   link PATH TARGET             PATH is another name of TARGET
///   forget PATH NAME             the attribute is gone
///   number PATH NAME VALUES      the attribute holds these numbers
///   whole PATH NAME VALUES       the same, whole numbers
///   text PATH NAME TEXT          the same, a text
///   data PATH ROWS COLUMNS VALUE the dataset holds this number everywhere; as bytes if it is whole
/// What cannot be done is not. Bytes below this level are the HDF5 library's, which is not what is put to the test.
inline void edit_stored(const std::filesystem::path& path, const std::string& commands) {
  constexpr hsize_t kMostValues = 100'000;
  constexpr int kMostEdits = 50;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  if (file < 0) return;
  std::istringstream lines(commands);
  int edits = 0;
  for (std::string line; std::getline(lines, line) && edits < kMostEdits; ++edits) {
    std::istringstream words(line);
    std::string command, object, name;
    words >> command >> object;
    if (object.empty() || object.find('\0') != std::string::npos) continue;
    if (command == "drop") {
      H5Ldelete(file, object.c_str(), H5P_DEFAULT);
    } else if (command == "link" && words >> name) {
      H5Lcreate_soft(name.c_str(), file, object.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    } else if (command == "data") {
      hsize_t size[2] = {0, 0};
      double value = 0.0;
      words >> size[0] >> size[1] >> value;
      if (size[0] > kMostValues || size[1] > kMostValues || size[0] * size[1] > kMostValues) continue;
      H5Ldelete(file, object.c_str(), H5P_DEFAULT);
      const bool bytes = value >= 0.0 && value < 256.0 && value == static_cast<double>(static_cast<int>(value));
      const std::vector<double> values(size[0] * size[1] + 1, value);
      const hid_t space = H5Screate_simple(size[1] == 0 ? 1 : 2, size, nullptr);
      const hid_t set = H5Dcreate2(file, object.c_str(), bytes ? H5T_NATIVE_UINT8 : H5T_NATIVE_DOUBLE, space,
                                   H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      if (set >= 0) {
        if (size[1] > 0) H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        H5Dclose(set);
      }
      H5Sclose(space);
    } else if (words >> name) {
      H5Adelete_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT);
      const bool text = command == "text", whole = command == "whole";
      if (!text && !whole && command != "number") continue;
      std::vector<double> values;
      for (double value = 0.0; values.size() < 1000 && words >> value;) values.push_back(value);
      const hsize_t count = values.size();
      const hid_t type = text ? H5Tcopy(H5T_C_S1) : whole ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
      if (text) H5Tset_size(type, H5T_VARIABLE);
      if (text) H5Tset_cset(type, H5T_CSET_UTF8);
      const hid_t space = text || count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr);
      const hid_t attribute =
          H5Acreate_by_name(file, object.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      if (attribute >= 0) {
        const std::string rest = line.substr(std::min(line.size(), line.find(name) + name.size() + 1));
        const char* pointer = rest.c_str();
        values.push_back(0.0);
        H5Awrite(attribute, text ? type : H5T_NATIVE_DOUBLE,
                 text ? static_cast<const void*>(&pointer) : static_cast<const void*>(values.data()));
        H5Aclose(attribute);
      }
      if (text) H5Tclose(type);
      H5Sclose(space);
    }
  }
  H5Fclose(file);
}

}  // namespace treadmark::fuzz
