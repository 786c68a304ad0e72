// A contact law of your own: a linear spring and dashpot with friction. With this law a ball falls on a
// plane, and two balls meet in the air.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include <grainreel/error.hpp>
#include <grainreel/simulation.hpp>

namespace {

// N = k d + c v for the overlap d and the closing speed v. c gives a free impact the scene's restitution e:
// c = 2 z sqrt(m k), z = -ln e / sqrt(pi^2 + ln^2 e). T = k s / 2, at most mu N; s is the slip in the spring.
class Spring final : public grainreel::ContactLaw {
  public:
    int vectors() const override { return 1; }

    grainreel::ContactForce force(const grainreel::Touch& touch,
                                  grainreel::ContactMemory memory) const override {
        const double log_e = std::log(touch.restitution);
        const double ratio = -log_e / std::hypot(std::numbers::pi, log_e);
        const double damping = 2 * ratio * std::sqrt(touch.effective_mass * touch.stiffness);
        grainreel::ContactForce answer;
        answer.normal = touch.stiffness * touch.overlap + damping * touch.closing_speed;

        grainreel::Vector& slip = memory.vectors[0];  // m
        slip.x += touch.slip.x, slip.y += touch.slip.y, slip.z += touch.slip.z;
        const double stiffness = touch.stiffness / 2;
        const double size = stiffness * std::hypot(slip.x, slip.y, slip.z);
        const double most = touch.friction * std::max(0.0, answer.normal);
        const double kept = size > most ? most / size : 1;
        slip.x *= kept, slip.y *= kept, slip.z *= kept;
        answer.tangential = {stiffness * slip.x, stiffness * slip.y, stiffness * slip.z};
        return answer;
    }
    double stored_energy(const grainreel::Touch& touch, grainreel::ContactMemory memory) const override {
        const grainreel::Vector& slip = memory.vectors[0];
        return touch.stiffness * touch.overlap * touch.overlap / 2 +
               touch.stiffness / 4 * (slip.x * slip.x + slip.y * slip.y + slip.z * slip.z);
    }
};

const char* const kScene = R"(
[[species]]
name = "ball"
diameter = "10 mm"
density = "2.5 g/cm3"
[[grain]]
position = ["0 mm", "0 mm", "25 mm"]
[[grain]]
position = ["0 mm", "100 mm", "1 m"]
velocity = ["0 m/s", "0.5 m/s", "0 m/s"]
[[grain]]
position = ["0 mm", "114 mm", "1.004 m"]
[[wall]]
point = ["0 mm", "0 mm", "0 mm"]
normal = [0, 0, 1]
[container]
shape = "none"
[contact]
law = "spring-dashpot"
stiffness = "50 kN/m"
restitution = 0.8
friction = 0.3
[run]
duration = "0.2 s"
)";

}  // namespace

int main() try {
    grainreel::SimulationOptions options;
    options.laws = {{std::make_shared<Spring>()}};
    grainreel::Simulation simulation(grainreel::Scene::from_text(kScene, "own_law.toml"), options);
    simulation.pack();
    while (!simulation.finished()) {
        simulation.advance_steps(100);
        const grainreel::Frame now = simulation.frame();
        std::printf("%.12f", simulation.time());
        for (std::size_t i = 0; i < now.size(); ++i)
            std::printf(" %.12g %.12g %.12g %.12g %.12g", now.position[i].y, now.position[i].z,
                        now.velocity[i].y, now.velocity[i].z, now.spin[i].x);
        std::printf("\n");
    }
    return 0;
} catch (const grainreel::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
