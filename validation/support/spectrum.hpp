#pragma once
/// The spectrum of a displacement across the axis, w = y + i z, taken at equal distances in time or along the
/// jet.
///
/// A Hann window is laid over the samples and their mean under it taken off, so that a period that does not
/// divide the record leaks into its neighbours only. A motion w = A exp(2 pi i f t) circles from y to z if f
/// > 0. The dominant frequency is the centre of power of the highest peak, taken over the two bins on each
/// side of it that the window spreads it to; the spread is the root mean square distance of the whole power
/// from the dominant frequency. A pure circle has the spread of the window, 1 / (sqrt(3) * record).
/// Everything is per unit of `spacing`. Errors: std::invalid_argument below 8 samples.

#include <complex>
#include <vector>

namespace treejet {

struct Spectrum {
  std::vector<double> frequency,
      power;  ///< ascending, from -1/2 to 1/2 over spacing; powers add up to 1, all 0 if nothing moves
  double dominant = 0, spread = 0;
};

Spectrum spectrum(const std::vector<std::complex<double>>& samples, double spacing);

}  // namespace treejet
