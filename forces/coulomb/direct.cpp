#include "forces/coulomb/coulomb.hpp"
#include "forces/coulomb/simd/kernels.hpp"

namespace treejet {

namespace {
constexpr int very_few = 6;  // points that do not repay filling wide registers
}

template <int D>
void coulomb_direct(const PointCharges<D>& points, Rows rows, const FieldArrays<D>& field, Isa isa) {
  const WideKernels& kernels = wide_kernels(isa);
  const auto direct = D == 1 ? kernels.direct_1d : kernels.direct_3d;
  direct(points.r.data(), points.q, points.n, rows, field.data());
}

template <int D>
void coulomb_direct(const PointCharges<D>& points, Rows rows, const FieldArrays<D>& field) {
  if (points.n <= very_few) return coulomb_plain<D>(points, rows, field, points.n);
  coulomb_direct<D>(points, rows, field, default_isa());
}

template <int D>
void coulomb_mutual(const PointCharges<D>& points, const FieldArrays<D>& field, Isa isa) {
  const WideKernels& kernels = wide_kernels(isa);
  (D == 1 ? kernels.mutual_1d : kernels.mutual_3d)(points.r.data(), points.q, points.n, field.data());
}

template <int D>
void coulomb_mutual(const PointCharges<D>& points, const FieldArrays<D>& field) {
  if (points.n <= very_few) return coulomb_plain<D>(points, {0, points.n}, field, points.n);
  coulomb_mutual<D>(points, field, default_isa());
}

template void coulomb_mutual<1>(const PointCharges<1>&, const FieldArrays<1>&);
template void coulomb_mutual<3>(const PointCharges<3>&, const FieldArrays<3>&);
template void coulomb_mutual<1>(const PointCharges<1>&, const FieldArrays<1>&, Isa);
template void coulomb_mutual<3>(const PointCharges<3>&, const FieldArrays<3>&, Isa);
template void coulomb_direct<1>(const PointCharges<1>&, Rows, const FieldArrays<1>&, Isa);
template void coulomb_direct<3>(const PointCharges<3>&, Rows, const FieldArrays<3>&, Isa);
template void coulomb_direct<1>(const PointCharges<1>&, Rows, const FieldArrays<1>&);
template void coulomb_direct<3>(const PointCharges<3>&, Rows, const FieldArrays<3>&);

void coulomb_direct_with_potential(const PointCharges<3>& points, Rows rows, const FieldArrays<3>& field,
                                   double* potential, Isa isa) {
  double* const sums[4] = {field[0], field[1], field[2], potential};
  wide_kernels(isa).direct_with_potential(points.r.data(), points.q, points.n, rows, sums);
}

const char* isa_name() {
  return name(default_isa());
}

}  // namespace treejet
