// Tests of profiles of states with a known answer.
#include "engine/measure/fields/coarse_graining.hpp"

#include <gtest/gtest.h>

#include "tests/physics/fields/field_scene.hpp"

namespace grainreel {
namespace {

constexpr double width = 0.5, cell = 0.25;

Scene box_of_two_species() {
    Scene scene = field_box({5, 5, 5}, FieldOutput::Grid::yz, width, cell);
    scene.species.resize(2);
    return scene;
}

// Layers of spheres at 0.5, 1.5, ...; the lower two are of the first species. upright: the layers follow each
// other along y.
FieldState layered(bool upright) {
    FieldState state = cubic_packing();
    for (FieldGrain& grain : state.grains) {
        const double layer = upright ? grain.position.y() + 2.5 : grain.position.z();
        grain.species = layer < 2 ? 0 : 1;
        grain.velocity = Vec3(0, 0, 3 * layer);
    }
    return state;
}

class Profiles : public ::testing::TestWithParam<ProfileAxis> {
  protected:
    Profiles() : by_(box_of_two_species(), 1) {
        by_.add(layered(GetParam() == ProfileAxis::across), 0);
        fields_ = by_.mean();
    }
    const GridAxis& axis() const { return by_.grid().axes[static_cast<std::size_t>(GetParam())]; }
    double place(std::size_t k) const {  // from where the layers begin
        return axis().middle(static_cast<std::int64_t>(k)) + (GetParam() == ProfileAxis::across ? 2.5 : 0.0);
    }
    CoarseGraining by_;
    CoarseFields fields_;
};

INSTANTIATE_TEST_SUITE_P(Each, Profiles, ::testing::Values(ProfileAxis::height, ProfileAxis::across));

TEST_P(Profiles, SolidFractionsHoldTheVolumeOfTheGrains) {
    const auto solid = solid_profiles(fields_, by_, GetParam());
    ASSERT_EQ(solid.size(), 2u);
    for (const auto& [species, grains] : {std::pair{0u, 50}, {1u, 75}}) {
        double volume = 0;
        for (std::size_t k = 0; k < solid[species].size(); ++k) {
            const bool inside = place(k) > 0 && place(k) < 5;
            EXPECT_EQ(std::isnan(solid[species][k]), !inside) << place(k);
            if (inside) volume += solid[species][k] * axis().cell * 25;
        }
        EXPECT_NEAR(volume, grains * std::numbers::pi / 6, 1e-9);
    }
}

// The kernel ends at 1.5, so that beside a layer only the two next layers count.
TEST_P(Profiles, SharesAreOneAmongTheirOwnAndHalfAtTheBorder) {
    const auto share = share_profiles(fields_, by_, GetParam());
    for (std::size_t k = 0; k < share[0].size(); ++k) {
        if (std::isnan(share[0][k])) continue;
        EXPECT_NEAR(share[0][k] + share[1][k], 1, 1e-12);
        if (place(k) < 0.99) {
            EXPECT_NEAR(share[0][k], 1, 1e-12) << place(k);
        }
        if (place(k) > 3.01) {
            EXPECT_NEAR(share[0][k], 0, 1e-12) << place(k);
        }
        // The border lies in the middle between two cells.
        if (std::abs(place(k) - 1.875) < 1e-9) {
            // The floor cuts off part of the lowest layer's kernel. This is made up for, so that the layer
            // counts a little more.
            EXPECT_NEAR(share[0][k] + share[0][k + 1], 1, 2e-3);
            EXPECT_GT(share[0][k], 0.55);
        }
    }
}

// Expected are the layers' velocities, averaged with the Gaussian weights exp(-(z - z_k)^2 / 2 w^2).
TEST_P(Profiles, VelocityIsMomentumOverMass) {
    const std::vector<double> velocity = velocity_profile(fields_, by_, GetParam(), 2);
    int looked_at = 0;
    for (std::size_t k = 0; k < velocity.size(); ++k) {
        if (place(k) < 1 || place(k) > 4) continue;
        double momentum = 0, mass = 0;
        for (const double layer : {0.5, 1.5, 2.5, 3.5, 4.5}) {
            const double weight = std::exp(-std::pow((place(k) - layer) / width, 2) / 2);
            momentum += weight * 3 * layer;
            mass += weight;
        }
        EXPECT_NEAR(velocity[k], momentum / mass, 0.02 * 3) << place(k);
        ++looked_at;
    }
    EXPECT_EQ(looked_at, 12);
    for (const double across : velocity_profile(fields_, by_, GetParam(), 1))
        if (!std::isnan(across)) {
            EXPECT_EQ(across, 0);
        }
}

// In a wedge a heavy grain rises in the middle and a light one sinks at the slant, too far apart to be in one
// kernel. Mean velocity times mass, summed over heights, is their momentum.
TEST(VelocityProfile, IsByTheMassInsideTheContainer) {
    Scene scene = field_box({4, 10, 12}, FieldOutput::Grid::yz, width, 0.37);
    scene.container.shape = Container::Shape::wedge;
    scene.container.half_angle = 0.5;
    scene.container.slant_height = 6;
    CoarseGraining by(scene, 1);
    FieldState state;
    state.grains.push_back(sphere(Vec3(0, -0.5, 3), 0.5, 3 * 6 / std::numbers::pi, Vec3(0, 0, 1)));
    state.grains.push_back(sphere(Vec3(0, 3.3, 3), 0.5, 6 / std::numbers::pi, Vec3(0, 0, -1)));
    by.add(state, 0);
    const CoarseFields fields = by.mean();
    const std::vector<double> profile = velocity_profile(fields, by, ProfileAxis::height, 2);
    const FieldGrid& grid = by.grid();
    double momentum = 0;
    for (std::int64_t k = 0; k < grid.axes[2].count; ++k) {
        double mass = 0;
        for (std::int64_t j = 0; j < grid.axes[1].count; ++j) {
            const auto at = static_cast<std::size_t>(grid.index(0, j, k));
            mass += fields.density[at] * by.shares()[at] * grid.cell_volume();
        }
        if (mass > 0) momentum += mass * profile[static_cast<std::size_t>(k)];
    }
    EXPECT_NEAR(momentum, 3 * 1 - 1, 1e-10);
}

}  // namespace
}  // namespace grainreel
