/// Checkpoints, as they are and with lengths and checksums made right: what the state itself says must be
/// checked, too. One that is read can be told about, be the origin of another run, and be taken up.

#include <cstring>

#include "core/commands/file_info.hpp"
#include "core/io/atomic_file.hpp"
#include "core/restart/origin.hpp"
#include "core/restart/resume.hpp"
#include "forces/scene/scene.hpp"
#include "integrators/run/integration.hpp"
#include "validation/fuzz/target.hpp"
#include "validation/support/scratch_directory.hpp"

namespace treejet::fuzz {

namespace {

/// As in core/restart/checkpoint.cpp: behind the title byte order, length and checksum of the body; in front
/// of each record its beads, length and checksum, which is also that of the three numbers before it.
constexpr std::size_t title = 21, seal = 24, record_seal = 32;

std::uint64_t number(const std::string& bytes, std::size_t at) {
  std::uint64_t value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

void put(std::string& bytes, std::size_t at, std::uint64_t value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// CRC-32 (ISO 3309), of bytes that follow others.
std::uint64_t checksum(const std::string& bytes, std::size_t at, std::size_t length,
                       std::uint64_t before = 0) {
  auto sum = ~static_cast<std::uint32_t>(before);
  for (const char c : std::string_view(bytes).substr(at, length)) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320 : 0);
  }
  return static_cast<std::uint32_t>(~sum);
}

/// With the sums that the bytes have, and lengths that they hold.
std::string sealed(std::string bytes) {
  if (bytes.size() < title + seal) return bytes;
  const std::size_t body = title + seal;
  const std::uint64_t length = std::min<std::uint64_t>(number(bytes, title + 8), bytes.size() - body);
  put(bytes, title + 8, length);
  put(bytes, title + 16, checksum(bytes, body, length));
  for (std::size_t at = body + length; bytes.size() - at >= record_seal;) {
    const std::uint64_t of_record =
        std::min<std::uint64_t>(number(bytes, at + 16), bytes.size() - at - record_seal);
    put(bytes, at + 16, of_record);
    put(bytes, at + 24, checksum(bytes, at + record_seal, of_record, checksum(bytes, at, 24)));
    at += record_seal + of_record;
  }
  return bytes;
}

/// The jet that another run of this deck begins with.
template <int D>
void begin(const Origin& o, const Parameters& p) {
  const Jet<D> jet = jet_of<D>(o, p);
  demand(jet.size() > 0 && complete(jet), "each bead has its constants");
  demand(jet.y.allFinite(), "the beads are somewhere");
}

void take_as_origin(const std::filesystem::path& file) {
  const Origin o = origin(file.string());
  Parameters p = o.deck.parameters;
  p.final_time = 1e9;
  p.system == 1 ? begin<1>(o, p) : begin<3>(o, p);
}

/// Scenes are made for as many beads as a deck says, which is not what is in question here.
bool is_small(const Parameters& p) {
  return p.points.value_or(1) <= 100 && (!p.resolution || p.initial_length / *p.resolution <= 100) &&
         p.field_map.empty() && p.parallel == ParallelData::replicated;
}

template <int D>
void take_up(Checkpoint& checkpoint, const Parameters& p) {
  Scene<D> scene = compose<D>(p, {1});
  Integration<D> integration(p, system(scene));
  checkpoint.state.part("march", integration.march);
  checkpoint.state.part("march", integration.march);
}

void read(const std::string& bytes) {
  const auto& file = as_file(bytes);
  is_read([&] { file_info(file); });
  is_read([&] { take_as_origin(file); });
  is_read([&] {
    Checkpoint checkpoint = read_checkpoint(file);
    std::int64_t records = 0;
    records_of(checkpoint)([](auto, auto) { return true; }, [&](const SubdomainRecord&) { ++records; });
    demand(records == std::max<std::int64_t>(0, checkpoint.records), "there are as many records as it says");
    const Parameters p =
        parse_deck(checkpoint.deck_text, checkpoint.deck_name, checkpoint.overrides).parameters;
    if (!is_small(p)) return;
    p.system == 1 ? take_up<1>(checkpoint, p) : take_up<3>(checkpoint, p);
  });
}

}  // namespace

std::vector<std::string> checkpoints() {
  std::vector<std::string> all;
  for (const char* name : {"checkpoint", "checkpoint.end"})
    for (auto& one : files_of_runs(name)) all.push_back(std::move(one));
  const ScratchDirectory place;
  Checkpoint in_records{"program", "deck", "finish\n", {"tolerance 1.d-5"}, 0.1, 2, {}, {}};
  Checkpoints(place.path, OutputFile::Existing::keep).write(in_records, [](const WriteRecord& write) {
    write({0, 2, "two beads"});
    write({2, 1, "one"});
  });
  all.push_back(read_whole(place.path / "checkpoint"));
  return all;
}

void feed_checkpoint(std::string_view bytes) {
  const std::string own(bytes);
  is_read([&] { read_checkpoint(as_file(own)); });
  read(sealed(own));
}

}  // namespace treejet::fuzz
