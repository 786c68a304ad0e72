// Compares a picture of each feature with the one that was looked at and kept in tests/draw/golden. To draw
// all of them anew:
//
//   GRAINREEL_WRITE_GOLDEN=1 build/release/tests/test_draw --gtest_filter='*Golden*'
//
// Look at each picture before committing it.
#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>

#include "engine/measure/measures.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/panels/side_by_side.hpp"
#include "render/scene/film.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

constexpr int kWidth = 480, kHeight = 270;

std::string path_of(const std::string& name) {
    return std::string(GRAINREEL_SOURCE) + "/tests/draw/golden/" + name + ".png";
}

void write(const std::string& path, const Picture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGBA;
    ASSERT_NE(png_image_write_to_file(&image, path.c_str(), 0, picture.rgba.data(), 0, nullptr), 0);
}

Picture read(const std::string& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, path.c_str())) return {};
    image.format = PNG_FORMAT_RGBA;
    Picture picture(static_cast<int>(image.width), static_cast<int>(image.height));
    return png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr) ? picture : Picture();
}

// Share of the pixels that differ by more than 3 of 255, and the mean difference of all numbers.
struct Apart {
    double share = 1, mean = 255;
    bool alike() const { return share <= 0.01 && mean < 0.5; }
};
Apart compare(const Picture& a, const Picture& b) {
    if (a.width != b.width || a.height != b.height || a.rgba.empty()) return {};
    Apart apart{0, 0};
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        int largest = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const int difference = std::abs(a.rgba[i + c] - b.rgba[i + c]);
            largest = std::max(largest, difference);
            apart.mean += difference;
        }
        apart.share += largest > 3;
    }
    apart.share /= static_cast<double>(a.rgba.size()) / 4;
    apart.mean /= static_cast<double>(a.rgba.size());
    return apart;
}

Picture shifted(const Picture& picture) {
    Picture moved = picture;
    for (int y = 0; y < picture.height; ++y)
        std::copy(picture.pixel(0, y), picture.pixel(picture.width - 1, y), moved.pixel(1, y));
    return moved;
}

void expect_golden(const std::string& name, const Picture& picture) {
    if (std::getenv("GRAINREEL_WRITE_GOLDEN")) return write(path_of(name), picture);
    const Picture golden = read(path_of(name));
    const Apart apart = compare(picture, golden);
    EXPECT_TRUE(apart.alike()) << name << ": " << 100 * apart.share
                               << " % of the pixels differ by more than 3, mean " << apart.mean;
    if (!apart.alike()) {
        const auto seen = std::filesystem::temp_directory_path() / (name + "-drawn.png");
        write(seen.string(), picture);
        std::cerr << "drawn: " << seen << "\n";
    }
    EXPECT_FALSE(compare(shifted(picture), golden).alike()) << name << ": a shift of a pixel is not seen";
}

// A loose bed in the wedge: grains on a lattice, moved a little at random, with the big ones below.
Shot bed() {
    std::mt19937 random(5);
    const auto some = [&] { return static_cast<double>(random()) / 4294967295.0 - 0.5; };
    std::vector<Ball> balls;
    for (double z = 0.008; z < 0.1; z += z < 0.04 ? 0.0105 : 0.0055) {
        const bool big = z < 0.04;
        const double radius = big ? 0.005 : 0.0025, pitch = 2.1 * radius;
        const double wide = 0.075 - std::max(0.0, 0.1 - z) * std::tan(20 * pi / 180) - radius;
        for (double y = -wide; y <= wide; y += pitch)
            for (double x = -0.02 + radius; x <= 0.02 - radius; x += pitch)
                balls.push_back(
                    {{x + 0.0004 * some(), y + 0.0004 * some(), z + 0.0004 * some()}, radius, big ? 1 : 0});
    }
    Shot frame = frame_of(balls);
    frame.time = 0.8125;
    frame.cycles = 16.25;
    frame.phase = 0.25;
    frame.container().place = frame.floor().place = {0, 0, 0.002};
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Vec3& at = frame.position[i];
        frame.velocity[i] = 4 * Vec3(0, -(at.z() - 0.05), at.y());  // the bed rolls
        frame.displacement.push_back(0.05 * frame.velocity[i] * 0.2);
        frame.orientation.push_back(Quaternion(Eigen::AngleAxisd(40 * at.y(), Vec3::UnitX())));
        frame.spin[i] = {20 * at.z(), 0, 0};
    }
    for (std::size_t i = 0; i < balls.size(); ++i)
        for (std::size_t j = i + 1; j < balls.size(); ++j)
            if ((balls[i].at - balls[j].at).norm() < 1.03 * (balls[i].radius + balls[j].radius))
                frame.touches.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j),
                                         0.02 * (0.12 - balls[i].at.z()) / 0.1});
    const auto table = std::make_shared<MeasureTable>(std::vector<std::string>{"time_s", "lacey"});
    for (int row = 0; row < 40; ++row) table->add({0.02 * row, 0.3 + 0.4 * std::sin(0.1 * row)});
    frame.measures = table;
    frame.measure_rows = 40;
    return frame;
}

