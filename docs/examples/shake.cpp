// Shakes a box of beads and measures it, period by period: the mean height of the centres, the centre of mass
// as measures.csv has it, and how many contacts there are.
#include <cstdio>

#include <grainreel/error.hpp>
#include <grainreel/simulation.hpp>

namespace {

const char* const kScene = R"(
[[species]]
name = "bead"
count = 60
diameter = "4 mm"
density = "2.5 g/cm3"
[container]
shape = "box"
width = "30 mm"
depth = "20 mm"
height = "40 mm"
[drive]
frequency = "30 Hz"
amplitude = "0.4 mm"
[run]
duration = "0.2 s"
accuracy = "draft"
)";

double mean_height(const grainreel::Frame& frame) {
    double sum = 0;
    for (const grainreel::Vector& place : frame.position) sum += place.z;
    return sum / static_cast<double>(frame.size());
}

}  // namespace

int main() try {
    const grainreel::Scene scene = grainreel::Scene::from_text(kScene, "shaken_box.toml");
    for (const std::string& line : scene.warnings()) std::fprintf(stderr, "%s\n", line.c_str());
    grainreel::Simulation simulation(scene);
    simulation.pack();
    while (!simulation.finished()) {
        simulation.advance(simulation.time() + scene.period());
        const grainreel::Frame now = simulation.frame();
        std::printf("%.6f s: %zu beads, mean height %.12g m, centre of mass %.12g m, %zu contacts\n",
                    simulation.time(), now.size(), mean_height(now), simulation.measure("centre_z_m"),
                    simulation.contacts().size());
    }
    return 0;
} catch (const grainreel::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.kind() == grainreel::Error::Kind::mistake ? 2 : 1;
}
