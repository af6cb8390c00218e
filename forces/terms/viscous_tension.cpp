#include "forces/terms/viscous_tension.hpp"

namespace treejet {

template <int D>
double ViscousTension<D>::coefficient(const Chain<D>& c, int i) const {
  if (!drying_) return coefficient_;
  return coefficient_ * drying_->viscosity_ratio(drying_->concentration(c.column(0)[i]));
}

template <int D>
Vec<D> ViscousTension<D>::tension(const Chain<D>& c, int i) const {
  return coefficient(c, i) * stress_(c.strain_rate[i]) * c.inverse_length[i] * c.volume[i] *
         c.tangent.row(i).matrix().transpose();
}

template <int D>
void ViscousTension<D>::add(const Chain<D>& c, Rows rows, Acceleration<D>& a) const {
  Vec<D> below = rows.first > 0 ? tension(c, rows.first - 1) : Vec<D>(Vec<D>::Zero());
  for (int i = rows.first; i < rows.last; ++i) {
    const Vec<D> above = tension(c, i);
    a.row(i) += c.inverse_mass[i] * (below - above).transpose().array();
    below = above;
  }
}

/// T = C V sigma d / l^2:   dT = C V sigma / l^2 (1 - 2 t t') dd + C V t / l dsigma/dr dr .
template <int D>
void ViscousTension<D>::differentiate(const Chain<D>& c, LocalJacobian<D>& J) const {
  for (int i = 0; i < c.beads; ++i) {
    const Vec<D> t = c.tangent.row(i).matrix().transpose();
    const double inverse = c.inverse_length[i], rate = c.strain_rate[i], C = coefficient(c, i) * c.volume[i];
    auto& e = J.element[static_cast<std::size_t>(i)];
    const Vec<D> by_rate = C * inverse * stress_.derivative(rate) * t;
    e.tension_by_d += C * stress_(rate) * inverse * inverse *
                          (Eigen::Matrix<double, D, D>::Identity() - 2 * t * t.transpose()) +
                      by_rate * e.rate_by_d.transpose();
    e.tension_by_w += by_rate * e.rate_by_w.transpose();
  }
}

template class ViscousTension<1>;
template class ViscousTension<3>;

}  // namespace treejet
