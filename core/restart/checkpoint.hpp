#pragma once
/// Checkpoints: the state of a run in a file, from which it goes on as if nothing had happened.
///
/// The two newest stand beside the results, as `checkpoint` and `checkpoint.old`. A new one is written under
/// another name, forced to disk and only then renamed, so that at any moment at least one is whole; a run
/// that has come to its end leaves none. The file: a line of text with the format's number, the length and
/// the checksum (CRC-32) of what follows, and that, as core/base/archive.hpp writes it: which program and
/// deck made it, and the state in named parts.

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/archive.hpp"
#include "core/base/output_file.hpp"

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
      Archive archive;
      archive(object);
      parts_.push_back({name, std::move(archive).bytes()});
    }
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

struct Checkpoint {
  std::string program;  ///< what wrote it
  std::string deck_name, deck_text;
  std::vector<std::string> overrides;
  double t = 0;  ///< s
  CheckpointParts state;

  void visit(Archive& archive) { archive(program, deck_name, deck_text, overrides, t, state); }
};

/// The newest sound checkpoint of a directory. `warnings` gets a line for each that is newer but not sound;
/// FileError if none is.
Checkpoint newest_checkpoint(const std::filesystem::path& directory, std::vector<std::string>& warnings);

/// A checkpoint file. FileError if it is cut short, damaged, or none of ours.
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// The checkpoints of one run.
class Checkpoints {
 public:
  /// FileError if the directory holds checkpoints already and these are to be kept. Changes nothing.
  Checkpoints(std::filesystem::path directory, OutputFile::Existing existing);

  void write(Checkpoint& checkpoint) const;
  /// The run has come to its end, or takes the place of another.
  void remove() const;

 private:
  std::filesystem::path directory_;
};

}  // namespace treejet
