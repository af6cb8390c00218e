#include "validation/tests/catch_runner.hpp"
#include "validation/tests/ranks/ranked.hpp"

namespace {
treejet::Ranks started;
}

const treejet::Ranks& treejet::started_ranks() {
  return started;
}

int main(int argc, char** argv) {
  started = treejet::join_ranks();
  const int failed = treejet::run_tests(argc, argv);
  const int worst = started.greatest(failed);
  started = {};
  return worst > 0 ? 1 : 0;
}
