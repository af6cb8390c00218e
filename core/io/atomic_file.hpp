#pragma once
/// Files that are there whole or not at all: written under another name, then renamed over the old one.
/// Errors: FileError; the old file stays.

#include <filesystem>
#include <string>
#include <string_view>

namespace treejet {

std::string read_whole(const std::filesystem::path& path);
void write_whole(const std::filesystem::path& path, std::string_view text);

/// Puts a finished file in the place of another, at one instant.
void put_in_place(const std::filesystem::path& fresh, const std::filesystem::path& path);

/// Forces a file, or the names in a directory, to disk.
void force_to_disk(const std::filesystem::path& path);

}  // namespace treejet
