#include "core/restart/checkpoint.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "core/base/error.hpp"
#include "core/io/atomic_file.hpp"

namespace treejet {

namespace fs = std::filesystem;

namespace {

constexpr const char *newest = "checkpoint", *older = "checkpoint.old", *unfinished = "checkpoint.new";

/// In front of the bytes. The number changes with the layout of what follows.
constexpr std::string_view title = "treejet checkpoint 4\n";

struct Seal {
  std::uint64_t byte_order = 0x0102030405060708, length = 0, checksum = 0;
};

std::uint64_t checksum(std::string_view bytes) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

}  // namespace

bool CheckpointParts::has(const std::string& name) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.name == name; });
}

const std::string& CheckpointParts::bytes(const std::string& name) const {
  for (const Part& part : parts_)
    if (part.name == name) return part.bytes;
  throw FileError(fmt::format("the checkpoint does not tell the state of: {}", name));
}

Checkpoint read_checkpoint(const fs::path& file) {
  const auto refuse = [&](std::string_view why) {
    throw FileError(fmt::format("{}: {}", file.string(), why));
  };
  const std::string bytes = read_whole(file);
  const std::string_view all = bytes;
  constexpr std::string_view ours = title.substr(0, title.rfind(' '));
  if (!all.starts_with(title.substr(0, std::min(title.size(), all.size()))))
    refuse(all.starts_with(ours) ? "a checkpoint of another version of Treejet, which this one cannot read"
                                 : "not a checkpoint of Treejet");
  Seal seal;
  if (all.size() < title.size() + sizeof seal) refuse("cut short");
  std::memcpy(&seal, all.data() + title.size(), sizeof seal);
  const std::string_view payload = all.substr(title.size() + sizeof seal);
  if (seal.byte_order != Seal().byte_order) refuse("a checkpoint of a machine with another byte order");
  if (payload.size() < seal.length)
    refuse(fmt::format("cut short: {} of {} bytes", payload.size(), seal.length));
  if (payload.size() > seal.length || checksum(payload) != seal.checksum) refuse("damaged: wrong checksum");
  Checkpoint checkpoint;
  const std::string body(payload);
  Archive archive(body);
  archive(checkpoint);
  archive.expect_end();
  return checkpoint;
}

Checkpoint newest_checkpoint(const fs::path& directory, std::vector<std::string>& warnings) {
  for (const char* name : {newest, older}) {
    std::error_code error;
    if (!fs::exists(directory / name, error)) continue;
    try {
      return read_checkpoint(directory / name);
    } catch (const FileError& failure) {
      warnings.push_back(failure.what());
    }
  }
  if (warnings.empty())
    throw FileError(fmt::format("{}: no checkpoint here; a run that has come to its end leaves none",
                                directory.string()));
  std::string text = fmt::format("{}: no sound checkpoint here", directory.string());
  for (const auto& warning : warnings) text += fmt::format("\n  {}", warning);
  throw FileError(text);
}

Checkpoints::Checkpoints(fs::path directory, OutputFile::Existing existing)
    : directory_(std::move(directory)) {
  std::error_code error;
  const bool there = fs::exists(directory_ / newest, error) || fs::exists(directory_ / older, error);
  if (existing == OutputFile::Existing::keep && there) {
    throw FileError(fmt::format(
        "{}: a run was stopped here; continue it with: treejet run --resume {}, or replace it with --force",
        directory_.string(), directory_.string()));
  }
}

void Checkpoints::write(Checkpoint& checkpoint) const {
  Archive archive;
  archive(checkpoint);
  const std::string payload = std::move(archive).bytes();
  const Seal seal{.length = payload.size(), .checksum = checksum(payload)};
  std::error_code error;
  fs::remove(directory_ / unfinished, error);  // a link goes itself, not what it leads to
  OutputFile file(directory_ / unfinished, OutputFile::Existing::keep);
  file.write(title);
  file.write({reinterpret_cast<const char*>(&seal), sizeof seal});
  file.write(payload);
  file.sync();
  if (fs::exists(directory_ / newest, error)) put_in_place(directory_ / newest, directory_ / older);
  put_in_place(directory_ / unfinished, directory_ / newest);
  force_to_disk(directory_);
}

void Checkpoints::remove() const {
  for (const char* name : {unfinished, newest, older}) {
    std::error_code error;
    fs::remove(directory_ / name, error);
  }
}

}  // namespace treejet