// The bed `time` (s) before.
Shot earlier(double time) {
    Shot frame = bed();
    frame.time -= time;
    for (std::size_t i = 0; i < frame.size(); ++i) frame.position[i] -= time * frame.velocity[i];
    return frame;
}

FilmedScene scene_for(const std::function<void(Film&)>& change) {
    FilmedScene scene = wedge(kWidth, kHeight);
    scene.run.duration = 2;
    scene.drive.direction = Vec3::UnitZ();
    scene.film.look.ground = true;
    change(scene.film);
    return scene;
}

void style(Film& film, FilmLook::Style style) {
    film.look = FilmLook::of(style);
    film.background = default_background(style);
}

void colour(Film& film, GrainValue by, ColourMap map, double low, double high, const char* unit) {
    film.shows.colour = {by, map, {low, high}, false, unit, 5};
}

struct Feature {
    const char* name;
    std::function<void(Film&)> change;
};
void PrintTo(const Feature& feature, std::ostream* out) {
    *out << feature.name;
}

class Golden : public testing::TestWithParam<Feature> {};

TEST_P(Golden, Picture) {
    const FilmedScene scene = scene_for(GetParam().change);
    Renderer renderer(scene, 2);
    renderer.draw(earlier(0.05), "");  // trails and heights at the start need an earlier frame
    expect_golden(GetParam().name, renderer.draw(bed(), "slow motion, 1/10 speed"));
}

const Feature kFeatures[] = {
    {"studio", [](Film&) {}},
    {"flat", [](Film& f) { style(f, FilmLook::Style::flat); }},
    {"dark", [](Film& f) { style(f, FilmLook::Style::dark); }},
    {"cut",
     [](Film& f) {
         f.look.cut = {true, {1, 0, 0}, 0.003, 0};
     }},
    {"slab",
     [](Film& f) {
         f.look.cut = {true, Vec3(1, 1, 0).normalized(), 0.005, 0.008};
     }},
    {"rotation", [](Film& f) { f.look.rotation = true; }},
    {"hidden", [](Film& f) { f.shows.hidden = {0}; }},
    {"ghost", [](Film& f) { f.shows.ghosts = {0}; }},
    {"highlight",
     [](Film& f) {
         f.shows.highlighted = {7, 300, 900};
     }},
    {"speed", [](Film& f) { colour(f, GrainValue::speed, ColourMap::viridis, 0, 0.3, "cm/s"); }},
    {"vertical_velocity",
     [](Film& f) { colour(f, GrainValue::vertical_velocity, ColourMap::vik, -0.3, 0.3, "cm/s"); }},
    {"start_height", [](Film& f) { colour(f, GrainValue::start_height, ColourMap::viridis, 0, 0.1, "mm"); }},
    {"displacement",
     [](Film& f) { colour(f, GrainValue::displacement, ColourMap::cividis, 0, 0.003, "mm"); }},
    {"spin", [](Film& f) { colour(f, GrainValue::spin, ColourMap::viridis, 0, 2, "rad/s"); }},
    {"coordination", [](Film& f) { colour(f, GrainValue::coordination, ColourMap::viridis, 0, 8, ""); }},
    {"contact_force",
     [](Film& f) { colour(f, GrainValue::contact_force, ColourMap::viridis, 0, 0.1, "mN"); }},
    {"arrows",
     [](Film& f) {
         f.shows.arrows = {10, 0.1, true};
     }},
    {"trails",
     [](Film& f) {
         f.shows.trails = {{1}, {}, 0.1};
     }},
    {"force_chains", [](Film& f) { f.shows.force_chains = true; }},
    {"plot",
     [](Film& f) {
         f.shows.plots = {{"lacey", "mixing", std::array<double, 2>{0, 1}}};
     }},
    {"text",
     [](Film& f) {
         f.shows.text = "mixing {lacey}\nby Lacey";
         f.shows.live_words = {{"mixing ", "lacey", "", 1}, {"\nby Lacey", "", "", 1}};
     }},
    {"wall_ghost", [](Film& f) { f.wall_ghost = true, f.exaggerate = 5; }},
    {"axes_from_above", [](Film& f) { f.axes = true, f.camera.azimuth = -40, f.camera.elevation = 50; }},
    {"orthographic_close", [](Film& f) { f.camera.field_of_view = 0, f.camera.zoom = 3; }},
    {"transparent", [](Film& f) { f.transparent = true; }},
    {"portrait", [](Film& f) { f.width = 270, f.height = 480; }},
};
INSTANTIATE_TEST_SUITE_P(Feature, Golden, testing::ValuesIn(kFeatures),
                         [](const auto& feature) { return std::string(feature.param.name); });

