#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "validation/ranked.hpp"

namespace {
treejet::Ranks started;
}

const treejet::Ranks& treejet::started_ranks() {
  return started;
}

int main(int argc, char** argv) {
  started = treejet::join_ranks();
  const int failed = Catch::Session().run(argc, argv);
  const int worst = started.greatest(failed);
  started = {};
  return worst > 0 ? 1 : 0;
}
