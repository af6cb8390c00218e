#include "forces/scene/scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/jet/schemes.hpp"
#include "core/jet/stiffness.hpp"
#include "forces/distributed/distributed_motion.hpp"
#include "forces/scene/coulomb_settings.hpp"
#include "forces/terms/constitutive.hpp"
#include "forces/terms/coulomb_force.hpp"
#include "forces/terms/slender_self_field.hpp"
#include "forces/terms/surface_energy.hpp"
#include "forces/terms/surface_tension.hpp"
#include "forces/terms/uniform.hpp"
#include "forces/terms/viscoelastic.hpp"

namespace treejet {

namespace {

/// A jet that ends for good at its free end has half a cell there. With insertion the end is one of many: a
/// whole bead, as the next one will be.
bool ends_in_half_a_cell(const Parameters& p) {
  return p.self_field == SelfField::slender && !p.inserting;
}

/// Beads at x_i = initial length - i l_step, at the nozzle velocity and stress: those with these numbers.
template <int D>
Jet<D> initial_jet(const Parameters& p, const std::vector<int>& beads, const Columns& added) {
  const Scales s = scales(p);
  const auto n = static_cast<Eigen::Index>(beads.size());
  Vec<D> r = Vec<D>::Zero(), v = Vec<D>::Zero();
  v[0] = p.nozzle_velocity / s.velocity;
  Jet<D> jet;
  jet.y.resize(n, own_columns<D> + static_cast<Eigen::Index>(added.size()));
  jet.mass.setOnes(n);
  jet.charge.setOnes(n);
  jet.volume.setOnes(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    r[0] = (initial_elements(p) - beads[static_cast<std::size_t>(i)]) * s.l_step / s.length;
    if (beads[static_cast<std::size_t>(i)] == 0 && ends_in_half_a_cell(p)) jet.mass[i] = jet.charge[i] = 0.5;
    jet.y.row(i).template head<own_columns<D>>() << r.transpose().array(), v.transpose().array(),
        p.nozzle_stress / s.stress;
  }
  for (std::size_t k = 0; k < added.size(); ++k)
    jet.y.col(own_columns<D> + static_cast<Eigen::Index>(k)).setConstant(added[k].at_birth);
  return jet;
}

/// The deck's cutoff is a length of jet as it leaves the nozzle, hence a number of points; without one all
/// pairs count.
int reach(const Parameters& p) {
  constexpr double all = 2e9;
  return static_cast<int>(p.cutoff ? std::min(std::ceil(*p.cutoff / scales(p).l_step), all) : all);
}

template <int D>
class Composer {
 public:
  Composer(const Parameters& p, const Ranks& ranks) : p_(p), g_(groups(p)), ranks_(ranks) {}

  std::unique_ptr<StressLaw<D>> stress_law() {
    const Scales s = scales(p_);
    if (!p_.hbfluid && p_.yield_stress == 0) {
      composed.push_back({"Maxwell stress", "always"});
      left_out.push_back({"Herschel-Bulkley stress", "no hbfluid yes, no yield stress"});
      return std::make_unique<Maxwell<D>>();
    }
    composed.push_back({"Herschel-Bulkley stress", p_.hbfluid ? "hbfluid yes" : "yield stress"});
    const double K = p_.hb_consistency * std::pow(s.time, 1 - p_.hb_index);
    return std::make_unique<HerschelBulkley<D>>(p_.yield_stress / s.stress, K, p_.hb_index);
  }

