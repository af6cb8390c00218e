#include "forces/distributed/distributed_motion.hpp"

#include "parallel/work_clock.hpp"

namespace treejet {

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

void DistributedMotion::differentiate(const Jet<3>& jet, double t, const State<3>& y, LocalJacobian<3>& J) {
  extend(jet, y);
  local_.differentiate(extended_, t, extended_.y, J);
  J.subdomain = this;
}

/// The own beads and, from the ranks next along the chain, one on either side: what the force on the other
/// end of an element needs. Into tables that stay: a subdomain of half a million beads is copied at every
/// evaluation.
void DistributedMotion::extend(const Jet<3>& jet, const State<3>& y) {
  const Rows own = subdomains_.own();
  const auto [older, younger] = of_neighbours([&](int row) {
    const Beads bead = packed(jet, y, {row, row + 1});
    return std::vector<double>(bead.data(), bead.data() + bead.size());
  });
  first_ = older.empty() ? 0 : 1;
  const int n = first_ + own.size() + (younger.empty() ? 0 : 1);
  extended_.born = jet.born;
  set_rows(extended_, n, y.cols());
  copy_beads(jet, y, own, extended_, first_);
  for (const auto& [bead, row] : {std::pair{&older, 0}, std::pair{&younger, n - 1}})
    if (!bead->empty()) unpack(Eigen::Map<const Beads>(bead->data(), std::ssize(*bead), 1), extended_, row);
  extended_.removed = subdomains_.before(jet) + own.first - first_;
  extended_.from_oldest = older.empty();
  extended_.to_youngest = younger.empty();
  extended_.held = jet.held && subdomains_.has_youngest();
  extended_.last_release = jet.last_release;
  if (!subdomains_.shares_volumes()) return;
  extended_.all_volumes = &subdomains_.all_volumes(jet);
  extended_.first_of_all = extended_.removed - jet.removed;
}

std::array<std::vector<double>, 2> DistributedMotion::of_neighbours(const RecordOfRow& record) const {
  const Ranks& ranks = subdomains_.ranks();
  const int older = subdomains_.older(), younger = subdomains_.younger();
  const Rows own = subdomains_.own();
  if (older >= 0) ranks.send(older, record(own.first));
  if (younger >= 0) ranks.send(younger, record(own.last - 1));
  std::array<std::vector<double>, 2> rows;
  if (older >= 0) rows[0] = ranks.receive(older);
  if (younger >= 0) rows[1] = ranks.receive(younger);
  return rows;
}

State<3> DistributedMotion::with_neighbours(const State<3>& table) const {
  using Row = Eigen::Array<double, 1, Eigen::Dynamic>;
  const Rows own = subdomains_.own();
  const auto row = [&](int i) {
    const Row values = table.row(i);
    return std::vector<double>(values.data(), values.data() + values.size());
  };
  const auto [older, younger] = of_neighbours(row);
  State<3> all(first_ + own.size() + (younger.empty() ? 0 : 1), table.cols());
  all.middleRows(first_, own.size()) = table.middleRows(own.first, own.size());
  if (!older.empty()) all.row(0) = Eigen::Map<const Row>(older.data(), table.cols());
  if (!younger.empty()) all.row(all.rows() - 1) = Eigen::Map<const Row>(younger.data(), table.cols());
  return all;
}

void DistributedMotion::put_back(const State<3>& rows, State<3>& table) const {
  const Rows own = subdomains_.own();
  table.middleRows(own.first, own.size()) = rows.middleRows(first_, own.size());
  subdomains_.share_ends(table);
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
  for (int k = 0; k < 3; ++k)
    slope.col(velocity_column<3> + k).segment(own.first, own.size()) +=
        Q_ * chain.point_charge.segment(first_, own.size()) * chain.inverse_mass.segment(first_, own.size()) *
        field_.col(k).head(own.size());
  if (local_.fed_element() && subdomains_.has_youngest()) bind_youngest(own, slope);
}

/// What accelerates the youngest bead, the last of the own ones, is in part the field at the held bead.
void DistributedMotion::bind_youngest(Rows own, State<3>& slope) const {
  const Chain<3>& chain = local_.chain();
  const auto share = local_.fed_element()->shares(chain);
  const int youngest = chain.beads - 1, row = own.size() - 1;
  const double specific_charge = chain.point_charge[youngest] * chain.inverse_mass[youngest];
  Eigen::Array<double, 1, 3> added = (share.own - 1) * specific_charge * field_.row(row);
  if (chain.holds_bead()) added += share.held * field_.row(row + 1);
  slope.row(own.last - 1).segment<3>(velocity_column<3>) += Q_ * added;
}

}  // namespace treejet
