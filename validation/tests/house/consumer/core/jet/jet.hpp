#pragma once
/// Another project's jet: not ours.

struct Fountain {
  double height = 1;
};