  std::vector<std::unique_ptr<ForceTerm<D>>> local_terms(OwnTerms<D>& own) {
    add(
        true, "", [&] { return std::make_unique<Viscoelastic<D>>(g_.L_step, g_.F_ve); },
        "viscoelastic force");
    add(
        g_.V != 0, p_.density_charge == 0 ? "density charge is 0" : "external potential is 0",
        [&] { return std::make_unique<ElectricField<D>>(g_.V); }, "external field");
    add(
        g_.F_g != 0, "no gravity yes", [&] { return std::make_unique<Gravity<D>>(g_.F_g); }, "gravity");
    if (p_.surface_model == SurfaceModel::energy) {
      const double alpha = g_.A / (std::numbers::pi * section().radius * section().radius);
      add(
          g_.A != 0, "surface tension is 0",
          [&] { return std::make_unique<SurfaceEnergy<D>>(alpha, section()); }, "surface tension");
    } else if constexpr (D == 3) {
      add(
          g_.A != 0, "surface tension is 0",
          [&] { return std::make_unique<SurfaceTension>(g_.L_step, g_.A); }, "surface tension");
    } else {
      left_out.push_back({"surface tension", "a straight jet (system 1) has no curvature"});
    }
    add(
        p_.self_field == SelfField::slender && g_.Q != 0,
        g_.Q == 0 ? "density charge is 0" : "self field point",
        [&] { return std::make_unique<SlenderSelfField<D>>(g_.Q, section()); }, "slender self-field");
    for (auto& force : own.forces) {
      composed.push_back({std::string(force->name()), "the caller's own"});
      terms_.push_back(std::move(force));
    }
    for (const auto& term : terms_)
      if (!term->extrapolates()) hasty_ = term->name();
    return std::move(terms_);
  }

  std::vector<std::unique_ptr<ColumnRate<D>>> column_rates(OwnTerms<D>& own) {
    for (auto& rate : own.columns) {
      columns.push_back(rate->column());
      composed.push_back({"column " + columns.back().name, "the caller's own"});
    }
    return std::move(own.columns);
  }

  /// Null without charge, or where the subdomains' own solver adds it.
  std::unique_ptr<CoulombForce<D>> coulomb() {
    if (in_pieces()) {
      note(g_.Q != 0, "Coulomb sum of all pieces", "parallel distributed", "density charge is 0");
      return nullptr;
    }
    if (g_.Q == 0) {
      left_out.push_back({"Coulomb sum", "density charge is 0"});
      return nullptr;
    }
    auto force = std::make_unique<CoulombForce<D>>(g_.Q, field_solver());
    composed.push_back({std::string(force->name()), "named by the deck"});
    return force;
  }

  void boundaries() {
    note(p_.inserting, "insertion at the nozzle", "inserting yes", "no inserting yes");
    note(p_.removing, "removal at the collector", "removing yes", "no removing yes");
    note(p_.perturb, "circling nozzle", "perturb yes", "no perturb yes");
  }

  bool in_pieces() const { return p_.parallel == ParallelData::distributed; }

  /// Whether the stress law has all derivatives where an element turns from stretching to shrinking. A yield
  /// stress jumps there and a power of the strain rate has a kink or a pole in a derivative.
  bool smooth_stress() const { return p_.yield_stress == 0 && (!p_.hbfluid || p_.hb_index == 1); }

  /// Multirate needs an error to hold, a sum over all pairs to take apart, and slopes that a parabola can
  /// continue in time.
  bool multirate() {
    const std::string hasty = hasty_.empty() ? "" : hasty_ + " does not let itself be extrapolated";
    const char* why_not =
        !p_.tolerance                            ? "a fixed timestep has no error to hold"
        : p_.multirate == Multirate::no          ? "multirate no"
        : p_.cutoff                              ? "cutoff"
        : properties(chosen_scheme(p_)).implicit ? "a scheme that solves for the local terms"
        : g_.Q == 0                              ? "no Coulomb sum"
        : in_pieces()                            ? "parallel distributed"
        : !smooth_stress()                       ? "the stress law has a kink or a jump at strain rate 0"
        : stiffness(p_).relaxes_between_beads()  ? "stress relaxes within the interval of beads"
        : !hasty.empty()                         ? hasty.c_str()
                                                 : nullptr;
    note(!why_not, "two rates", "multirate auto", why_not);
    return !why_not;
  }

  std::vector<Composed> composed, left_out;
  Columns columns;

