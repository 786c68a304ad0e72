// Formulas for the segregation of two kinds of grain: mixing by samples, order by height, and grains at side
// walls. The observers are in segregation_observers.hpp.
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

// Mean number of grains of the rarer kind that a sample must have. With fewer there is no index. At this
// number one sample in exp(3) = 20 has none of these grains by chance (Poisson). With fewer grains, samples
// of a mixture would look like samples of layers.
inline constexpr double kLeastOfRareKind = 3;

// The distribution of one kind of grain over samples of the bed. The bed is halved along its longest edge
// again and again, until there are samples of equal counts: kLaceySample grains or slightly more on average.
// A bed of fewer than two such samples is cut into two smaller ones.
struct Samples {
    double share = 0;     // p, share of the marked grains among all, by number
    double variance = 0;  // s^2, variance of their share over the samples
    double grains = 0;    // n, mean number of grains per sample

    double segregated_variance() const {
        return share * (1 - share);
    }  // s0^2, if each sample were of one kind
    double rare_grains() const { return std::min(share, 1 - share) * grains; }  // mean per sample
};
// The mean number of grains per sample when `count` grains are divided.
double grains_per_sample(std::size_t count);
// `marked` is 1 for the grains whose share is taken, and 0 for the others.
Samples take_samples(const std::vector<Vec3>& position, const std::vector<std::uint8_t>& marked);

// Lacey's mixing index M = (s0^2 - s^2) / (s0^2 - sr^2), sr^2 = s0^2 / n (Lacey 1954, J. Appl. Chem. 4, 257):
// 0 for full segregation, 1 for a random mixture. NaN if the samples have on average fewer than
// kLeastOfRareKind of the marked grains or of the others.
double lacey_index(const Samples& samples);

// Danckwerts' intensity of segregation I = s^2 / s0^2 (1952, Appl. Sci. Res. A 3, 279). It is 1 if each
// sample is of one kind. In a random mixture it is 1 / n on average, with a scatter of sqrt(2 / (samples -
// 1)) / n. NaN if all grains are of one kind.
double intensity_of_segregation(const Samples& samples);

// Probability that one of `these` lies above one of `those`, where equal heights count half: Mann and
// Whitney's U divided by the number of pairs (1947, Ann. Math. Stat. 18, 50). It is 0 if all are below, 1/2
// if mixed, 1 if all are above, and has a meaning for a single grain too. NaN if either is empty. Reorders
// both vectors.
double share_above(std::vector<double>& these, std::vector<double>& those);

// Height (m) below which 95 % of the grains' centres lie. It is the bed height by which the height difference
// is divided. Grains in flight hardly change it. Reorders the vector.
double bed_height(std::vector<double>& heights);

// The two species that the segregation indices compare.
//
// These are the species of the largest and of the smallest mean diameter. If all have one size, they are the
// first and the second species. There must be at least two species.
struct BigAndSmall {
    std::size_t big = 0, small = 0;
};
BigAndSmall big_and_small(const std::vector<Species>& species);

// The side wall of the container beside which a grain lies.
enum class Side { left, right, none };

// The side walls of a container. Slants count as walls, and the halves y < 0 and y > 0 of a cylinder's wall
// count as left and right. Front and back do not count: in a narrow bed every grain is beside them.
class SideWalls {
  public:
    // A grain lies beside a wall if no grain of the smallest mean diameter fits between them.
    explicit SideWalls(const Scene& scene);

    bool any() const { return !faces_.empty(); }
    Side side_of(const Place& grain, const DrivePose& pose) const;

  private:
    std::vector<Face> faces_;
    double gap_ = 0;  // m
};

// Heights (m) above the floor of the centres of all grains, or of the grains of one species. `floor` is the
// floor's height (m).
std::vector<double> heights_above(const Grains& grains, double floor,
                                  std::optional<std::size_t> species = {});

// The mean height of each species. `species` is the number of species.
std::vector<double> mean_heights(const Grains& grains, std::size_t species, double floor);

}  // namespace grainreel
