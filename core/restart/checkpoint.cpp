#include "core/restart/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fstream>

#include "core/base/compression.hpp"
#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/io/atomic_file.hpp"

namespace treejet {

namespace fs = std::filesystem;

namespace {

constexpr const char *newest = checkpoint_names[0], *older = checkpoint_names[1], *last = checkpoint_names[2];
constexpr const char* unfinished = "checkpoint.new";

/// In front of the bytes. The number changes with the layout of what follows.
constexpr std::string_view title = "treejet checkpoint 6\n";

struct Seal {
  std::uint64_t byte_order = 0x0102030405060708, length = 0, checksum = 0;
};

/// In front of a record; the checksum is that of the numbers before it and of the record.
struct RecordSeal {
  std::int64_t first = 0, count = 0;
  std::uint64_t length = 0, checksum = 0;
};

template <class T>
std::string_view bytes_of(const T& plain) {
  return {reinterpret_cast<const char*>(&plain), sizeof plain};
}

std::uint64_t checksum(const Seal&, std::string_view body) {
  return crc32(body);
}

std::uint64_t checksum(const RecordSeal& seal, std::string_view record) {
  return crc32(record, crc32(bytes_of(seal).substr(0, offsetof(RecordSeal, checksum))));
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

namespace {

[[noreturn]] void refuse(const fs::path& file, std::string_view why) {
  throw FileError(fmt::format("{}: {}", file.string(), why));
}

/// A checkpoint read from its beginning to its end, never all of it at once.
class Reader {
 public:
  explicit Reader(const fs::path& file) : file_(file), stream_(file, std::ios::binary) {
    std::error_code kind, error;
    if (!fs::is_regular_file(file, kind)) refuse(file, "cannot be read: not a regular file");
    size_ = fs::file_size(file, error);
    if (error || !stream_) refuse(file, "cannot be read");
  }

  std::uint64_t left() const { return size_ - at_; }
  std::string bytes(std::uint64_t length) {
    if (left() < length) refuse(file_, fmt::format("cut short: {} of {} bytes", left(), length));
    std::string found(length, '\0');
    stream_.read(found.data(), static_cast<std::streamsize>(length));
    if (!stream_) refuse(file_, "cannot be read");
    at_ += length;
    return found;
  }
  template <class SomeSeal>
  std::string sealed(const SomeSeal& seal) {
    std::string found = bytes(seal.length);
    if (checksum(seal, found) != seal.checksum) refuse(file_, "damaged: wrong checksum");
    return found;
  }
  template <class T>
  T plain() {
    T value;
    std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
    return value;
  }
  void pass_over(std::uint64_t length) {
    if (left() < length) refuse(file_, fmt::format("cut short: {} of {} bytes", left(), length));
    stream_.seekg(static_cast<std::streamoff>(length), std::ios::cur);
    at_ += length;
  }

 private:
  fs::path file_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, at_ = 0;
};

/// The head, up to the records.
Checkpoint read_head(Reader& reader, const fs::path& file) {
  const std::string begin = reader.bytes(std::min<std::uint64_t>(title.size(), reader.left()));
  constexpr std::string_view ours = title.substr(0, title.rfind(' '));
  if (!begin.starts_with(title.substr(0, begin.size())))
    refuse(file, begin.starts_with(ours)
                     ? "a checkpoint of another version of Treejet, which this one cannot read"
                     : "not a checkpoint of Treejet");
  if (begin.size() < title.size() || reader.left() < sizeof(Seal)) refuse(file, "cut short");
  const auto seal = reader.plain<Seal>();
  if (seal.byte_order != Seal().byte_order) refuse(file, "a checkpoint of a machine with another byte order");
  Checkpoint checkpoint;
  const std::string body = reader.sealed(seal);
  Archive archive(body);
  archive(checkpoint);
  archive.expect_end();
  checkpoint.file = file;
  return checkpoint;
}

/// The records that are wanted: all `take` needs to know of the others is how many there are.
void read_records(Reader& reader, std::int64_t records,
                  const std::function<bool(std::int64_t record, const RecordSeal&)>& wanted,
                  const std::function<void(const SubdomainRecord&)>& take) {
  for (std::int64_t k = 0; k < records; ++k) {
    const auto seal = reader.plain<RecordSeal>();
    if (wanted(k, seal))
      take({seal.first, seal.count, reader.sealed(seal)});
    else
      reader.pass_over(seal.length);
  }
}

}  // namespace

Checkpoint read_checkpoint(const fs::path& file, const Readers& readers) {
  Reader reader(file);
  Checkpoint checkpoint = read_head(reader, file);
  read_records(
      reader, checkpoint.records,
      [&](std::int64_t k, const RecordSeal&) { return k % readers.count == readers.number; },
      [](const SubdomainRecord&) {});
  if (reader.left() > 0) refuse(file, "damaged: bytes behind its end");
  return checkpoint;
}

ReadRecords records_of(const Checkpoint& checkpoint) {
  return [file = checkpoint.file, records = checkpoint.records](const auto& wanted, const auto& take) {
    Reader reader(file);
    read_head(reader, file);
    read_records(
        reader, records, [&](std::int64_t, const RecordSeal& seal) { return wanted(seal.first, seal.count); },
        take);
  };
}

/// Null, and why, if it is not sound for all readers.
std::optional<Checkpoint> sound_checkpoint(const fs::path& file, std::vector<std::string>& warnings,
                                           const Readers& readers) {
  std::optional<Checkpoint> checkpoint;
  std::string why = fmt::format("{}: not sound as another process reads it", file.string());
  try {
    checkpoint = read_checkpoint(file, readers);
  } catch (const FileError& failure) {
    why = failure.what();
  }
  if (readers.all(checkpoint.has_value())) return checkpoint;
  warnings.push_back(why);
  return {};
}

Checkpoint newest_checkpoint(const fs::path& directory, std::vector<std::string>& warnings,
                             const Readers& readers) {
  for (const char* name : checkpoint_names) {
    std::error_code error;
    // where one of the readers sees it, all look
    if (readers.all(!fs::exists(directory / name, error))) continue;
    if (auto checkpoint = sound_checkpoint(directory / name, warnings, readers))
      return *std::move(checkpoint);
  }
  if (warnings.empty()) throw FileError(fmt::format("{}: no checkpoint here", directory.string()));
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
        directory_.string(), for_shell(directory_.string())));
  }
  if (existing == OutputFile::Existing::keep && fs::exists(directory_ / last, error)) {
    throw FileError(
        fmt::format("{}: a run has come to its end here; extend it with: treejet run --resume {} --set "
                    "\"final time ...\", "
                    "or replace it with --force",
                    directory_.string(), for_shell(directory_.string())));
  }
}

