// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

/// Example programs, run as their users do, and what they leave on disk.
namespace test {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A new, empty folder that is deleted with everything in it.
class Scratch {
 public:
  Scratch() {
    std::string pattern = std::string(SPHMBS_SCRATCH) + "/XXXXXX";
    std::filesystem::create_directories(SPHMBS_SCRATCH);
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot create " + pattern);
    path_ = pattern;
    std::filesystem::create_directory(work());
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  /// Where programs are started.
  std::filesystem::path work() const { return path_ / "work"; }
  /// Everything below work(), in some order.
  std::vector<std::string> found() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(work()))
      names.push_back(entry.path().lexically_relative(work()).string());
    return names;
  }

 private:
  std::filesystem::path path_;
};

/// How a program ended.
struct Ended {
  int code;  // exit code, or -1 after a signal
  std::string out;
  std::string err;
};

/// Starts a program in the scratch folder and waits for it.
inline Ended start(const Scratch& scratch, const std::string& program,
                   const std::vector<std::string>& arguments) {
  const auto quoted = [](const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
  };
  const auto out = scratch.path() / "out";
  const auto err = scratch.path() / "err";
  std::string command = "cd " + quoted(scratch.work().string()) + " && exec " + quoted(program);
  for (const std::string& word : arguments) command += " " + quoted(word);
  command += " >" + quoted(out.string()) + " 2>" + quoted(err.string()) + " </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
}

/// A history.csv.
struct Table {
  std::string comment;
  std::vector<std::string> head;
  std::vector<std::vector<double>> rows;

  std::vector<double> column(std::string_view name) const {
    for (std::size_t k = 0; k < head.size(); ++k) {
      if (head[k] != name) continue;
      std::vector<double> values;
      for (const auto& row : rows) values.push_back(row[k]);
      return values;
    }
    throw std::runtime_error("no column " + std::string(name));
  }
};

/// @throws std::runtime_error for a table with a row of another length or text that is no number.
inline Table table_of(const std::filesystem::path& path) {
  const auto split = [](const std::string& line) {
    std::vector<std::string> words;
    std::istringstream stream(line);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
  };
  Table table;
  for (const std::string& line : lines_of(text_of(path))) {
    if (line.starts_with('#')) {
      table.comment = line;
    } else if (table.head.empty()) {
      table.head = split(line);
    } else {
      std::vector<double> row;
      for (const std::string& word : split(line)) {
        std::size_t read = 0;
        row.push_back(std::stod(word, &read));
        if (read != word.size()) throw std::runtime_error("no number: " + word);
      }
      if (row.size() != table.head.size()) throw std::runtime_error("short row: " + line);
      table.rows.push_back(row);
    }
  }
  return table;
}

/// The times of a list of files, a .pvd, and the files they belong to.
inline std::map<double, std::string> files_of(const std::filesystem::path& list) {
  std::map<double, std::string> files;
  const auto value = [](const std::string& line, const std::string& key) {
    const std::size_t from = line.find(key + "=\"") + key.size() + 2;
    return line.substr(from, line.find('"', from) - from);
  };
  for (const std::string& line : lines_of(text_of(list)))
    if (line.find("<DataSet ") != std::string::npos)
      files[std::stod(value(line, "timestep"))] = value(line, "file");
  return files;
}

/// Those of a run of gas.
inline std::map<double, std::string> fields_of(const std::filesystem::path& folder) {
  return files_of(folder / "fields.pvd");
}

/// Particles in a .vtp file, from its head; throws std::runtime_error if it is cut short.
inline long points_of(const std::filesystem::path& path) {
  const std::string text = text_of(path);
  const std::string key = "NumberOfPoints=\"";
  const std::size_t at = text.find(key);
  if (at == std::string::npos || !text.starts_with("<?xml") ||
      text.find("</VTKFile>", text.size() - 40) == std::string::npos)
    throw std::runtime_error("not a whole VTP file: " + path.string());
  return std::stol(text.substr(at + key.size(), 20));
}

/// Whether a picture is there, of its type, and holds something.
inline bool is_picture(const std::filesystem::path& path) {
  const std::string text = text_of(path);
  const bool typed = path.extension() == ".png" ? text.starts_with("\x89PNG\r\n")
                                                : text.find("<svg") != std::string::npos;
  return typed && text.size() > 5000;  // an empty picture of these sizes takes less
}

inline nlohmann::ordered_json summary_of(const std::filesystem::path& folder) {
  return nlohmann::ordered_json::parse(text_of(folder / "summary.json"));
}

/// Keys of an object in their order.
inline std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

}  // namespace test
