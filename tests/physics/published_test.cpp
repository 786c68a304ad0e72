// Oblique impacts against what experiments found.
#include <gtest/gtest.h>

#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

struct After {
    double normal, tangential, spin;  // over the speed; spin times the radius
};

// A ball on a plate at an angle of incidence, Walton-Braun with incremental slip, 200 steps a contact.
After impact(double e, double mu, double ratio, double degrees) {
    World w = make_world(walton_braun_pair(e, mu, ratio), 0);
    const double speed = 0.3, angle = degrees * pi / 180, down = speed * std::cos(angle);
    w.plan.clock.step = pi / 2 * (1 + e) * std::sqrt(sphere_mass() / kStiffness) / 200;
    w.around.faces = {floor_face()};
    w.grains.add(0, 0, Vec3(0, 0, kRadius + 0.4 * down * w.plan.clock.step), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(speed * std::sin(angle), 0, -down);
    w.start();
    w.run(600);
    return {w.velocity(0).z() / speed, w.velocity(0).x() / speed, kRadius * w.spin(0).y() / speed};
}

// Kharaz, Gorham & Salman (2001, Powder Technol. 120, 281): 5 mm alumina on thick glass, e = 0.98, mu = 0.092
// at all angles. Where the ball slides throughout, above 3.5 mu (1 + e) in tan (their figures 5 and 6 follow
// it from about 30 degrees on): tangential restitution 1 - mu (1 + e) / tan, spin 2.5 mu (1 + e) cos / r.
TEST(Published, AluminaOnGlassSlidesAsKharazFound) {
    const double e = 0.98, mu = 0.092;
    for (const double degrees : {40.0, 50.0, 60.0, 70.0, 80.0}) {
        const After is = impact(e, mu, 0.8, degrees);
        const double tangent = std::tan(degrees * pi / 180), cosine = std::cos(degrees * pi / 180);
        EXPECT_NEAR(is.normal / cosine, e, 2e-3) << degrees;
        EXPECT_NEAR(is.tangential / (cosine * tangent), 1 - mu * (1 + e) / tangent, 5e-3) << degrees;
        EXPECT_NEAR(is.spin, 2.5 * mu * (1 + e) * cosine, 5e-3) << degrees;
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
        // The ratio that turns the slip by that much: beta0 = -cos[sqrt(3.5 K0/K1) (pi/2)(1 + e)], sticking.
        const double turn = pi - std::acos(m.beta0), ratio = std::pow(turn / (pi / 2 * (1 + m.e)), 2) / 3.5;
        const auto slip = [&](double psi) {
            const double degrees = std::atan(psi) * 180 / pi;
            const After is = impact(m.e, m.mu, ratio, degrees);
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
