#include "validation/tests/catch_runner.hpp"

int main(int argc, char** argv) {
  return treejet::run_tests(argc, argv);
}
