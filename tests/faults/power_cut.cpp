// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/faults/power_cut.hpp"

#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <stdexcept>

namespace treadmark::testing {

std::vector<Operation> read_log(const std::filesystem::path& log, const std::filesystem::path& under) {
  std::ifstream in(log, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string root = under.string() + "/";
  std::vector<Operation> out;
  std::size_t at = 0;
  const auto take = [&](std::size_t length) {
    if (at + length > text.size()) throw std::runtime_error("the log of operations is cut off");
    at += length;
    return text.substr(at - length, length);
  };
  const auto relative = [&](const std::string& path) {
    return path.starts_with(root) ? path.substr(root.size()) : std::string();
  };
  while (at < text.size()) {
    faults::LogHead head;
    std::memcpy(&head, take(sizeof head).data(), sizeof head);
    Operation operation;
    operation.what = head.operation;
    operation.offset = head.offset;
    operation.path = relative(take(head.first));
    operation.to = relative(take(head.second));
    operation.data = take(head.data);
    out.push_back(std::move(operation));
  }
  return out;
}

Disk::Disk(const FileTree& start) {
  make(true);
  for (const auto& [path, content] : start) {
    for (std::size_t slash = path.find('/'); slash != path.npos; slash = path.find('/', slash + 1))
      if (find(path.substr(0, slash)) < 0) apply({'d', path.substr(0, slash), {}, {}, 0});
    apply({'c', path, {}, {}, 0});
    apply({'w', path, {}, content, 0});
  }
  for (Node& node : nodes_) {
    for (Name& name : node.names) name.safe = true;
    for (Piece& piece : node.pieces) piece.safe = true;
  }
}

int Disk::make(bool folder) {
  nodes_.emplace_back().folder = folder;
  return static_cast<int>(nodes_.size()) - 1;
}

Disk::Place Disk::place_of(const std::string& path) const {
  const std::size_t slash = path.rfind('/');
  if (slash == path.npos) return {0, path};
  return {find(path.substr(0, slash)), path.substr(slash + 1)};
}

int Disk::find(const std::string& path) const {
  if (path.empty()) return 0;
  const Place place = place_of(path);
  if (place.folder < 0) return -1;
  const auto& entries = nodes_[static_cast<std::size_t>(place.folder)].entries;
  const auto found = entries.find(place.name);
  return found == entries.end() ? -1 : found->second;
}

void Disk::set(const Place& place, int node) {
  if (place.folder < 0) throw std::runtime_error("the log names a folder that is not there: " + place.name);
  Node& folder = nodes_[static_cast<std::size_t>(place.folder)];
  folder.names.push_back({place.name, node, false});
  if (node < 0)
    folder.entries.erase(place.name);
  else
    folder.entries[place.name] = node;
}

void Disk::apply(const Operation& operation) {
  const int node = find(operation.path);
  switch (operation.what) {
    case 'c':
    case 'd':
      if (node < 0) set(place_of(operation.path), make(operation.what == 'd'));
      break;
    case 'u':
      if (node > 0) set(place_of(operation.path), -1);
      break;
    case 'r':
      if (node <= 0) break;
      set(place_of(operation.to), node);
      set(place_of(operation.path), -1);
      break;
    case 't':
    case 'w':
      if (node > 0)
        nodes_[static_cast<std::size_t>(node)].pieces.push_back(
            {operation.what == 't', operation.offset, operation.data, false});
      break;
    case 's':
      if (node < 0) break;
      for (Name& name : nodes_[static_cast<std::size_t>(node)].names) name.safe = true;
      for (Piece& piece : nodes_[static_cast<std::size_t>(node)].pieces) piece.safe = true;
      break;
    default:
      throw std::runtime_error("unknown operation in the log");
  }
}

FileTree Disk::after_cut(const Loss& loss) const {
  std::mt19937 random(loss.seed);
  FileTree out;
  const auto content_of = [&](const Node& node) {
    std::string content;
    for (const Piece& piece : node.pieces) {
      Loss::Data fate = piece.safe ? Loss::Data::kept : loss.data;
      if (fate == Loss::Data::random) fate = static_cast<Loss::Data>(random() % 4);
      if (fate == Loss::Data::dropped) continue;
      if (piece.truncates) {
        content.resize(piece.offset, '\0');
        continue;
      }
      std::string data = piece.data;
      if (fate == Loss::Data::halved) data.resize(data.size() / 2);
      if (fate == Loss::Data::zeroed) data.assign(data.size(), '\0');
      if (content.size() < piece.offset + data.size()) content.resize(piece.offset + data.size(), '\0');
      content.replace(piece.offset, data.size(), data);
    }
    return content;
  };
  const std::function<void(const Node&, const std::string&)> visit = [&](const Node& folder, const std::string& path) {
    std::size_t kept = folder.names.size();
    if (loss.names != Loss::Names::kept) {
      std::size_t safe = 0;
      for (std::size_t i = 0; i < folder.names.size(); ++i)
        if (folder.names[i].safe) safe = i + 1;
      kept = loss.names == Loss::Names::dropped ? safe : safe + random() % (folder.names.size() - safe + 1);
    }
    std::map<std::string, int> entries;
    for (std::size_t i = 0; i < kept; ++i)
      if (folder.names[i].node < 0)
        entries.erase(folder.names[i].name);
      else
        entries[folder.names[i].name] = folder.names[i].node;
    for (const auto& [name, number] : entries) {
      const Node& node = nodes_[static_cast<std::size_t>(number)];
      if (node.folder)
        visit(node, path + name + "/");
      else
        out[path + name] = content_of(node);
    }
  };
  visit(nodes_.front(), "");
  return out;
}

Versions named_in(const FileTree& before, const std::vector<Operation>& log) {
  Versions out;
  Disk disk(before);
  for (const Operation& operation : log) {
    disk.apply(operation);
    if (operation.what != 'r' || is_hidden(operation.to)) continue;
    const FileTree now = disk.after_cut({});
    if (const auto file = now.find(operation.to); file != now.end()) out[file->first].insert(file->second);
  }
  return out;
}

}  // namespace treadmark::testing
