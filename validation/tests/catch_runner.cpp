// Catch's own code, compiled once for both programs of tests.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "validation/tests/catch_runner.hpp"

int treejet::run_tests(int argc, char** argv) {
  return Catch::Session().run(argc, argv);
}