TEST(GoldenContainers, BoxAndCylinder) {
    for (const auto& [name, shape] :
         {std::pair{"box", Container::Shape::box}, {"cylinder", Container::Shape::cylinder}}) {
        FilmedScene scene = scene_for([](Film&) {});
        scene.container.shape = shape;
        scene.container.half_width = 0.05;
        scene.container.height = 0.1;
        scene.container.depth = 0.06;
        const Shot frame =
            frame_of({{{0, 0, 0.03}, 0.03, 1}, {{0, 0.035, 0.01}, 0.01, 0}, {{0.02, -0.03, 0.02}, 0.008, 0}});
        expect_golden(name, Renderer(scene, 1).draw(frame, ""));
    }
}

// A chute in a box with an open top. Grains go through both, and lie beside the box, under it and in front of
// it.
TEST(GoldenContainers, GrainsThroughWalls) {
    FilmedScene scene = scene_for([](Film& f) { f.camera.azimuth = 35, f.camera.elevation = 25; });
    scene.container.shape = Container::Shape::box;
    scene.container.half_width = 0.05;
    scene.container.height = 0.08;
    scene.container.depth = 0.06;
    ScenePlane chute;
    chute.point = Vec3(0, 0, 0.03);
    chute.normal = Vec3(0, 0.4, 1).normalized();
    scene.walls = {chute};
    const Shot frame = frame_of({{{0, 0, 0.03}, 0.012, 1},
                                 {{0.01, 0.03, 0.012}, 0.008, 0},
                                 {{0.03, 0.02, 0.05}, 0.012, 1},
                                 {{0, 0.05, 0.06}, 0.01, 0},
                                 {{-0.01, -0.05, 0.05}, 0.012, 1},
                                 {{0, -0.065, 0.02}, 0.008, 0},
                                 {{0, 0.03, -0.012}, 0.008, 1}});
    expect_golden("through_walls", Renderer(scene, 1).draw(frame, ""));
    scene.film.width = 1440, scene.film.height = 810;
    if (const char* at = std::getenv("GRAINREEL_LOOK")) write(at, Renderer(scene, 1).draw(frame, ""));
}

TEST(GoldenExposure, Streaks) {
    const FilmedScene scene = scene_for([](Film&) {});
    Shot frame = bed();
    for (int k = 5; k > 0; --k) frame.exposed.push_back(std::make_shared<const Shot>(earlier(0.005 * k)));
    expect_golden("exposure", Renderer(scene, 2).draw(frame, "exposed for 0.03 s"));
}

TEST(GoldenSideBySide, TwoPanels) {
    std::vector<Panel> panels;
    for (const double g_level : {1.0, 3.0}) {
        FilmedScene scene = scene_for([](Film&) {});
        scene.drive.amplitude *= g_level;
        panels.push_back({scene, g_level < 2 ? "\xce\x93 = 1" : "\xce\x93 = 3"});
    }
    Film film;
    film.width = 640;
    film.height = 360;
    film.title = "Together";
    SideBySide drawing(panels, film, 1, gl::Provider::automatic);
    const auto frame = std::make_shared<const Shot>(bed());
    expect_golden("side_by_side", drawing.draw({frame, frame}));
}

}  // namespace
}  // namespace grainreel::test
