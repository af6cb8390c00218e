#include "forces/terms/equations_of_motion.hpp"

#include <fmt/format.h>

#include "parallel/work_clock.hpp"

namespace treejet {

namespace {
constexpr int block = 16;  // rows; the width of the Coulomb kernels' target blocks
}

template <int D>
EquationsOfMotion<D>::EquationsOfMotion(Nozzle<D> nozzle, std::unique_ptr<StressLaw<D>> stress_law,
                                        std::vector<std::unique_ptr<ForceTerm<D>>> local_terms,
                                        std::unique_ptr<CoulombForce<D>> coulomb, Threads threads)
    : nozzle_(std::move(nozzle)),
      stress_law_(std::move(stress_law)),
      law_columns_(static_cast<int>(stress_law_->columns().size())),
      local_terms_(std::move(local_terms)),
      coulomb_(std::move(coulomb)),
      threads_(threads) {
  if (nozzle_.inserting() && nozzle_.feed().flow() > 0) fed_element_.emplace(nozzle_);
}

template <int D>
void EquationsOfMotion<D>::operator()(const Jet<D>& jet, double t, const State<D>& y, State<D>& slope) {
  const int n = static_cast<int>(y.rows());
  const Working at(Work::local, n >= points_worth_telling);
  slope.resize(n, y.cols());
  if (n == 0) return;
  const Threads threads = worthwhile(threads_, n);

  set_boundary<D>(chain_, jet, nozzle_, t, y);
  for_each_block(threads, {0, n}, block, [&](Rows rows) {
    set_points<D>(chain_, jet, y, {rows.first, rows.last});
    set_elements<D>(chain_, jet, y, {rows.first, rows.last});
    amend(rows);
  });
  if (coulomb_) coulomb_->prepare(chain_, {0, n}, threads);
  prepare(chain_, {0, n}, threads);
  for_each_block(threads, {0, n}, block, [&](Rows rows) {
    set_local(chain_, rows, slope);
    Acceleration<D> acceleration = slope.template middleCols<D>(velocity_column<D>);
    if (coulomb_) coulomb_->add(chain_, rows, acceleration);
  });
  bind_held(chain_, coulomb_ ? coulomb_->on_held(chain_) : Vec<D>::Zero(), slope);
}

/// The strain rate w.t / l = w.d / l^2 has the derivatives  w / l^2 - 2 rate t / l  by d and  t / l  by w.
template <int D>
void EquationsOfMotion<D>::differentiate(const Jet<D>& jet, double t, const State<D>& y,
                                         LocalJacobian<D>& J) {
  const int n = static_cast<int>(y.rows());
  J.element.assign(static_cast<std::size_t>(n), {});
  J.acceleration_by_v.clear();
  J.subdomain = nullptr;
  J.law_column = law_columns_ > 0;
  J.inverse_mass = jet.mass.inverse();
  if (n == 0) return;  // a subdomain without beads
  set_boundary<D>(chain_, jet, nozzle_, t, y);
  set_points<D>(chain_, jet, y, {0, n});
  set_elements<D>(chain_, jet, y, {0, n});
  amend({0, n});
  J.inverse_mass = chain_.inverse_mass;
  for (int i = 0; i < n; ++i) {
    const Vec<D> tangent = chain_.tangent.row(i).matrix().transpose();
    const double inverse = chain_.inverse_length[i];
    auto& e = J.element[static_cast<std::size_t>(i)];
    e.rate_by_w = inverse * tangent;
    e.rate_by_d = inverse * (inverse * (chain_.velocity(i) - chain_.velocity_above(i)) -
                             2 * chain_.strain_rate[i] * tangent);
    e.stress = stress_law_->derivative(chain_, i);
  }
  for (const auto& term : local_terms_) term->differentiate(chain_, J);
  if (fed_element_) fed_element_->bind(chain_, J);
}

template <int D>
void EquationsOfMotion<D>::amend(Rows rows) {
  for (std::size_t k = 0; k < column_rates_.size(); ++k)
    column_rates_[k]->amend(chain_, law_columns_ + static_cast<int>(k), rows);
}

template <int D>
void EquationsOfMotion<D>::prepare(const Chain<D>& chain, Rows rows, Threads threads) {
  for (auto& term : local_terms_) term->prepare(chain, rows, threads);
}

template <int D>
void EquationsOfMotion<D>::set_local(const Chain<D>& chain, Rows rows, State<D>& slope) const {
  const int i = rows.first, n = rows.size();
  slope.middleRows(i, n).template leftCols<D>() =
      chain.state->middleRows(i, n).template middleCols<D>(velocity_column<D>);
  slope.middleRows(i, n).template middleCols<D>(velocity_column<D>).setZero();
  stress_law_->set(chain, rows, slope);
  for (std::size_t k = 0; k < column_rates_.size(); ++k) {
    const int added = law_columns_ + static_cast<int>(k);
    column_rates_[k]->set(chain, added, rows, slope.col(own_columns<D> + added));
  }
  Acceleration<D> acceleration = slope.template middleCols<D>(velocity_column<D>);
  for (auto& term : local_terms_) term->add(chain, rows, acceleration);
}

template <int D>
void EquationsOfMotion<D>::bind_held(const Chain<D>& chain, const Vec<D>& coulomb_on_held,
                                     State<D>& slope) const {
  if (!fed_element_) return;
  Vec<D> of_held = coulomb_on_held;
  for (const auto& term : local_terms_) of_held += term->on_held(chain);
  fed_element_->bind(chain, of_held, slope);
}

template class EquationsOfMotion<1>;
template class EquationsOfMotion<3>;

std::string threads_description(Threads threads) {
  if (threads.count == 1) return "1 thread";
  return fmt::format("{} threads ({} below {} beads)", threads.count, threads.count - 1,
                     threads.count * beads_worth_a_thread);
}

}  // namespace treejet
