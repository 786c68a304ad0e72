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

}  // namespace grainreel
