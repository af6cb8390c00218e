#pragma once
/// `treejet info`: what a file of ours contains and what made it, recognised by its content, not by its name.
///
/// FileError if it is none of ours, or cut short: the message says where.

#include <filesystem>
#include <string>

namespace treejet {

std::string file_info(const std::filesystem::path& path);

}  // namespace treejet