 private:
  Section section() const { return {p_.nozzle_cross / scales(p_).length, g_.L_step}; }

  /// A straight jet has no tree (core/deck/constraints.cpp).
  std::unique_ptr<FieldSolver<D>> field_solver() {
    if constexpr (D == 3)
      if (p_.coulomb != CoulombSum::direct)
        return std::make_unique<CoulombSolver>(coulomb_request(p_, /*points_move*/ true), default_isa(),
                                               TreeRanks{.sharing = ranks_});
    return std::make_unique<DirectSum<D>>(reach(p_), ranks_);
  }

  template <class Make>
  void add(bool wanted, const char* why_not, Make make, const char* name) {
    if (!wanted) return left_out.push_back({name, why_not});
    terms_.push_back(make());
    composed.push_back({std::string(terms_.back()->name()), why_not ? "named by the deck" : "always"});
  }

  void note(bool wanted, const char* name, const char* why, const char* why_not) {
    (wanted ? composed : left_out).push_back({name, wanted ? why : why_not});
  }

  const Parameters& p_;
  Groups g_;
  const Ranks& ranks_;
  std::vector<std::unique_ptr<ForceTerm<D>>> terms_;
  std::string hasty_;  ///< a term whose force multirate may not extrapolate
};

std::vector<int> whole_jet(const Parameters& p) {
  std::vector<int> beads(static_cast<std::size_t>(initial_elements(p)));
  std::iota(beads.begin(), beads.end(), 0);
  return beads;
}

}  // namespace

void hold_in_pieces(Scene<3>& scene, const Parameters& p, int beads, const JetOfRows& jet_of, Threads threads,
                    const Ranks& ranks) {
  auto pieces = std::make_unique<ChainDecomposition>(beads, ranks);
  auto motion = std::make_unique<DistributedMotion>(*scene.motion, *pieces, threads);
  if (groups(p).Q != 0) motion->add_coulomb(groups(p).Q, coulomb_request(p, /*points_move*/ true));
  pieces->keep([field = motion.get()](Archive& state) { field->visit_field(state); });
  scene.jet = jet_of(pieces->rows());
  scene.pieces_error = motion->error();
  scene.pieces_motion = std::move(motion);
  scene.pieces = std::move(pieces);
}

template <int D>
Scene<D> compose(const Parameters& p, Threads threads, const Ranks& ranks, OwnTerms<D> own) {
  Composer<D> composer(p, ranks);
  auto law = composer.stress_law();
  auto local_terms = composer.local_terms(own);
  auto column_rates = composer.column_rates(own);
  auto coulomb = composer.coulomb();
  composer.boundaries();
  const Columns& columns = composer.columns;
  const Nozzle<D> nozzle(p, columns);
  const std::vector<int> beads = composer.in_pieces() ? std::vector<int>() : whole_jet(p);
  Scene<D> scene{
      initial_jet<D>(p, beads, columns), nozzle, Collector(p), {}, {}, {}, {}, nullptr, columns, {}, {}};
  scene.motion = std::make_unique<EquationsOfMotion<D>>(nozzle, std::move(law), std::move(local_terms),
                                                        std::move(coulomb), threads);
  for (auto& rate : column_rates) scene.motion->add_column(std::move(rate));
  if (composer.multirate())
    scene.multirate = std::make_unique<MultirateMotion<D>>(*scene.motion, ErrorNorm(p, columns));
  if constexpr (D == 3)
    if (composer.in_pieces()) {
      const auto jet_of = [&](const std::vector<int>& rows) { return initial_jet<3>(p, rows, columns); };
      hold_in_pieces(scene, p, initial_elements(p), jet_of, threads, ranks);
    }
  scene.composed = std::move(composer.composed);
  scene.left_out = std::move(composer.left_out);
  return scene;
}

template Scene<1> compose<1>(const Parameters&, Threads, const Ranks&, OwnTerms<1>);
template Scene<3> compose<3>(const Parameters&, Threads, const Ranks&, OwnTerms<3>);

}  // namespace treejet
