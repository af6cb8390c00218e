#include "forces/coulomb.hpp"

namespace treejet {

template <int D>
void coulomb_direct(const PointCharges<D>& points, Rows rows, const FieldArrays<D>& field) {
  coulomb_plain<D>(points, rows, field, points.n);
}

template void coulomb_direct<1>(const PointCharges<1>&, Rows, const FieldArrays<1>&);
template void coulomb_direct<3>(const PointCharges<3>&, Rows, const FieldArrays<3>&);

const char* vector_path() { return "plain"; }

}  // namespace treejet
