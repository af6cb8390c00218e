#pragma once

namespace treejet {

/// Runs the test cases that the arguments name; the number of those that failed.
int run_tests(int argc, char** argv);

}  // namespace treejet
