#include "validation/fuzz/target.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "core/base/error.hpp"
#include "validation/support/scratch_directory.hpp"

namespace treejet::fuzz {

std::span<const Target> targets() {
  static constexpr Target all[] = {{"deck", feed_deck, decks},
                                   {"checkpoint", feed_checkpoint, checkpoints},
                                   {"trajectory", feed_trajectory, trajectories},
                                   {"points", feed_points, tables_of_points},
                                   {"written", feed_written, written_texts},
                                   {"field-map", feed_field_map, field_maps},
                                   {"quantity", feed_quantity, quantities}};
  return all;
}

const Target& target(std::string_view name) {
  const auto all = targets();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Target& t) { return t.name == name; });
  if (found == all.end()) throw std::logic_error("no such target");
  return *found;
}

void demand(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error("violated: " + what);
}

bool is_read(const std::function<void()>& read) {
  std::string message;
  try {
    read();
    return true;
  } catch (const InputError& error) {
    message = error.what();
  } catch (const FileError& error) {
    message = error.what();
  }
  demand(!message.empty(), "an error has a message");
  return false;
}

const std::filesystem::path& as_file(std::string_view bytes) {
  static const ScratchDirectory place;
  static const std::filesystem::path file = place.path / "input";
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

}  // namespace treejet::fuzz
