#include "validation/support/charged_thread.hpp"

#include "forces/terms/coulomb_force.hpp"
#include "forces/terms/slender_self_field.hpp"
#include "validation/support/scenes.hpp"

namespace treejet {

double ChargedThread::growth(int elements, bool slender) const {
  constexpr int all_pairs = 1 << 30;
  constexpr double amplitude = 1e-6, far_from_nozzle = 1e5;
  const int N = elements;
  const double l = length / N, q = charge_density * section() * l, m = density * section() * l;
  std::vector<Bead<3>> beads;
  for (int i = 0; i <= N; ++i) {
    const double cell = i == 0 || i == N ? 0.5 : 1, x = l * i;
    beads.push_back(
        {Vec<3>(far_from_nozzle + x, amplitude * std::cos(k() * x), amplitude * std::sin(k() * x)),
         Vec<3>::Zero(), 0, cell, cell});
  }
  const double Q = q * q / m;
  auto f = slender ? equations<3>(plain_parameters(), CoulombForce<3>(Q, all_pairs),
                                  SlenderSelfField<3>(Q, Section{radius, l}))
                   : equations<3>(plain_parameters(), CoulombForce<3>(Q, all_pairs));
  const auto jet = jet_of<3>(beads);
  const State<3> dy = slope(f, jet);
  double work = 0, square = 0;
  for (int i = N / 4; i <= 3 * N / 4; ++i) {
    work += dy(i, 4) * jet.y(i, 1) + dy(i, 5) * jet.y(i, 2);
    square += jet.y(i, 1) * jet.y(i, 1) + jet.y(i, 2) * jet.y(i, 2);
  }
  return std::sqrt(work / square);
}

}  // namespace treejet
