/// The program with stock physics. What stands behind its door is in integrators/run/front_door.cpp.

#include "integrators/run/front_door.hpp"

int main(int argc, char** argv) {
  return treejet::front_door(argc, argv);
}
