#include "core/io/run_record.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/deck/directives.hpp"
#include "core/io/atomic_file.hpp"

namespace treejet {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* format_name = "treejet run record 1";

std::string now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::now()));
}

std::string host() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

Json deck_of(const Provenance& p) {
  return {{"name", p.deck_name}, {"text", p.deck}, {"overrides", p.overrides}};
}

Json record_of(const RunRecord::Setting& s) {
  const Provenance& p = s.made_by;
  Json record = {{"format", format_name},     {"program", program(p)},    {"version", p.version},
                 {"commit", p.commit},        {"compiler", p.compiler},   {"build", p.build},
                 {"vector_path", p.isa_name}, {"libraries", p.libraries}, {"deck", deck_of(p)},
                 {"files", s.files},          {"segments", Json::array()}};
  if (!p.begins_with.empty()) record["begins_with"] = p.begins_with;
  if (!p.field_map.empty()) record["field_map"] = p.field_map;
  return record;
}

Json read_record(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw FileError(fmt::format("{}: cannot be read", path.string()));
  const Json record = Json::parse(file, nullptr, /*allow_exceptions*/ false);
  if (record.is_discarded()) throw FileError(fmt::format("{}: cut short, or no JSON", path.string()));
  if (!record.is_object() || record.value("format", Json()) != Json(format_name))
    throw FileError(fmt::format("{}: JSON, but no run record of treejet", path.string()));
  return record;
}

/// The record to add a segment to; a new one where it is damaged, as that must not keep a run from going on.
Json record_to_continue(const RunRecord::Setting& s, const fs::path& path) try {
  Json record = read_record(path);
  const Json segments = record.value("segments", Json());
  const bool sound = segments.is_array() && std::all_of(segments.begin(), segments.end(),
                                                        [](const Json& one) { return one.is_object(); });
  return sound ? record : record_of(s);
} catch (const std::exception&) {
  return record_of(s);
}

/// A deck may hold bytes of any encoding; JSON only UTF-8.
void write(const fs::path& path, const Json& record) {
  write_whole(path, fmt::format("{}\n", record.dump(2, ' ', false, Json::error_handler_t::replace)));
}

}  // namespace

RunRecord::RunRecord(const Setting& setting) : path_(setting.directory / run_record_name) {
  using Existing = OutputFile::Existing;
  std::error_code error;
  const bool there = fs::exists(path_, error);
  if (there && setting.existing == Existing::keep) throw exists_already(path_);
  Json record =
      there && setting.existing == Existing::resume ? record_to_continue(setting, path_) : record_of(setting);
  for (const char* of_a_completed_run : {"effort", "fixed_step", "means", "error_estimate"})
    record.erase(of_a_completed_run);
  record["deck"] = deck_of(setting.made_by);  // the end of a run that is extended changes
  record["segments"].push_back({{"started", now()},
                                {"host", host()},
                                {"ranks", setting.circumstances.ranks},
                                {"threads", setting.circumstances.threads},
                                {"outcome", "running"}});
  write(path_, record);
}

RunRecord::~RunRecord() {
  try {
    if (!ended_) end(std::uncaught_exceptions() > 0 ? "failed" : "stopped early");
  } catch (const std::exception&) {
    // the record stays as it is; what went wrong with the disk has been told already
  }
}

void RunRecord::complete(const RunResults& results) {
  end("completed", results);
}

