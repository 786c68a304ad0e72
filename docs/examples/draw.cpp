// Draws spheres and walls that it makes itself, and the last frame of a file if one is named:
//     draw spheres.png [FILE file.png]
#include <cmath>
#include <cstdio>
#include <numbers>

#include <grainreel/error.hpp>
#include <grainreel/picture.hpp>

namespace {

// A spiral of 200 spheres, small ones and every tenth a big one, m.
grainreel::Frame spiral() {
    grainreel::Frame frame;
    for (int k = 0; k < 200; ++k) {
        const double angle = 2 * std::numbers::pi * k / 25, height = 0.004 + 0.0004 * k;
        frame.add({0.03 * std::cos(angle), 0.03 * std::sin(angle), height}, k % 10 == 0 ? 0.005 : 0.003,
                  k % 10 == 0 ? 1 : 0);
    }
    return frame;
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2 && argc != 4) return 2;
    grainreel::World world;
    world.species = {"small", "big"};
    world.walls = {
        grainreel::Mesh::plate("floor", {-0.05, -0.05, 0}, {0.1, 0, 0}, {0, 0.1, 0}),
        grainreel::Mesh::plate("wall", {-0.05, -0.05, 0}, {0, 0.1, 0}, {0, 0, 0.1}),
    };
    const grainreel::Frame frame = spiral();
    grainreel::Painter painter(
        world, frame, {"film.size=480x360", "film.camera.elevation=25", "species.big.colour=#1f4e9e"});
    painter.draw(frame, "a spiral").write_png(argv[1]);
    if (argc == 2) return 0;

    const grainreel::FrameFile file(argv[2]);
    for (const std::string& line : file.news()) std::fprintf(stderr, "%s\n", line.c_str());
    grainreel::Painter(file, {"film.size=480x360"}).draw(file.frame(file.size() - 1)).write_png(argv[3]);
    return 0;
} catch (const grainreel::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
