// What wave a surface shows most of.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace grainreel {

struct DominantWave {
    double wavelength = 0;  // in the unit of the width
    double share = 0;       // of the surface's variance, 0 to 1
};

// The periodogram of a surface of N bins over the width W, its mean m taken off (Schuster 1898, Terr. Magn.
// 3, 13), at half and whole numbers of waves across, for standing waves between two walls have both:
//     H_k = sum over j of (h_j - m) exp(-i pi k (j + 1/2) / N),   wavelength 2 W / k.
// It is a Fourier transform of twice the length, half of it zeros (by Eigen's KISS FFT). The dominant wave is
// the largest |H_k| of those whose wavelength is at least four bins; its share in the variance v is 2 |H_k|^2
// / (N^2 v).
class Spectrum {
  public:
    explicit Spectrum(std::size_t bins);
    ~Spectrum();
    Spectrum(Spectrum&&) noexcept;
    Spectrum& operator=(Spectrum&&) noexcept;

    // heights: as many as bins. NaN where the surface is flat or has too few bins for a wave.
    DominantWave dominant(const std::vector<double>& heights, double width);

  private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

double mean_height_of(const std::vector<double>& heights);
double variance_of(const std::vector<double>& heights);  // about their mean

// Whether a surface repeats itself with each period of the drive, or only after two or four.

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
