#include "integrators/march/event_finder.hpp"

namespace treejet {

template <int D>
double EventFinder<D>::overdue(Kind kind, const Jet<D>& jet, const State<D>& y, double t) const {
  if (kind == Kind::ending) return decomposition_.greatest(endings_.overdue(jet.y, y));
  const Eigen::Index last = y.rows() - 1;
  if (kind == Kind::insertion) return nozzle_.overdue(jet, position<D>(y, last), t);
  return collector_.overdue(y(0, 0));
}

template <int D>
double EventFinder<D>::overdue(Kind kind, const Jet<D>& jet, const DenseOutput<D>& step, double t) {
  if (kind == Kind::ending) return overdue(kind, jet, step.at(t), t);
  one_.resize(1, jet.y.cols());
  step.at(t, kind == Kind::insertion ? jet.size() - 1 : 0, one_);
  return overdue(kind, jet, one_, t);
}

template <int D>
bool EventFinder<D>::is_due(Kind kind, const Jet<D>& jet) const {
  constexpr double simultaneous = 1e-12;  // of the length of an element
  return overdue(kind, jet) >= -simultaneous * nozzle_.l_step();
}

template <int D>
double EventFinder<D>::zero(Kind kind, const Jet<D>& jet, const DenseOutput<D>& step, double a, double b) {
  double ga = overdue(kind, jet, step, a), gb = overdue(kind, jet, step, b);
  if (ga >= 0) return a;
  const double wide = 1e-6 * (b - a);
  for (int i = 0; i < 60 && gb != 0 && b - a > 1e-15 * b; ++i) {
    const double c = (a * gb - b * ga) / (gb - ga);
    // the zero but for round-off; b may still be far away if the function is straight
    if (!(c > a)) return b - a > wide ? a : b;
    if (!(c < b)) break;
    const double gc = overdue(kind, jet, step, c);
    if (gc < 0) {
      a = c, ga = gc;
      gb /= 2;
    } else {
      b = c, gb = gc;
      ga /= 2;
    }
  }
  return b;
}

template <int D>
std::optional<typename EventFinder<D>::Due> EventFinder<D>::first(const Jet<D>& jet,
                                                                  const DenseOutput<D>& step, double reach) {
  std::optional<Due> first;
  const auto look_for = [&](Kind kind) {
    double end = step.until;
    if (overdue(kind, jet, step.to().y, step.to().t) < 0) {
      if (reach <= end || overdue(kind, jet, step, reach) < 0) return;
      end = reach;
    }
    const double t = zero(kind, jet, step, step.begin(), end);
    if (!first || t < first->t) first = Due{t, kind};
  };
  if (nozzle_.inserting()) look_for(Kind::insertion);
  if (collector_.removing()) look_for(Kind::removal);
  if (endings_.any()) look_for(Kind::ending);
  return first;
}

template class EventFinder<1>;
template class EventFinder<3>;

}  // namespace treejet
