#include "core/deck/subdomains.hpp"

#include "core/jet/scales.hpp"

namespace treejet {

std::vector<Obstacle> obstacles_to_subdomains(const Parameters& p) {
  struct Case {
    bool applies;
    Obstacle obstacle;
  };
  const Case cases[] = {
      {p.system == 1, {{"parallel", "system"}, "expected parallel replicated in system 1"}},
      {p.coulomb == CoulombSum::direct,
       {{"parallel", "coulomb"},
        "expected coulomb tree or coulomb auto: a direct sum needs all beads on every rank"}},
      {p.coulomb_expansions == ExpansionKind::none,
       {{"parallel", "coulomb expansions"}, "expected coulomb expansions local"}},
  };
  std::vector<Obstacle> found;
  for (const Case& c : cases)
    if (c.applies) found.push_back(c.obstacle);
  return found;
}

ParallelData data_of_ranks(const Parameters& p, int ranks) {
  if (p.parallel != ParallelData::automatic) return p.parallel;
  const bool worthwhile = ranks > 1 && initial_elements(p) >= beads_worth_a_subdomain * ranks;
  return worthwhile && obstacles_to_subdomains(p).empty() ? ParallelData::distributed
                                                          : ParallelData::replicated;
}

}  // namespace treejet
