// Tests of ellipsoids and superquadrics: pixels against rays and outlines, and light against that of spheres.
#include "render/picture/grains/shaped_grains.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/draw/light_support.hpp"

namespace grainreel {
namespace {

using namespace test;

constexpr int kWidth = 200, kHeight = 150;
const Sight kPerspective{false, 160, kWidth / 2, kHeight / 2};
const Sight kOrthographic{true, 14, kWidth / 2, kHeight / 2};

// A view along z from the origin, so that places in the lab are places in the view.
View plain_view() {
    View view;
    view.eye = Vec3(0, 0, 0);
    view.right = Vec3(1, 0, 0), view.up = Vec3(0, 1, 0), view.forward = Vec3(0, 0, 1);
    return view;
}

State grains_of(const std::vector<Vec3>& places, const GrainShape& shape, const Quaternion& turned) {
    State state;
    for (std::size_t i = 0; i < places.size(); ++i) {
        state.id.push_back(static_cast<std::int32_t>(i));
        state.position.push_back(places[i]);
        state.radius.push_back(radius_by_volume(shape));
        state.shape.push_back(shape);
        state.orientation.push_back(turned);
    }
    return state;
}

Spheres drawn_as(const State& state) {
    std::vector<ViewSphere> balls;
    for (std::size_t i = 0; i < state.size(); ++i)
        balls.push_back({static_cast<float>(state.position[i].x()), static_cast<float>(state.position[i].y()),
                         static_cast<float>(state.position[i].z()), static_cast<float>(state.radius[i])});
    Spheres spheres = white(balls);
    give_shapes(plain_view(), state, spheres);
    return spheres;
}

// How far a point is out of a superquadric: 1 on its surface (Podlozhnyuk et al. 2017, eq. 1).
double level(const Vec3& point, const State& state, std::size_t grain) {
    const GrainShape& shape = state.shape[grain];
    const Vec3 own =
        (state.orientation[grain].conjugate() * (point - state.position[grain])).cwiseQuotient(shape.half);
    return std::pow(std::pow(std::abs(own.x()), shape.around) + std::pow(std::abs(own.y()), shape.around),
                    shape.along / shape.around) +
           std::pow(std::abs(own.z()), shape.along);
}

// Whether a line of sight comes into the grain, by small steps along it.
bool meets(const Sight& sight, const State& state, double x, double y) {
    const double u = sight.slope_x(static_cast<float>(x)), v = sight.slope_y(static_cast<float>(y));
    const double reach = state.shape[0].half.norm(), middle = state.position[0].z();
    // Most lines miss the ball around the grain.
    const Vec3 &centre = state.position[0], ahead(u, v, 1);
    if (!sight.orthographic && centre.cross(ahead).norm() > reach * ahead.norm()) return false;
    if (sight.orthographic && std::hypot(u - centre.x(), v - centre.y()) > reach) return false;
    constexpr int kSteps = 300;
    for (int k = 0; k <= kSteps; ++k) {
        const double z = middle - reach + 2 * reach * k / kSteps;
        if (level(sight.orthographic ? Vec3(u, v, z) : Vec3(u * z, v * z, z), state, 0) <= 1) return true;
    }
    return false;
}

const Quaternion kTurned = Quaternion(0.8, 0.3, -0.4, 0.33).normalized();

TEST(ShapedGrains, AreSeenWhereRaysMeetThem) {
    for (const GrainShape& shape :
         {GrainShape{Vec3(3, 1, 0.5)}, GrainShape{Vec3(2, 1.5, 1), 6, 2}, GrainShape{Vec3(1, 2, 1.5), 2.5, 9},
          GrainShape{Vec3(2, 1, 1.5), 100, 100}})
        for (const Sight& sight : {kPerspective, kOrthographic}) {
            const State state = grains_of({Vec3(0.4, -0.3, 12)}, shape, kTurned);
            Visibility visibility(kWidth, kHeight);
            Team team(1);
            const Spheres spheres = drawn_as(state);
            visibility.update(sight, {}, spheres.drawn(), team);
            int wrong = 0, seen = 0;
            for (int y = 0; y < kHeight; y += 2)
                for (int x = 0; x < kWidth; x += 2) {
                    const bool there = meets(sight, state, x + 0.5, y + 0.5);
                    wrong += there != (visibility.row(y)[x] == 1);
                    seen += there;
                }
            EXPECT_GT(seen, 125);
            EXPECT_LE(wrong, 2) << shape.half.transpose() << ", " << shape.along << ", " << shape.around;
        }
}

std::vector<std::uint32_t> lit(const Spheres& spheres, const Sight& sight, const Cut& cut, const Lamp& lamp) {
    SphereLayer layer(kWidth, kHeight);
    Team team(2);
    layer.find_visible(sight, cut, spheres, team);
    layer.find_order(sight, cut, spheres, {}, team);
    layer.find_neighbours(cut, lamp, spheres, team);
    const Layer& drawn = layer.light(sight, cut, lamp, spheres, team);
    std::vector<std::uint32_t> pixels;
    for (int y = 0; y < kHeight; ++y) pixels.insert(pixels.end(), drawn.row(y), drawn.row(y) + kWidth);
    return pixels;
}

TEST(ShapedGrains, WithEqualHalfLengthsLookLikeSpheres) {
    const State state =
        grains_of({Vec3(0, 0, 12), Vec3(1.7, 0.4, 12.3), Vec3(0.2, 1.6, 11)}, {Vec3(1, 1, 1)}, kTurned);
    State spheres = state;
    spheres.shape.clear();
    Cut cut;
    cut.planes = 1;
    cut.plane[0] = {0, 0, 1, 11.3f};
    for (const Cut& of : {Cut(), cut})
        for (const Sight& sight : {kPerspective, kOrthographic}) {
            const auto one = lit(drawn_as(state), sight, of, Lamp());
            const auto other = lit(drawn_as(spheres), sight, of, Lamp());
            int differ = 0;
            for (std::size_t p = 0; p < one.size(); ++p)
                for (int byte = 0; byte < 4; ++byte)
                    differ += std::abs(int(one[p] >> 8 * byte & 255) - int(other[p] >> 8 * byte & 255)) > 2;
            EXPECT_LE(differ, 8);
        }
}

// Seen along z, an ellipsoid that is lit from the eye alone is as bright as its normal is level with z:
// n = M^T M p, where M takes a point to the unit ball.
TEST(ShapedGrains, AreLitByTheirNormals) {
    const GrainShape shape{Vec3(3, 1.2, 2)};
    const State state = grains_of({Vec3(0, 0, 12)}, shape, kTurned);
    Lamp lamp;
    lamp.occlusion = lamp.shadows = false;
    lamp.key = 0.5f, lamp.sky = lamp.ground = lamp.even = 0, lamp.shine = 0, lamp.rim = 1;
    lamp.to_key[0] = lamp.to_key[1] = 0, lamp.to_key[2] = -1;
    const auto pixels = lit(drawn_as(state), kOrthographic, {}, lamp);
    const Eigen::Matrix3d axes = kTurned.toRotationMatrix();
    const Eigen::Matrix3d unit = shape.half.cwiseInverse().asDiagonal() * axes.transpose();
    int compared = 0;
    for (int y = 40; y < 110; y += 5)
        for (int x = 60; x < 140; x += 5) {
            const Vec3 from(kOrthographic.slope_x(static_cast<float>(x) + 0.5f),
                            kOrthographic.slope_y(static_cast<float>(y) + 0.5f), -12);
            const Vec3 start = unit * from, along = unit.col(2);
            const double b = start.dot(along), a = along.squaredNorm(), c = start.squaredNorm() - 1;
            if (b * b - a * c < 0.05) continue;
            const Vec3 point = from + (-b - std::sqrt(b * b - a * c)) / a * Vec3(0, 0, 1);
            const Vec3 normal = (unit.transpose() * (unit * point)).normalized();
            const auto expected =
                static_cast<int>(ToneTable::get().byte(0.5f * static_cast<float>(-normal.z())));
            EXPECT_NEAR(static_cast<int>(pixels[static_cast<std::size_t>(y) * kWidth + x] & 255), expected,
                        2);
            ++compared;
        }
    EXPECT_GT(compared, 50);
}

TEST(ShapedGrains, HaveBallsInsideThatTakeLight) {
    for (const GrainShape& shape : {GrainShape{Vec3(4, 1, 1)}, GrainShape{Vec3(2, 2, 0.4)}}) {
        const State state = grains_of({Vec3(0.4, -0.3, 12)}, shape, kTurned);
        const Spheres spheres = drawn_as(state);
        ASSERT_GT(spheres.spheres.size(), 1u);
        for (const ViewSphere& ball : spheres.spheres)
            for (int k = 0; k < 200; ++k) {
                const double height = 1 - (2 * k + 1) / 200.0, turn = 2.4 * k,
                             flat = std::sqrt(1 - height * height);
                const Vec3 out(flat * std::cos(turn), flat * std::sin(turn), height);
                EXPECT_LE(level(Vec3(ball.x, ball.y, ball.z) + ball.radius * out, state, 0), 1 + 1e-5);
            }
    }
}

TEST(GrainShape, HasTheVolumeOfItsFormulas) {
    const Vec3 half(0.3, 0.2, 0.1);
    const auto cube = [](double r) { return r * r * r; };
    EXPECT_NEAR(radius_by_volume({Vec3(0.2, 0.2, 0.2)}), 0.2, 1e-12);
    EXPECT_NEAR(cube(radius_by_volume({half})), half.prod(), 1e-12);
    // Powers of 100 are a cylinder with the axis z, and a box, within a few parts in ten thousand.
    const double ball = 4.0 / 3 * std::numbers::pi;
    EXPECT_NEAR(ball * cube(radius_by_volume({half, 100, 2})) / (2 * std::numbers::pi * half.prod()), 1,
                0.02);
    EXPECT_NEAR(ball * cube(radius_by_volume({half, 100, 100})) / (8 * half.prod()), 1, 0.02);
}

}  // namespace
}  // namespace grainreel
