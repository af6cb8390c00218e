#pragma once
/// A directory of its own for a test, gone with it; and what a file in it holds.

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace treejet {

struct Place {
  Place() {
    static int number = 0;
    path = std::filesystem::temp_directory_path() / fmt::format("treejet-test-{}-{}", ::getpid(), number++);
    std::filesystem::create_directories(path);
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace treejet
