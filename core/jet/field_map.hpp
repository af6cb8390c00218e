#pragma once
/// A potential on a grid of points, as programs of finite elements write it, and its field between them.
///
/// phi is the tensor product of cubic B-splines that takes the values at the points; in each direction its
/// third derivative vanishes over the two outermost pairs of points. E = - grad phi is the exact gradient of
/// that: without curl, with continuous slopes, an error of third order in the spacing inside and of second
/// order at the border. Up to one spacing beyond the border phi goes on as the spline there; farther off
/// there is none.
///
/// CGS: cm and statV. Values run along x fastest, then y, then z. Source: de Boor, A Practical Guide to
/// Splines, chapters 4 and 17.

#include <array>
#include <string>
#include <vector>

#include "core/jet/jet.hpp"

namespace treejet {

class FieldMap {
 public:
  struct Grid {
    std::array<int, 3> size = {};  ///< at least fewest in each direction
    std::array<double, 3> origin = {}, spacing = {};
  };
  static constexpr int fewest = 4;

  /// `name`: of the file, with its size and a hash of its bytes. InputError if the values are not as many as
  /// the grid's points, not all finite, or the grid is none.
  FieldMap(const Grid& grid, std::vector<double> potential, std::string name);

  /// statV/cm at a place in cm, where it contains that.
  Vec<3> field(const Vec<3>& r) const;
  double potential(const Vec<3>& r) const;
  bool contains(const Vec<3>& r) const;

  const std::string& name() const { return name_; }
  /// "x -1 to 17, y -2 to 2, z -2 to 2 cm".
  std::string box() const;

 private:
  /// Weights of four coefficients, and of their slopes, in one direction.
  struct Weights {
    int first;
    std::array<double, 4> value, slope;
  };
  Weights weights(int direction, double r) const;
  void solve_along(int direction);

  Grid grid_;
  std::array<int, 3> padded_;  ///< with a coefficient more at either end
  std::vector<double> coefficient_;
  std::string name_;
};

}  // namespace treejet
