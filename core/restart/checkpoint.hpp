#pragma once
/// Checkpoints: the state of a run in a file, from which it goes on as if nothing had happened.
///
/// The two newest stand beside the results, as `checkpoint` and `checkpoint.old`. A new one is written under
/// another name, forced to disk and only then renamed, so that at any moment at least one is whole. A run
/// that has come to its end leaves `checkpoint.end` alone: the state before the first step that the final
/// time shortened, from which a run to a later one takes the same steps. The file: a line of text with the
/// format's number, the length and the checksum (CRC-32) of what follows, and that, as core/base/archive.hpp
/// writes it: which program and deck made it, and the state in named parts. Of a chain that ranks hold in
/// subdomains the beads come behind that, in records with lengths and checksums of their own
/// (core/jet/decomposition.hpp), so that nobody ever holds more of them than a record and what is his.

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/archive.hpp"
#include "core/base/output_file.hpp"
#include "core/jet/decomposition.hpp"

namespace treejet {

/// The state of a run in named parts, written or read by the same list of them. Whoever reads takes the parts
/// it knows: a rank without files needs no positions in them.
class CheckpointParts {
 public:
  /// To be filled in.
  CheckpointParts() = default;

  template <class T>
  void part(const std::string& name, T& object) {
    if (reading_) {
      Archive archive(bytes(name));
      archive(object);
      archive.expect_end();
    } else {
      parts_.push_back({name, Archive::bytes_of(object)});
    }
  }

  /// Into an object whose state is what a part begins with; the rest is for others.
  template <class T>
  void beginning_of_part(const std::string& name, T& object) const {
    Archive archive(bytes(name));
    archive(object);
  }

  bool has(const std::string& name) const;

  /// The parts, of a state that from now on is to be read.
  void visit(Archive& archive) {
    archive(parts_);
    reading_ = true;
  }

 private:
  struct Part {
    std::string name, bytes;
    void visit(Archive& archive) { archive(name, bytes); }
  };

  const std::string& bytes(const std::string& name) const;

  std::vector<Part> parts_;
  bool reading_ = false;
};

/// The part of the columns that the scene adds, which is there if there are any.
inline constexpr const char* columns_part = "columns";
/// The part that tells where the run's field map is.
inline constexpr const char* field_map_place = "field map place";
struct SavedColumn {
  std::string name;
  double scale = 1;  ///< what 1 is in CGS
  void visit(Archive& archive) { archive(name, scale); }
};

struct Checkpoint {
  std::string program;  ///< what wrote it
  std::string deck_name, deck_text;
  std::vector<std::string> overrides;
  double t = 0;              ///< s
  std::int64_t records = 0;  ///< that follow
  CheckpointParts state;
  std::filesystem::path file;  ///< that it was read from

  void visit(Archive& archive) { archive(program, deck_name, deck_text, overrides, t, records, state); }
};

/// From the newest to the oldest; the last one is that of a completed run.
inline constexpr std::array<const char*, 3> checkpoint_names{"checkpoint", "checkpoint.old",
                                                             "checkpoint.end"};

/// Several processes that read the same checkpoint: each verifies its share of the records, and it is sound
/// if all say so.
struct Readers {
  int number = 0, count = 1;
  std::function<bool(bool sound)> all = [](bool sound) { return sound; };
};

/// The newest sound checkpoint of a directory, of a completed run its last state, the same for all readers.
/// `warnings` gets a line for each that is newer but not sound; FileError if none is.
Checkpoint newest_checkpoint(const std::filesystem::path& directory, std::vector<std::string>& warnings,
                             const Readers& readers = {});

/// A checkpoint file. FileError if it is cut short, damaged, or none of ours.
Checkpoint read_checkpoint(const std::filesystem::path& file, const Readers& readers = {});

/// The records of a checkpoint that has been read. FileError as above.
ReadRecords records_of(const Checkpoint& checkpoint);

/// The checkpoints of one run.
class Checkpoints {
 public:
  /// FileError if the directory holds checkpoints already and these are to be kept. Changes nothing.
  Checkpoints(std::filesystem::path directory, OutputFile::Existing existing);

  /// `give_records` hands over as many records as the checkpoint says.
  void write(
      Checkpoint& checkpoint,
      const std::function<void(const WriteRecord&)>& give_records = [](const WriteRecord&) {}) const;
  /// The run has come to its end, and leaves this state.
  void conclude(Checkpoint* last) const;
  /// The same with the newest checkpoint, which is that state.
  void conclude_with_newest() const;
  /// The run takes the place of another.
  void remove() const;

 private:
  void write(Checkpoint& checkpoint, const std::function<void(const WriteRecord&)>& give_records,
             const char* name) const;
  std::filesystem::path directory_;
};

}  // namespace treejet
