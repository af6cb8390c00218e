"""The spectrum of the whipping: w = y + i z of a bead or of the jet, at equal distances in time or along the jet.

>>> t = np.arange(256) * 1e-4
>>> round(spectrum(np.exp(2j * np.pi * 1230.0 * t), 1e-4).dominant)
1230
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .errors import InputError


@dataclass(frozen=True)
class Spectrum:
    frequency: np.ndarray  #: ascending, per unit of `spacing`; positive: circles from y to z
    power: np.ndarray  #: adds up to 1, or is 0 if nothing moves
    dominant: float  #: centre of power of the highest peak
    spread: float  #: root mean square distance of the power from it


def spectrum(samples: np.ndarray, spacing: float) -> Spectrum:
    """Spectrum of complex (or real) samples.

    A Hann window is laid over the samples and their mean under it taken off. The dominant frequency is the centre of
    power of the highest bin and the two on each side of it that the window spreads a peak to.
    """
    w = np.asarray(samples, dtype=complex)
    if len(w) < 8:
        raise InputError(f"a spectrum needs 8 samples at least, not {len(w)}")
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(len(w)) / len(w))
    w = window * (w - (window * w).sum() / window.sum())
    frequency = np.fft.fftshift(np.fft.fftfreq(len(w), spacing))
    power = np.fft.fftshift(np.abs(np.fft.fft(w)) ** 2)
    if power.sum() == 0:
        return Spectrum(frequency, power, 0.0, 0.0)
    power = power / power.sum()
    peak = int(power.argmax())
    around = slice(max(0, peak - 2), peak + 3)
    dominant = float((frequency[around] * power[around]).sum() / power[around].sum())
    return Spectrum(frequency, power, dominant, float(np.sqrt((power * (frequency - dominant) ** 2).sum())))
