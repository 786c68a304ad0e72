// Oblique impacts against what experiments found.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/lab/chart/validation/impacts.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

ImpactLaw incremental_slip(double e, double mu, double ratio) {
    return {NormalForce::walton_braun, TangentialLaw::incremental_slip, e, mu, ratio, tested_precision()};
}

// Kharaz, Gorham & Salman (2001, Powder Technol. 120, 281): 5 mm alumina on thick glass, e = 0.98, mu = 0.092
// at all angles. Where the ball slides throughout, above 3.5 mu (1 + e) in tan (their figures 5 and 6 follow
// it from about 30 degrees on): tangential restitution 1 - mu (1 + e) / tan, spin 2.5 mu (1 + e) cos / r.
TEST(Published, AluminaOnGlassSlidesAsKharazFound) {
    const double e = 0.98, mu = 0.092;
    for (const double degrees : {40.0, 50.0, 60.0, 70.0, 80.0}) {
        const Rebound is = rebound(incremental_slip(e, mu, 0.8), degrees, Target::plane);
        const double tangent = std::tan(degrees * pi / 180), cosine = std::cos(degrees * pi / 180);
        EXPECT_NEAR(is.normal / cosine, e, 2e-3) << degrees;
        EXPECT_NEAR(is.tangential / (cosine * tangent), 1 - mu * (1 + e) / tangent, 5e-3) << degrees;
        EXPECT_NEAR(is.spin, 2.5 * mu * (1 + e) * cosine, 5e-3) << degrees;
    }
}

// Their points, read off their figures to about 0.01; below 28 degrees, where it sticks for a while, laws
// differ (chart validation shows by how much).
TEST(Published, AluminaOnGlassGoesThroughKharazPoints) {
    for (const kharaz::Point& p : kharaz::tangential_restitution) {
        if (p.degrees < 28) continue;
        const Rebound is =
            rebound(incremental_slip(kharaz::restitution, kharaz::friction, 0.86), p.degrees, Target::plane);
        EXPECT_NEAR(is.tangential / std::sin(p.degrees * pi / 180), p.value, 0.01) << p.degrees;
    }
}

// Foerster, Louge, Chang & Allia (1994, Phys. Fluids 6, 1108), binary impacts: glass e = 0.97, mu = 0.092,
// beta0 = 0.44; cellulose acetate 0.87, 0.25, 0.43. Their plot: with Psi the slip over the normal speed
// before, Psi2 = Psi1 - 3.5 (1 + e) mu where it slides, -beta0 Psi1 where it sticks.
TEST(Published, GlassAndAcetateReboundAsFoersterFound) {
    struct Material {
        double e, mu, beta0, uncertainty;
    };
    for (const Material& m : {Material{0.97, 0.092, 0.44, 0.07}, Material{0.87, 0.25, 0.43, 0.06}}) {
        const ImpactLaw law = incremental_slip(m.e, m.mu, ratio_that_turns(m.e, m.beta0));
        const auto slip = [&](double psi) {
            const double degrees = std::atan(psi) * 180 / pi;
            const Rebound is = rebound(law, degrees, Target::equal_sphere);
            return (is.tangential - is.spin) / std::cos(degrees * pi / 180);
        };
        const double sliding = 3.5 * (1 + m.e) * m.mu;
        for (const double psi : {2 * sliding, 3 * sliding, 5 * sliding})
            EXPECT_NEAR(slip(psi), psi - sliding, 0.03 * sliding) << m.e;
        const double sticking = 0.02 * sliding;
        EXPECT_NEAR(-slip(sticking) / sticking, m.beta0, m.uncertainty) << m.e;
    }
}

}  // namespace
}  // namespace grainreel
