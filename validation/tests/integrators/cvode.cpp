/// A stiff chain by another code: SUNDIALS' CVODE, backward differentiation formulae of orders 1 to 5.

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <catch2/catch.hpp>

#include "validation/support/run.hpp"

using namespace treejet;

namespace {

struct Problem {
  Run<3>& run;
  State<3> y, slope;
};

int right_hand_side(double t, N_Vector y, N_Vector slope, void* data) {
  auto& p = *static_cast<Problem*>(data);
  p.y = Eigen::Map<const State<3>::Base>(N_VGetArrayPointer(y), p.run.jet().size(), 7);
  (*p.run.scene.motion)(p.run.jet(), t, p.y, p.slope);
  Eigen::Map<State<3>::Base>(N_VGetArrayPointer(slope), p.run.jet().size(), 7) = p.slope;
  return 0;
}

/// The state at scaled time t, and the number of CVODE's steps.
std::pair<State<3>, long> by_cvode(Run<3>& run, double t, double tolerance) {
  Problem problem{run, {}, {}};
  SUNContext context;
  REQUIRE(SUNContext_Create(nullptr, &context) == 0);
  State<3> y = run.jet().y;
  N_Vector state = N_VMake_Serial(y.size(), y.data(), context);
  SUNMatrix matrix = SUNDenseMatrix(y.size(), y.size(), context);
  SUNLinearSolver solver = SUNLinSol_Dense(state, matrix, context);
  void* cvode = CVodeCreate(CV_BDF, context);
  double reached = 0;
  long steps = 0;
  CHECK(CVodeInit(cvode, right_hand_side, 0, state) == 0);
  CHECK(CVodeSStolerances(cvode, tolerance, tolerance) == 0);
  CHECK(CVodeSetUserData(cvode, &problem) == 0);
  CHECK(CVodeSetMaxNumSteps(cvode, 10000000) == 0);
  CHECK(CVodeSetLinearSolver(cvode, solver, matrix) == 0);
  CHECK(CVodeSetStopTime(cvode, t) == 0);
  CHECK(CVode(cvode, t, state, &reached, CV_NORMAL) >= 0);
  CHECK(CVodeGetNumSteps(cvode, &steps) == 0);
  CHECK(reached == t);
  CVodeFree(&cvode);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(state);
  SUNContext_Free(&context);
  return {y, steps};
}

/// Six beads of the PVP case with a relaxation time of 0.4 us, off the axis, no insertion.
Parameters stiff_chain(double tolerance) {
  Parameters p = with_tolerance(example("pvp"), tolerance, Scheme::kencarp5);
  p.elastic_modulus *= 1000;
  p.points = 6;
  p.initial_length = 0.12;
  p.inserting = p.removing = false;
  return p;
}

Run<3> displaced(const Parameters& p) {
  Run<3> run(p);
  auto& y = run.scene.jet.y;
  for (Eigen::Index i = 0; i < y.rows(); ++i) {
    y(i, 1) += 0.003 * double(i % 3) / run.unit.length;
    y(i, 2) -= 0.002 * double(i % 2) / run.unit.length;
  }
  return run;
}

}  // namespace

TEST_CASE("A stiff chain moves as CVODE's backward differentiation formulae move it") {
  const double t = 1e-3;  // s: 2500 relaxation times
  Run<3> run = displaced(stiff_chain(1e-9)), other = displaced(stiff_chain(1e-9));
  const auto [reference, cvode_steps] = by_cvode(other, t / other.unit.time, 1e-11);
  const Effort effort = run.to(t);
  const double moved = (reference.leftCols<3>() - other.jet().y.leftCols<3>()).abs().maxCoeff();
  const double apart = (reference.leftCols<3>() - run.jet().y.leftCols<3>()).abs().maxCoeff();
  CAPTURE(cvode_steps, effort.steps, moved * run.unit.length, apart / moved);
  // CVODE's error is some hundred steps' worth of its 1e-11, ours some 100 times the 1e-9 times 1000 of the
  // norm over the size of an element: both below 1e-6 of the way that the beads go
  CHECK(apart < 1e-6 * moved);
}
