// The surface of a bed across its container, h(y), the height of the topmost grains; and what it tells:
// mounds, waves, and whether these repeat themselves.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Heights of the surface at the middles of equal bins of y.
struct BedOutline {
    double left = 0, bin = 0;    // m, place where the first bin begins, and width of each bin
    std::vector<double> height;  // m, in the frame of the scene

    double width() const { return bin * static_cast<double>(height.size()); }  // m
    double place(std::size_t i) const { return left + bin * (static_cast<double>(i) + 0.5); }
    double mean() const;
};

// The frame of the bed: y from left to right and x from back to front (m), and the size of its grains.
struct SurfaceAxes {
    double left = 0, right = 0, back = 0, front = 0;
    double period = 0;    // m, of x; 0 for none
    double diameter = 0;  // m, of grains; bins are about two diameters wide
};

std::size_t bins_across(const SurfaceAxes& frame);

// The bed is divided into columns two diameters wide and deep. In each column grains are stacked from the
// lowest one up. The bed ends where the next grain leaves a gap of more than a diameter and a half, so grains
// in flight do not count. The top of the highest grain below this gap is the surface of the column, and h is
// its mean over the depth. A grain counts in the column that holds its centre, and with its longest chord in
// every other column that it reaches into. Columns whose middle no grain reaches are beside the bed and do
// not count. A bin without any column takes the mean of the nearest bins. The result is empty without grains.
BedOutline surface_of(std::span<const Place> grains, const SurfaceAxes& frame);

//
// The frame of a scene's surface: that of the container at rest. Its width is the free width at the height to
// which the grains fill the container. Bins are sized by the mean diameter of all grains. It has no width in
// empty space, nor in a drum (surface_observers.hpp).
SurfaceAxes surface_frame(const Scene& scene);

// How far a surface is heaped up.
struct Mound {
    double height = 0;  // m, mean of the middle third minus that of the two outer sixths
    double slope = 0;   // tangent, mean rise of both halves towards the middle
    double tilt = 0;    // tangent, rise of the whole surface from left to right
};

// Slopes are those of least-squares lines through the bins. A tent of slope s over the width W has the slope
// s, no tilt, and the height s W / 3. A plane has no slope. NaN with fewer than six bins.
Mound mound_of(const BedOutline& surface);

// The strongest wave of a surface.
struct DominantWave {
    double wavelength = 0;  // in the unit of the width
    double share = 0;       // share of the surface's variance, 0 to 1
};

// The periodogram of a surface of N bins over the width W, with its mean m subtracted (Schuster 1898, Terr.
// Magn. 3, 13), at half and whole numbers of waves across, because standing waves between two walls have
// both:
//     H_k = sum over j of (h_j - m) exp(-i pi k (j + 1/2) / N),   wavelength 2 W / k.
// The sums are made one by one, since there are at most a few hundred bins. The dominant wave is
// the largest |H_k| of those whose wavelength is at least four bins; and its share in the variance v is 2
// |H_k|^2 / (N^2 v).
class Spectrum {
  public:
    explicit Spectrum(std::size_t bins);

    // `heights` has one value per bin. NaN if the surface is flat or has too few bins for a wave.
    DominantWave dominant(const std::vector<double>& heights, double width) const;

  private:
    std::size_t bins_;
    std::vector<double> sines_, cosines_;  // of pi n / N, for n = 0 to 2 N - 1
};

double mean_height_of(const std::vector<double>& heights);
double variance_of(const std::vector<double>& heights);  // variance about their mean

// Number of periods whose surfaces are compared. The comparison shows whether a surface repeats itself with
// each period of the drive, or only after two or four.
constexpr int kComparedPeriods = 8;

struct Subharmonics {
    double half = 0;     // share at f/2, where the surface is inverted after each period
    double quarter = 0;  // share at f/4, where it is inverted after two periods
};

// h_n(y), n = 0 to 7, is the surface at one phase of successive periods, minus its mean over y. Over n its
// discrete Fourier transform has the parts
//     A = 1/8 sum (-1)^n h_n  at f/2,   B = 1/8 sum (-i)^n h_n  at f/4 (and its conjugate),
// and by Parseval's theorem |A|^2 and 2 |B|^2, summed over y, are their shares in the mean of h_n^2. Waves at
// f/2 give 1 and 0, waves at f/4 give 0 and 1, a heap at rest gives 0 and 0, and random surfaces give 1/8 and
// 1/4. NaN if all surfaces are flat. There must be kComparedPeriods surfaces with equal numbers of bins.
Subharmonics subharmonics_of(const std::vector<const std::vector<double>*>& surfaces);

}  // namespace grainreel