void Checkpoints::write(Checkpoint& checkpoint,
                        const std::function<void(const WriteRecord&)>& give_records) const {
  write(checkpoint, give_records, newest);
}

void Checkpoints::write(Checkpoint& checkpoint, const std::function<void(const WriteRecord&)>& give_records,
                        const char* name) const try {
  Seal seal;
  Archive([&seal](std::string_view piece) {
    seal.length += piece.size();
    seal.checksum = crc32(piece, seal.checksum);
  })(checkpoint);
  std::error_code error;
  fs::remove(directory_ / unfinished, error);  // a link goes itself, not what it leads to
  OutputFile file(directory_ / unfinished, OutputFile::Existing::keep);
  file.write(title);
  file.write(bytes_of(seal));
  Archive([&file](std::string_view piece) { file.write(piece); })(checkpoint);
  give_records([&file](const SubdomainRecord& record) {
    const auto& [first, count, bytes] = record;
    RecordSeal seal{first, count, bytes.size()};
    seal.checksum = checksum(seal, bytes);
    file.write(bytes_of(seal));
    file.write(bytes);
  });
  file.sync();
  if (name == newest && fs::exists(directory_ / newest, error))
    put_in_place(directory_ / newest, directory_ / older);
  put_in_place(directory_ / unfinished, directory_ / name);
  force_to_disk(directory_);
} catch (const FileError&) {
  std::error_code error;
  fs::remove(directory_ / unfinished, error);  // a full disk has better use for its room
  throw;
}

void Checkpoints::conclude(Checkpoint* state) const {
  std::error_code error;
  if (state)
    write(
        *state, [](const WriteRecord&) {}, last);
  else
    fs::remove(directory_ / last, error);
  for (const char* name : {unfinished, newest, older}) fs::remove(directory_ / name, error);
}

void Checkpoints::conclude_with_newest() const {
  put_in_place(directory_ / newest, directory_ / last);
  force_to_disk(directory_);
  std::error_code error;
  for (const char* name : {unfinished, older}) fs::remove(directory_ / name, error);
}

void Checkpoints::remove() const {
  for (const char* name : {unfinished, newest, older, last}) {
    std::error_code error;
    fs::remove(directory_ / name, error);
  }
}

}  // namespace treejet
