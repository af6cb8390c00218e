#include "core/commands/companions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <vector>

#include "core/base/error.hpp"

namespace treejet {

namespace {

namespace fs = std::filesystem;

constexpr std::array modules{"numpy", "h5py", "matplotlib"};

std::vector<char*> terminated(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

fs::path package_directory(const fs::path& program) {
  const fs::path installed = program.parent_path().parent_path() / "share" / "treejet" / "python";
  const fs::path checkout = program.parent_path().parent_path().parent_path() / "python";
  for (const fs::path& place : {installed, checkout})
    if (fs::exists(place / "treejet" / "__main__.py")) return place;
  throw FileError(fmt::format("the Python package treejet is neither in {} nor in {}", installed.string(),
                              checkout.string()));
}

bool has_modules(const std::string& python) {
  std::vector<std::string> words{
      python, "-c",
      "import sys, importlib.util as u; sys.exit(any(u.find_spec(m) is None for m in sys.argv[1:]))"};
  words.insert(words.end(), modules.begin(), modules.end());
  pid_t child = 0;
  int status = 0;
  return posix_spawnp(&child, python.c_str(), nullptr, nullptr, terminated(words).data(), environ) == 0 &&
         waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string python_with_modules() {
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (has_modules(python)) return python;
  throw FileError(fmt::format("this command needs Python 3 with {}; on Debian: apt-get install python3-{}",
                              fmt::join(modules, ", "), fmt::join(modules, " python3-")));
}

}  // namespace

void hand_over_to_companion(int argc, char** argv) {
  if (argc < 2 || std::none_of(companions.begin(), companions.end(),
                               [&](const Companion& c) { return std::strcmp(c.word, argv[1]) == 0; }))
    return;
  const fs::path program = fs::read_symlink("/proc/self/exe");
  std::string search = package_directory(program).string();
  if (const char* others = std::getenv("PYTHONPATH"); others && *others) search += fmt::format(":{}", others);
  std::vector<std::string> words{python_with_modules(), "-m", "treejet"};
  words.insert(words.end(), argv + 1, argv + argc);
  setenv("PYTHONPATH", search.c_str(), 1);
  setenv("TREEJET", program.c_str(), 1);
  execvp(words[0].c_str(), terminated(words).data());
  throw FileError(fmt::format("{}: {}", words[0], std::strerror(errno)));
}

}  // namespace treejet
