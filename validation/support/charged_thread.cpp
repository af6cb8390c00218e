#include "validation/support/charged_thread.hpp"

#include <array>

#include "forces/terms/coulomb_force.hpp"
#include "forces/terms/slender_self_field.hpp"
#include "validation/support/scenes.hpp"

namespace treejet {

namespace {

constexpr int all_pairs = 1 << 30;
constexpr double far_from_nozzle = 100;

/// By Gauss's rule of 8 points in each of n equal parts.
template <class Function>
double integral(double a, double b, int parts, Function f) {
  constexpr std::array<double, 4> node = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                          0.9602898564975363},
                                  weight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                            0.1012285362903763};
  double sum = 0;
  const double half = (b - a) / (2 * parts);
  for (int n = 0; n < parts; ++n)
    for (std::size_t k = 0; k < 4; ++k) {
      const double middle = a + half * (2 * n + 1), off = half * node[k];
      sum += half * weight[k] * (f(middle - off) + f(middle + off));
    }
  return sum;
}

}  // namespace

double ChargedThread::push_on_helix(double R) const {
  const double c = std::sqrt(1 + R * R), reduced = std::pow(c, -0.5) * k() * radius;  // k a
  const auto of_far = [&](double x) {
    const double s = std::sin(x / 2), chord2 = x * x + 4 * R * R * s * s;
    return 4 * R * s * s / (chord2 * std::sqrt(chord2));
  };
  const auto of_near = [&](double x) { return of_far(x) - R / (c * c * c * x); };
  // beyond the waves that are summed, chord is x and sin^2 is 1/2 in the mean
  constexpr int waves = 200;
  const double end = 2 * std::numbers::pi * waves;
  return R / (c * c * c) * (std::log(2 * c / reduced) - 1.5) + integral(0, 1, 4, of_near) +
         integral(1, end, 4 * waves, of_far) + R / (end * end);
}

double ChargedThread::amplification_of_helix(double amplitude, double seconds) const {
  const double unit = rate(1);  // sqrt(lambda^2 k^2 / mu)
  constexpr int steps = 200;
  const double h = unit * seconds / steps;
  double R = k() * amplitude, speed = 0;
  for (int n = 0; n < steps; ++n) {  // Nystroem's fourth order
    const double k1 = push_on_helix(R), k2 = push_on_helix(R + h / 2 * speed + h * h / 8 * k1),
                 k3 = push_on_helix(R + h * speed + h * h / 2 * k2);
    R += h * speed + h * h / 6 * (k1 + 2 * k2);
    speed += h / 6 * (k1 + 4 * k2 + k3);
  }
  return R / (k() * amplitude);
}

Jet<3> ChargedThread::wave(int elements, double amplitude) const {
  const double l = length / elements;
  std::vector<Bead<3>> beads;
  for (int i = 0; i <= elements; ++i) {
    const double cell = i == 0 || i == elements ? 0.5 : 1, x = l * i;
    beads.push_back(
        {Vec<3>(far_from_nozzle + x, amplitude * std::cos(k() * x), amplitude * std::sin(k() * x)),
         Vec<3>::Zero(), 0, cell, cell});
  }
  return jet_of<3>(beads);
}

namespace {

EquationsOfMotion<3> motion(const ChargedThread& thread, int elements, bool slender) {
  const double l = thread.length / elements, q = thread.charge_density * thread.section() * l,
               m = thread.density * thread.section() * l, Q = q * q / m;
  return slender ? equations<3>(plain_parameters(), CoulombForce<3>(Q, all_pairs),
                                SlenderSelfField<3>(Q, Section{thread.radius, l}))
                 : equations<3>(plain_parameters(), CoulombForce<3>(Q, all_pairs));
}

}  // namespace

double ChargedThread::growth(int elements, bool slender) const {
  constexpr double amplitude = 1e-6;
  const int N = elements;
  auto f = motion(*this, N, slender);
  const auto jet = wave(N, amplitude);
  const State<3> dy = slope(f, jet);
  double work = 0, square = 0;
  for (int i = N / 4; i <= 3 * N / 4; ++i) {
    work += dy(i, 4) * jet.y(i, 1) + dy(i, 5) * jet.y(i, 2);
    square += jet.y(i, 1) * jet.y(i, 1) + jet.y(i, 2) * jet.y(i, 2);
  }
  return std::sqrt(work / square);
}

double ChargedThread::amplification(int elements, bool slender, double amplitude, double seconds,
                                    double part) const {
  auto f = motion(*this, elements, slender);
  auto jet = wave(elements, amplitude);
  const double dt = seconds / (elements / 2 + 100);  // waves of two elements are the quickest
  march_to<3>(seconds, dt, jet, f, plain_parameters(), Scheme::rk4);
  const int inner = int(part * elements) / 2, middle = elements / 2;
  const auto some = jet.y.middleRows(middle - inner, 2 * inner + 1);
  return std::sqrt((some.col(1).square() + some.col(2).square()).mean()) / amplitude;
}

}  // namespace treejet
