// Whether a surface repeats itself with each period of the drive, or only after two or four.
#pragma once

#include <vector>

namespace grainreel {

// Periods of which surfaces are compared.
constexpr int kComparedPeriods = 8;

struct Subharmonics {
    double half = 0;     // share at f/2: the surface is inverted after each period
    double quarter = 0;  // share at f/4: it is inverted after two periods
};

// h_n(y), n = 0 to 7: the surface at one phase of successive periods, its mean over y taken off. Over n its
// discrete Fourier transform has the parts
//     A = 1/8 sum (-1)^n h_n  at f/2,   B = 1/8 sum (-i)^n h_n  at f/4 (and its conjugate),
// and by Parseval's theorem |A|^2 and 2 |B|^2, summed over y, are their shares in the mean of h_n^2. Waves at
// f/2 give 1 and 0, waves at f/4 give 0 and 1, a heap at rest 0 and 0; surfaces by chance 1/8 and 1/4. NaN
// where all surfaces are flat. The surfaces have equal numbers of bins, and there are kComparedPeriods.
Subharmonics subharmonics_of(const std::vector<const std::vector<double>*>& surfaces);

}  // namespace grainreel
