# The fuzzer of the deck reader; how to run it stands in validation/fuzz/deck.cpp.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
file(GLOB deck_sources core/deck/*.cpp core/base/lines.cpp core/base/number.cpp core/jet/schemes.cpp)
add_executable(fuzz-deck validation/fuzz/deck.cpp ${deck_sources})
target_include_directories(fuzz-deck PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_options(fuzz-deck PRIVATE -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all)
target_link_options(fuzz-deck PRIVATE -fsanitize=fuzzer,address,undefined)
target_link_libraries(fuzz-deck PRIVATE Eigen3::Eigen fmt::fmt)
