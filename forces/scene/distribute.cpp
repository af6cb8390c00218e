#include "forces/scene/distribute.hpp"

#include "forces/distributed/distributed_motion.hpp"
#include "forces/scene/coulomb_settings.hpp"

namespace treejet {

void distribute(Scene<3>& scene, const Parameters& p, int beads, const JetOfRows& jet_of, Threads threads,
                const Ranks& ranks, bool two_rates) {
  const Ends ends = two_rates ? Ends{fast_region_old, fast_region_beads - fast_region_old} : Ends{};
  auto subdomains = std::make_unique<ChainDecomposition>(beads, ranks, ends);
  auto motion = std::make_unique<DistributedMotion>(*scene.motion, *subdomains, threads);
  if (groups(p).Q != 0) motion->add_coulomb(groups(p).Q, coulomb_request(p, /*points_move*/ true));
  if (p.refinement && p.self_field == SelfField::slender) subdomains->share_volumes();
  subdomains->keep([field = motion.get()](Archive& state) { field->visit_field(state); });
  if (two_rates) {
    motion->be_continued();
    scene.multirate = std::make_unique<MultirateMotion<3>>(
        *scene.motion, *motion, ErrorNorm(p, scene.columns), ShortWaves(p), *subdomains, p.refinement);
    subdomains->carry([m = scene.multirate.get()](auto first, auto rows) { return m->of_beads(first, rows); },
                      [m = scene.multirate.get()](const auto& table) { m->set_beads(table); });
  }
  scene.jet = jet_of(subdomains->rows());
  scene.distributed_error = motion->error();
  scene.distributed_motion = std::move(motion);
  scene.subdomains = std::move(subdomains);
}

}  // namespace treejet
