// Measures of segregation of two kinds of grain: mixing by samples, order by height, and grains at side
// walls. Plain formulas; the observers stand in segregation_observers.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Mean number of grains in a sample of the Lacey index. The index depends on it, so it is fixed.
inline constexpr int kLaceySample = 32;

// Mean number of grains of the rarer kind that a sample must have; with fewer there is no index. At this
// number one sample in exp(3) = 20 has none of them by chance (Poisson). With fewer still, samples of a
// mixture look like those of a layer.
inline constexpr double kLeastOfRareKind = 3;

// What samples of the bed show of one kind of grain among all. The samples have equal counts of grains,
// kLaceySample or slightly more on average (at least two samples), cut by halving the bed along its longest
// edge again and again.
struct Samples {
    double share = 0;     // p, number share of the marked grains among all
    double variance = 0;  // s^2, of their share over the samples
    double grains = 0;    // n, a sample on average

    double segregated_variance() const { return share * (1 - share); }  // s0^2, were each sample of one kind
    double rare_grains() const { return std::min(share, 1 - share) * grains; }  // a sample on average
};
Samples take_samples(const std::vector<Vec3>& position, const std::vector<std::uint8_t>& marked);

// Lacey's mixing index M = (s0^2 - s^2) / (s0^2 - sr^2), sr^2 = s0^2 / n (Lacey 1954, J. Appl. Chem. 4, 257):
// 0 for full segregation, 1 for a random mixture. NaN when the samples hold fewer than kLeastOfRareKind of
// the marked or of the others on average.
double lacey_index(const Samples& samples);

// Danckwerts' intensity of segregation I = s^2 / s0^2 (1952, Appl. Sci. Res. A 3, 279): 1 where each sample
// is of one kind, 1 / n on average in a random mixture, with a scatter of sqrt(2 / (samples - 1)) / n. NaN
// where all grains are of one kind.
double intensity_of_segregation(const Samples& samples);

// Probability that one of `these` lies above one of `those`, equal heights counting half: Mann and Whitney's
// U over the number of pairs (1947, Ann. Math. Stat. 18, 50). 0 all below, 1/2 mixed, 1 all above; right for
// a single grain too. NaN when there are none of either. Reorders.
double share_above(std::vector<double>& these, std::vector<double>& those);

// m: height below which 95 % of the grains' centres lie; the bed height of the height difference. Grains in
// flight have no say in it. Reorders.
double bed_height(std::vector<double>& heights);

// The two species that the segregation indices compare.
//
// These are the species of the largest and of the smallest mean diameter; where all are of one size, the
// first and the second. There must be two at least.
struct BigAndSmall {
    std::size_t big = 0, small = 0;
};
BigAndSmall big_and_small(const std::vector<Species>& species);

// Which grains lie beside the left wall of the container, and which beside the right one.
enum class Side { left, right, none };

// Slants count as walls, and the halves y < 0 and y > 0 of a cylinder's wall as left and right. Front and
// back do not count: in a narrow bed every grain is beside them.
class SideWalls {
  public:
    // A grain lies beside a wall when no grain of the smallest mean diameter fits between the two.
    explicit SideWalls(const Scene& scene);

    bool any() const { return !faces_.empty(); }
    Side side_of(const Place& grain, const Pose& pose) const;

  private:
    std::vector<Face> faces_;
    double gap_ = 0;  // m
};

// Heights (m) of all grains' centres above the floor, or of those of one species. floor: m, its height.
std::vector<double> heights_above(const Grains& grains, double floor,
                                  std::optional<std::size_t> species = {});

// The mean height of each species. species: how many there are.
std::vector<double> mean_heights(const Grains& grains, std::size_t species, double floor);

}  // namespace grainreel
