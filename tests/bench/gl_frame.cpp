// One picture drawn with OSMesa or with EGL: its pixels and what it costs. For machines with a graphics card,
// which need not have the rest of the program's libraries.
//
//   gl_frame osmesa|egl LAYERS THREADS ROUNDS OUT.ppm
//
// A block of 20 x 20 x LAYERS grains (50 x 50 from 100 layers on) in a glass box, 1920 x 1080, with occlusion
// and shadows but without words. Prints one line of JSON: the context, the grains, and milliseconds a frame
// (wall clock; least and median).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "render/picture/whole/renderer.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double kSide = 0.1;  // m, of the box

// Grains in layers that touch, every second one shifted by half a grain, so that many hide each other.
State bed(int across, int layers) {
    State frame;
    const double apart = kSide / across, radius = 0.47 * apart;
    for (int k = 0; k < layers; ++k)
        for (int j = 0; j < across; ++j)
            for (int i = 0; i < across; ++i) {
                const double shift = k % 2 == 0 ? 0.45 : 0.55;
                frame.id.push_back(static_cast<std::int32_t>(frame.id.size()));
                frame.species.push_back((i + j + k) % 3 == 0 ? 1 : 0);
                frame.radius.push_back(radius);
                frame.position.emplace_back((i + shift) * apart - 0.5 * kSide,
                                            (j + shift) * apart - 0.5 * kSide, (k + 0.5) * 0.85 * apart);
            }
    frame.velocity.assign(frame.size(), Vec3(0, 0, 0));
    frame.spin = frame.velocity;
    return frame;
}

FilmedScene box(const State& frame) {
    FilmedScene scene;
    scene.film.width = 1920, scene.film.height = 1080;
    scene.film.words = WordPlace::none;
    const double top = frame.position.back().z() + 0.02;
    for (const char* name : {"small", "big"}) {
        Species& grains = scene.species.emplace_back();
        grains.name = name;
        grains.count = 0;
        const double d = 2 * frame.radius.front();
        grains.diameter = {SizeSpread::Kind::fixed, d, d, d, 0};
        grains.density = 2500;
    }
    for (std::int32_t species : frame.species) ++scene.species[static_cast<std::size_t>(species)].count;
    scene.colours = {{0.337, 0.706, 0.914}, {0.902, 0.624, 0.0}};
    scene.container.shape = Container::Shape::box;
    scene.container.half_width = 0.5 * kSide, scene.container.depth = kSide, scene.container.height = top;
    scene.film.camera.position = Vec3(3.8 * kSide, 1.2 * kSide, 0.6 * top + kSide);
    scene.film.camera.target = Vec3(0, 0, 0.5 * top);
    return scene;
}

int measure(gl::Provider provider, int layers, int threads, int rounds, const char* out) {
    const State frame = bed(layers >= 100 ? 50 : 20, layers);
    const FilmedScene scene = box(frame);
    Renderer renderer(scene, bare_layout(scene.film), threads, provider);
    Picture picture(1920, 1080);
    std::vector<double> times;
    for (int round = -2; round < rounds; ++round) {
        const auto begin = std::chrono::steady_clock::now();
        renderer.draw_into(picture, frame, "", 0);
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
        if (round >= 0) times.push_back(taken.count());
    }
    std::sort(times.begin(), times.end());
    std::FILE* file = std::fopen(out, "wb");
    if (!file) return 1;
    std::fprintf(file, "P6\n%d %d\n255\n", picture.width, picture.height);
    for (std::size_t k = 0; k < picture.rgba.size(); k += 4) std::fwrite(&picture.rgba[k], 1, 3, file);
    std::fclose(file);
    std::printf(
        "{\"context\": \"%s\", \"grains\": %zu, \"threads\": %d, \"least_ms\": %.1f, \"median_ms\": %.1f}\n",
        renderer.gl_description().c_str(), frame.size(), threads, times.front(), times[times.size() / 2]);
    return 0;
}

}  // namespace
}  // namespace grainreel

int main(int count, char** words) {
    using grainreel::gl::Provider;
    if (count != 6) return 2;
    const Provider provider = std::strcmp(words[1], "egl") == 0 ? Provider::egl : Provider::osmesa;
    try {
        return grainreel::measure(provider, std::max(1, std::atoi(words[2])),
                                  std::max(1, std::atoi(words[3])), std::max(1, std::atoi(words[4])),
                                  words[5]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "gl_frame: %s\n", error.what());
        return 1;
    }
}
