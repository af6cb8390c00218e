// Catch's own code, compiled once for both programs of tests.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "validation/tests/catch_runner.hpp"

namespace treejet {

/// Tags each case with the folder below validation/tests that it stands in: [coulomb], [physics], ...
static void tag_with_folder() {
  for (const Catch::TestCase& test : Catch::getRegistryHub().getTestCaseRegistry().getAllTests()) {
    const std::string file = test.lineInfo.file, root = "validation/tests/";
    const std::size_t begin = file.rfind(root);
    if (begin == std::string::npos) continue;
    const std::string below = file.substr(begin + root.size());
    auto tags = test.tags;
    tags.push_back(below.substr(0, below.find('/')));
    setTags(const_cast<Catch::TestCase&>(test), tags);  // as Catch itself does for --filenames-as-tags
  }
}

}  // namespace treejet

int treejet::run_tests(int argc, char** argv) {
  tag_with_folder();
  return Catch::Session().run(argc, argv);
}
