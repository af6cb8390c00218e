#include "forces/distributed/distributed_motion.hpp"

#include "parallel/work_clock.hpp"

namespace treejet {

namespace {

/// What a neighbour has to know of a bead: its state, mass, charge and volume.
std::vector<double> message(const Jet<3>& jet, const State<3>& y, int i) {
  const Eigen::Array<double, 1, Eigen::Dynamic> values = y.row(i);
  std::vector<double> all(values.data(), values.data() + values.size());
  all.insert(all.end(), {jet.mass[i], jet.charge[i], jet.volume[i]});
  return all;
}

}  // namespace

void DistributedMotion::operator()(const Jet<3>& jet, double t, const State<3>& y, State<3>& slope) {
  const Working at(Work::local);
  slope.resize(y.rows(), y.cols());
  if (subdomains_.beads(jet) == 0) return;
  const Rows own = subdomains_.own();
  extend(jet, y);
  local_(extended_, t, extended_.y, slope_);
  slope.middleRows(own.first, own.size()) = slope_.middleRows(first_, own.size());
  if (solver_) repel(own, slope);
  subdomains_.share_ends(slope);
  if (continued_) set_last_evaluation(jet, t, y);
}

void DistributedMotion::set_last_evaluation(const Jet<3>& jet, double t, const State<3>& y) {
  set_boundary<3>(chain_, jet, local_.nozzle(), t, y);
  set_points<3>(chain_, jet, y, {0, y.rows()});
  const Rows own = subdomains_.own();
  Eigen::ArrayXXd field(y.rows(), 3);
  field.middleRows(own.first, own.size()) = field_.topRows(own.size());
  subdomains_.share_ends(field);
  field_of_rows_ = field;
}

/// The own beads and, from the ranks next along the chain, one on either side.
void DistributedMotion::extend(const Jet<3>& jet, const State<3>& y) {
  const Rows own = subdomains_.own();
  const int older = subdomains_.older(), younger = subdomains_.younger();
  Ranks::Messages messages(index(subdomains_.ranks().size()));
  if (older >= 0) messages[index(older)] = message(jet, y, own.first);
  if (younger >= 0) messages[index(younger)] = message(jet, y, own.last - 1);
  const Ranks::Messages received = subdomains_.ranks().exchange(messages);

  first_ = older >= 0 ? 1 : 0;
  const int n = first_ + own.size() + (younger >= 0 ? 1 : 0);
  extended_.y.resize(n, y.cols());
  extended_.y.middleRows(first_, own.size()) = y.middleRows(own.first, own.size());
  for (auto constants : {&Jet<3>::mass, &Jet<3>::charge, &Jet<3>::volume}) {
    (extended_.*constants).resize(n);
    (extended_.*constants).segment(first_, own.size()) = (jet.*constants).segment(own.first, own.size());
  }
  extended_.removed = subdomains_.before(jet) + own.first - first_;
  extended_.held = jet.held && subdomains_.has_youngest();
  extended_.last_release = jet.last_release;
  const auto take_in = [&](int rank, int at) {
    if (rank < 0) return;
    const double* from = received[index(rank)].data();
    extended_.y.row(at) = Eigen::Map<const Eigen::Array<double, 1, Eigen::Dynamic>>(from, y.cols());
    from += y.cols();
    for (auto constants : {&Jet<3>::mass, &Jet<3>::charge, &Jet<3>::volume})
      (extended_.*constants)[at] = *from++;
  };
  take_in(older, 0);
  take_in(younger, n - 1);
}

/// The Coulomb force.
void DistributedMotion::repel(Rows own, State<3>& slope) {
  const Chain<3>& chain = local_.chain();
  // points beyond the own beads: held bead and nozzle, or a neighbour and what follows it here only
  const int points = own.size() == 0 ? 0 : subdomains_.has_youngest() ? chain.points() - first_ : own.size();
  field_.resize(points, Eigen::NoChange);
  PointCharges<3> subdomain{{}, nullptr, points};
  FieldArrays<3> field{};
  for (int k = 0; k < 3; ++k) {
    if (points > 0) subdomain.r[index(k)] = chain.point.col(k).data() + first_;
    field[index(k)] = field_.col(k).data();
  }
  if (points > 0) subdomain.q = chain.point_charge.data() + first_;
  solver_->field(subdomain, {0, points}, field, worthwhile(threads_, points));
  if (points == 0) return;
  if (local_.fed_element() && subdomains_.has_youngest()) bind_youngest_field(own.size());
  for (int k = 0; k < 3; ++k)
    slope.col(velocity_column<3> + k).segment(own.first, own.size()) +=
        Q_ * chain.point_charge.segment(first_, own.size()) * chain.inverse_mass.segment(first_, own.size()) *
        field_.col(k).head(own.size());
}

/// The field that accelerates the youngest bead, the last of the own ones, is in part that at the held bead.
void DistributedMotion::bind_youngest_field(int own) {
  const Chain<3>& chain = local_.chain();
  const auto share = local_.fed_element()->shares(chain);
  const int youngest = chain.beads - 1;
  const double specific_charge = chain.point_charge[youngest] * chain.inverse_mass[youngest];
  field_.row(own - 1) *= share.own;
  if (chain.holds_bead()) field_.row(own - 1) += share.held / specific_charge * field_.row(own);
}

}  // namespace treejet
