// What walls of triangles cost a frame: a bed of 10,000 grains in 1920 x 1080, alone and inside a vessel of
// so many triangles, glass before the grains and solid behind them. Processor time of the whole process on
// one thread, frames in turns, the same eye for both.
//
//   mesh_frame [triangles, 10000] [rounds, 20]
#include <ctime>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "engine/mesh/load_mesh.hpp"
#include "engine/mesh/surface.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double kSide = 0.1, kRadius = 0.00235;  // m
constexpr int kAcross = 20, kLayers = 25;

// A box without a lid, each face of n x n squares.
Shared<Surface> vessel(int n) {
    TriangleMesh mesh;
    const double h = 0.5 * kSide, top = 1.3 * kSide;
    const auto add_face = [&](const Vec3& at, const Vec3& u, const Vec3& v) {
        const auto first = static_cast<std::int32_t>(mesh.vertices.size());
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i)
                mesh.vertices.push_back(at + static_cast<double>(i) / n * u + static_cast<double>(j) / n * v);
        for (std::int32_t j = 0; j < n; ++j)
            for (std::int32_t i = 0; i < n; ++i) {
                const std::int32_t a = first + j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
                mesh.triangles.push_back({a, b, c});
                mesh.triangles.push_back({a, c, d});
            }
    };
    add_face({-h, -h, 0}, {kSide, 0, 0}, {0, 0, top});
    add_face({h, -h, 0}, {0, kSide, 0}, {0, 0, top});
    add_face({h, h, 0}, {-kSide, 0, 0}, {0, 0, top});
    add_face({-h, h, 0}, {0, -kSide, 0}, {0, 0, top});
    add_face({-h, -h, 0}, {0, kSide, 0}, {kSide, 0, 0});
    MeshFacts facts;
    mend(mesh, facts);
    Shared<Surface> surface;
    surface.of = std::make_shared<const Surface>(std::move(mesh), facts, "vessel");
    return surface;
}

FilmedScene scene_with(int n) {
    FilmedScene scene;
    scene.film.width = 1920, scene.film.height = 1080;
    scene.film.words = WordPlace::none;
    Species& grains = scene.species.emplace_back();
    grains.name = "grains";
    grains.count = kAcross * kAcross * kLayers;
    grains.diameter = {SizeSpread::Kind::fixed, 2 * kRadius, 2 * kRadius, 2 * kRadius, 0};
    grains.density = 2500;
    scene.colours = {{0.902, 0.624, 0.0}};
    scene.container.shape = Container::Shape::none;
    scene.film.camera.position = Vec3(0.38, 0.12, 0.14);
    scene.film.camera.target = Vec3(0, 0, 0.06);
    if (n == 0) return scene;
    SceneMesh& mesh = scene.meshes.emplace_back();
    mesh.name = "vessel";
    mesh.surface = vessel(n);
    mesh.low = {-0.5 * kSide, -0.5 * kSide, 0}, mesh.high = {0.5 * kSide, 0.5 * kSide, 1.3 * kSide};
    scene.film.look.walls.glass = {"vessel"};
    return scene;
}

State bed() {
    State frame;
    const double apart = kSide / kAcross;
    for (int k = 0; k < kLayers; ++k)
        for (int j = 0; j < kAcross; ++j)
            for (int i = 0; i < kAcross; ++i) {
                frame.id.push_back(static_cast<std::int32_t>(frame.id.size()));
                frame.species.push_back(0);
                frame.radius.push_back(kRadius);
                frame.position.emplace_back((i + 0.5) * apart - 0.5 * kSide, (j + 0.5) * apart - 0.5 * kSide,
                                            (k + 0.5) * 0.0048);
            }
    frame.velocity.assign(frame.size(), Vec3(0, 0, 0));
    frame.spin = frame.velocity;
    return frame;
}

double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

int measure(int triangles, int rounds) {
    const int n = static_cast<int>(std::lround(std::sqrt(triangles / 10.0)));
    const State frame = bed();
    std::array<std::unique_ptr<Renderer>, 2> renderers;
    std::array<std::vector<double>, 2> times;
    for (std::size_t k = 0; k < 2; ++k)
        renderers[k] = std::make_unique<Renderer>(scene_with(k == 0 ? 0 : n), 1);
    Picture picture(1920, 1080);
    for (int round = -2; round < rounds; ++round)
        for (std::size_t k = 0; k < 2; ++k) {
            const double begin = processor_ms();
            renderers[k]->draw_into(picture, frame, "", 0);
            if (round >= 0) times[k].push_back(processor_ms() - begin);
        }
    for (std::size_t k = 0; k < 2; ++k) std::sort(times[k].begin(), times[k].end());
    const auto middle = [&](std::size_t k) { return times[k][times[k].size() / 2]; };
    std::printf("%zu grains, %d rounds, ms of processor time a frame: least, median\n", frame.size(), rounds);
    std::printf("alone              %6.1f %6.1f\n", times[0].front(), middle(0));
    std::printf("%6d triangles   %6.1f %6.1f\n", 10 * n * n, times[1].front(), middle(1));
    std::printf("difference         %6.1f %6.1f\n", times[1].front() - times[0].front(),
                middle(1) - middle(0));
    return 0;
}

}  // namespace
}  // namespace grainreel

int main(int count, char** words) {
    const int triangles = count > 1 ? std::atoi(words[1]) : 10'000,
              rounds = count > 2 ? std::atoi(words[2]) : 20;
    return grainreel::measure(std::max(triangles, 10), std::max(rounds, 1));
}
