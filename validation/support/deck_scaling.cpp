#include "validation/support/deck_scaling.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/restart/origin.hpp"
#include "validation/support/deck_run.hpp"

namespace treejet {

namespace {

class Teams {
 public:
  Teams(const DeckScaling& asked, bool distributable)
      : replicated_(asked.data != "distributed"), distributed_(asked.data != "replicated" && distributable) {}

  void add(RankLayout layout) {
    if (layout.ranks > 1 && mpi_launcher().empty())
      throw InputError(
          "--ranks: this program was built without MPI; give --threads, or build it with -DTREEJET_MPI=ON");
    if (replicated_ || layout.ranks == 1) put({layout, false});
    if (distributed_ && layout.ranks > 1) put({layout, true});
  }
  void add_copies(int count) {
    if (count > 1) put({{count, 1}, false, true});
  }

  std::vector<Workers> all = {Workers{{1, 1}}};

 private:
  void put(const Workers& team) {
    const bool there = std::any_of(all.begin(), all.end(), [&](const Workers& t) {
      return t.layout.ranks == team.layout.ranks && t.layout.threads == team.layout.threads &&
             t.subdomains == team.subdomains && t.copies == team.copies;
    });
    if (!there) all.push_back(team);
  }

  bool replicated_, distributed_;
};

}  // namespace

std::string undistributable(const DeckScaling& asked) try {
  if (asked.data == "replicated") return "--data replicated";
  deck_of({.deck = asked.deck, .overrides = asked.overrides, .directory = {}, .subdomains = true});
  return {};
} catch (const InputError& e) {
  return e.what();
}

void require_valid(const DeckScaling& asked) {
  deck_of({.deck = asked.deck, .overrides = asked.overrides, .directory = {}});
  if (!asked.from.empty()) origin(asked.from);
  if (asked.data != "distributed") return;
  if (const std::string why = undistributable(asked); !why.empty()) throw InputError(why);
}

std::string Workers::name() const {
  if (layout.serial()) return "serial";
  if (copies) return "copies";
  if (subdomains) return "distributed";
  return layout.threads == 1 ? "ranks" : layout.ranks == 1 ? "threads" : "mixed";
}

std::vector<Workers> teams(const DeckScaling& asked, int cores, bool distributable) {
  Teams teams(asked, distributable);
  std::vector<int> workers = asked.workers;
  const bool products = !asked.ranks.empty() || !asked.threads.empty();
  if (workers.empty() && !products)
    for (int p = 1; p <= cores; p *= 2) workers.push_back(p);
  for (int p : workers) {
    teams.add({1, p});
    if (!mpi_launcher().empty()) teams.add({p, 1});
    if (p <= cores) teams.add_copies(p);
  }
  if (products)
    for (int r : asked.ranks.empty() ? std::vector<int>{1} : asked.ranks)
      for (int t : asked.threads.empty() ? std::vector<int>{1} : asked.threads) teams.add({r, t});
  return std::move(teams.all);
}

}  // namespace treejet