void RunRecord::end(const char* outcome, const RunResults& results) {
  ended_ = true;
  Json record = read_record(path_);
  if (!record.contains("segments") || !record["segments"].is_array() || record["segments"].empty() ||
      !record["segments"].back().is_object())
    throw FileError(fmt::format("{}: was changed by another program during the run", path_.string()));
  Json& segment = record["segments"].back();
  segment["outcome"] = outcome;
  segment["ended"] = now();
  segment["wall_seconds"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  for (const auto& [name, seconds] : results.times) segment[name] = seconds;
  for (const auto& [name, seconds] : results.work) segment["work"][name] = seconds;
  for (const auto& [name, count] : results.effort) record["effort"][name] = count;
  for (const auto& [name, value] : results.fixed_step) record["fixed_step"][name] = value;
  for (const RecordedMean& m : results.means)
    record["means"][m.key] = {{"unit", m.unit},     {"mean", m.mean},   {"error", m.error},  {"from", m.from},
                              {"values", m.values}, {"block", m.block}, {"steady", m.steady}};
  write(path_, record);
}

void record_errors(const fs::path& directory, const std::string& against,
                   const std::vector<ErrorOfObservable>& errors) {
  Json record = read_record(directory / run_record_name), observables = Json::object();
  for (const ErrorOfObservable& e : errors)
    observables[e.label] = {{"row", e.of_a_row},
                            {"mean", e.mean},
                            {"of_mean", e.of_mean},
                            {"from_row", e.from_row},
                            {"steady", e.steady}};
  record["error_estimate"] = {{"against", against}, {"observables", observables}};
  write(directory / run_record_name, record);
}

std::vector<std::string> recorded_files(const fs::path& directory) try {
  auto names = read_record(directory / run_record_name).at("files").get<std::vector<std::string>>();
  names.emplace_back(run_record_name);
  return names;
} catch (const std::exception&) {
  return {};
}

bool has_completed(const fs::path& directory) try {
  const Json record = read_record(directory / run_record_name);
  return record.at("segments").back().at("outcome") == "completed";
} catch (const std::exception&) {
  return false;
}

std::string run_record_text(const fs::path& path) try {
  const Json record = read_record(path);
  std::string text = "record of a run\n";
  for (const Json& s : record.at("segments")) {
    text += fmt::format("{}  on {}, {} ranks of {} threads: {}", s.at("started").get<std::string>(),
                        s.at("host").get<std::string>(), s.at("ranks").get<int>(), s.at("threads").get<int>(),
                        s.at("outcome").get<std::string>());
    text +=
        s.contains("wall_seconds") ? fmt::format(" after {:.4g} s\n", s["wall_seconds"].get<double>()) : "\n";
  }
  text += "files";
  for (const Json& f : record.at("files")) text += fmt::format(" {}", f.get<std::string>());
  const Json& deck = record.at("deck");
  const Provenance p{record.at("version"),
                     record.at("commit"),
                     record.at("compiler"),
                     record.at("build"),
                     record.at("vector_path"),
                     record.at("libraries"),
                     deck.at("name"),
                     deck.at("text"),
                     deck.at("overrides"),
                     record.value("begins_with", ""),
                     record.value("field_map", "")};
  return fmt::format("{}\n{}", text, description(p));
} catch (const Json::exception& e) {
  throw FileError(fmt::format("{}: a run record with something missing: {}", path.string(), e.what()));
}

std::string check_record(const Deck& deck, const std::vector<SheetRow>& laboratory,
                         const std::vector<SheetRow>& plan) {
  const auto object = [](const std::vector<SheetRow>& rows) {
    Json all = Json::object();
    for (const SheetRow& row : rows) {
      Json& entry = all[row.key] = {{"value", row.value}, {"unit", row.unit}};
      if (!row.meaning.empty()) entry["meaning"] = row.meaning;
      if (!row.warning.empty()) entry["warning"] = row.warning;
    }
    return all;
  };
  std::vector<std::string> notes;  // they begin with the name of the deck
  for (const std::string& note : deck.notes) notes.push_back(utf8(note));
  Json values = Json::object();
  for (const Directive& d : directives())
    if (const std::string value = value_text(d, deck.parameters); !value.empty())
      values[std::string(d.words)] = value;
  const Json record = {
      {"format", "treejet check 1"}, {"deck", utf8(deck.name)}, {"overrides", deck.overrides},
      {"directives", values},        {"notes", notes},          {"laboratory", object(laboratory)},
      {"plan", object(plan)}};
  return record.dump(2);
}

}  // namespace treejet
